#include "app/gui/window/Application.h"

#include <QLabel>
#include <QLocale>
#include <QMessageBox>

#include <clocale>
#include <iostream>

namespace palp {

Application::Application(int& argc, char** argv) : QApplication(argc, argv) {
  // After QApplication, which calls setlocale(LC_ALL, ""). What prints or reads numbers through C (VTK's texts,
  // nlohmann's, HDF5's) follows LC_NUMERIC; what does so through Qt follows the default QLocale.
  std::setlocale(LC_NUMERIC, "C");
  QLocale numbers = QLocale::c();
  numbers.setNumberOptions(QLocale::OmitGroupSeparator | QLocale::RejectGroupSeparator);
  QLocale::setDefault(numbers);
}

namespace {

/// The text of a label may contain a file's or a board's name, which is not markup. A label with markup is set to
/// RichText (app/gui/widgets/Markup.h); tool tips are ToolTipWrap's.
void showAsWritten(QLabel& label) {
  if (label.textFormat() == Qt::AutoText && !label.inherits("QTipLabel")) label.setTextFormat(Qt::PlainText);
}

} // namespace

bool Application::notify(QObject* receiver, QEvent* event) {
  QString what;
  try {
    if (auto* label = event->type() == QEvent::Polish ? qobject_cast<QLabel*>(receiver) : nullptr)
      showAsWritten(*label);
    return QApplication::notify(receiver, event);
  } catch (const std::exception& fault) {
    what = QString::fromStdString(fault.what());
  } catch (...) {
    what = tr("unknown error");
  }
  std::cerr << "palp-studio: internal error: " << what.toStdString() << std::endl;
  emit faulted(what);
  return true; // the event is spent
}

void showFault(QWidget& window, const QString& what) {
  auto* box = window.findChild<QMessageBox*>("fault");
  if (box == nullptr) {
    box = new QMessageBox(QMessageBox::Warning, QObject::tr("Internal error"), {}, QMessageBox::Ok, &window);
    box->setObjectName("fault");
    box->setModal(false);
  }
  box->setText(QObject::tr("Internal error: %1").arg(what));
  box->setInformativeText(
      QObject::tr("Save the project now (File, Save project as, under another name), then restart the program."));
  box->show();
}

} // namespace palp
