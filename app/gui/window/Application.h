#pragma once

#include <QApplication>

namespace palp {

/// Every program with a window of ours begins with it. It keeps numbers in one convention, with a decimal point, under
/// every locale: QApplication takes over the user's for the process, C library included.
///
/// The last catch of the window's thread: an exception that leaves a slot or an event handler would end the program
/// together with all that was not saved. It ends here instead, is written to standard error and passed on as faulted().
class Application : public QApplication {
  Q_OBJECT

public:
  Application(int& argc, char** argv);

  bool notify(QObject* receiver, QEvent* event) override;

signals:
  /// What happened, in the words of the exception.
  void faulted(const QString& what);
};

/// Shows what happened in a message box; a repeated fault changes the text of the
/// existing box.
void showFault(QWidget& window, const QString& what);

} // namespace palp
