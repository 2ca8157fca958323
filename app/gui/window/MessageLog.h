#pragma once

#include <QDockWidget>

class QLineEdit;
class QPlainTextEdit;

namespace palp {

class LogFile;

/// The messages of the window since its start, with the time: the status line shows each only for a while.
class MessageLog : public QDockWidget {
  Q_OBJECT

public:
  explicit MessageLog(QWidget* parent = nullptr);

  void add(const QString& sentence);
  /// From now on the file has all messages too; the dock shows its path.
  void keepIn(LogFile& file);

public slots:
  /// For a widget that has only the object name of this dock: shows the sentence as the window does.
  void say(const QString& sentence) { emit asked(sentence); }

signals:
  void added(const QString& sentence);
  /// To be shown by the window.
  void asked(const QString& sentence);

private:
  QPlainTextEdit* lines_ = nullptr;
  QLineEdit* place_ = nullptr; ///< of the file
};

} // namespace palp
