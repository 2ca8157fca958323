#pragma once

#include <QDockWidget>

class QPlainTextEdit;

namespace palp {

/// What the window has said since its start, with the time: a sentence of the status line is soon gone.
class MessageLog : public QDockWidget {
  Q_OBJECT

public:
  explicit MessageLog(QWidget* parent = nullptr);

  void add(const QString& sentence);

private:
  QPlainTextEdit* lines_ = nullptr;
};

} // namespace palp
