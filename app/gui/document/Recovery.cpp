#include "app/gui/document/Recovery.h"

#include "app/gui/document/Autosave.h"
#include "app/gui/document/Document.h"
#include "app/gui/jobs/JobRunner.h"
#include "app/gui/window/MainWindow.h"

#include <QFileInfo>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>

namespace palp {

void offerRecovery(MainWindow& window, const QString& root) {
  for (const LeftWork& work : Autosave::left(root)) {
    const QString name =
        work.file.isEmpty() ? QObject::tr("a project without a name") : QFileInfo(work.file).fileName();
    QMessageBox question(QMessageBox::Question, QObject::tr("Recover unsaved work?"),
                         QObject::tr("Palp ended without saving %1. What was done until %2 can be had back.")
                             .arg(name, QLocale().toString(work.saved, QLocale::ShortFormat)),
                         QMessageBox::NoButton, &window);
    question.setObjectName("recovery");
    const auto* recover = question.addButton(QObject::tr("Recover"), QMessageBox::AcceptRole);
    const auto* discard = question.addButton(QObject::tr("Discard"), QMessageBox::DestructiveRole);
    question.addButton(QObject::tr("Ask again later"), QMessageBox::RejectRole);
    question.exec();
    if (question.clickedButton() == discard) Autosave::forget(work);
    if (question.clickedButton() != recover) continue;
    try {
      window.document().recover(Autosave::project(work), work.file, Autosave::results(work).toStdString(),
                                [work] { Autosave::forget(work); });
    } catch (const std::exception& error) {
      QMessageBox::warning(&window, QObject::tr("Cannot recover"),
                           QObject::tr("%1\n\nIt stays in %2.").arg(QString(error.what()), work.folder));
    }
    return; // one project at a time; the others are asked for at the next start
  }
}

} // namespace palp
