#include "app/gui/window/Application.h"

#include <QMessageBox>

#include <iostream>

namespace palp {

bool Application::notify(QObject* receiver, QEvent* event) {
  QString what;
  try {
    return QApplication::notify(receiver, event);
  } catch (const std::exception& fault) {
    what = QString::fromStdString(fault.what());
  } catch (...) {
    what = tr("it gave no reason");
  }
  std::cerr << "palp-studio: something failed: " << what.toStdString() << std::endl;
  emit faulted(what);
  return true; // the event is spent
}

void showFault(QWidget& window, const QString& what) {
  auto* box = window.findChild<QMessageBox*>("fault");
  if (box == nullptr) {
    box = new QMessageBox(QMessageBox::Warning, QObject::tr("Something failed"), {}, QMessageBox::Ok, &window);
    box->setObjectName("fault");
    box->setModal(false);
  }
  box->setText(QObject::tr("Something failed: %1").arg(what));
  box->setInformativeText(
      QObject::tr("Nothing is lost: save the project (Ctrl+S), then try again or start the program anew."));
  box->show();
}

} // namespace palp
