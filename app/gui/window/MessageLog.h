#pragma once

#include <QDockWidget>

class QLineEdit;
class QPlainTextEdit;

namespace palp {

class LogFile;

/// What the window has said since its start, with the time: a sentence of the status line is soon gone.
class MessageLog : public QDockWidget {
  Q_OBJECT

public:
  explicit MessageLog(QWidget* parent = nullptr);

  void add(const QString& sentence);
  /// From now on the file has all messages too; the dock says where it lies.
  void keepIn(LogFile& file);

public slots:
  /// For a widget that knows no more of its window than its name for this dock: says the sentence as the window does.
  void say(const QString& sentence) { emit asked(sentence); }

signals:
  void added(const QString& sentence);
  /// To be said by the window.
  void asked(const QString& sentence);

private:
  QPlainTextEdit* lines_ = nullptr;
  QLineEdit* place_ = nullptr; ///< of the file
};

} // namespace palp
