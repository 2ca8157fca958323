#include "app/gui/window/HelpDialog.h"

#include "app/study/Resources.h"
#include "model/base/Error.h"

#include <QDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QTextBrowser>
#include <QVBoxLayout>

namespace palp {

void showHelp(QWidget* parent, const QString& scene) {
  auto* dialog = parent->findChild<QDialog*>("help");
  if (dialog == nullptr) {
    QString page;
    try {
      page = QString::fromStdString(resource("help/help.html").string());
    } catch (const Error& error) {
      QMessageBox::warning(parent, QObject::tr("Help"), QString::fromStdString(error.what()));
      return;
    }
    dialog = new QDialog(parent);
    dialog->setObjectName("help");
    dialog->setWindowTitle(QObject::tr("Palp: help"));
    dialog->resize(900, 700);
    auto* text = new QTextBrowser;
    text->setOpenExternalLinks(true);
    text->setSearchPaths({QFileInfo(page).path()});
    text->setSource(QUrl::fromLocalFile(page));
    auto* column = new QVBoxLayout(dialog);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(text);
  }
  dialog->findChild<QTextBrowser*>()->scrollToAnchor(scene);
  dialog->show();
  dialog->raise();
}

} // namespace palp
