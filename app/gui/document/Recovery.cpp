#include "app/gui/document/Recovery.h"

#include "app/gui/document/Autosave.h"
#include "app/gui/document/Document.h"
#include "app/gui/window/MainWindow.h"
#include "io/board/RecordingReader.h"

#include <QFileInfo>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>

namespace palp {

namespace {

QString momentWords(const QDateTime& moment) {
  return QLocale().toString(moment, QLocale::ShortFormat);
}

/// The rest of a recording that was being written.
QString recordingWords(const QString& file) {
  const QFileInfo info(file);
  if (!info.exists()) return QObject::tr("%1: the file no longer exists.").arg(file);
  try {
    const RecordingReader readable(file.toStdString());
    return QObject::tr("%1: readable; its last reports were written at %2.")
        .arg(file, momentWords(info.lastModified()));
  } catch (const std::exception& error) {
    return QObject::tr("%1: not readable (%2).").arg(file, QString::fromUtf8(error.what()));
  }
}

/// Without waiting for an answer.
void reportCutRecordings(MainWindow& window, const std::vector<LeftWork>& left) {
  QStringList words;
  for (const LeftWork& work : left) {
    for (const QString& file : work.recordings) words << recordingWords(file);
    Autosave::forgetRecordings(work);
  }
  if (words.isEmpty()) return;
  words.prepend(QObject::tr("Palp ended during a recording. The recording contains the data up to that moment."));
  window.showMessage(words.join(' '));
  auto* box = new QMessageBox(QMessageBox::Information, QObject::tr("Recording interrupted"), words.join("\n\n"),
                              QMessageBox::Ok, &window);
  box->setObjectName("cutRecordings");
  box->setTextFormat(Qt::PlainText);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

enum class RecoveryWish { Recover, Discard, Later };

RecoveryWish askAbout(MainWindow& window, const LeftWork& work) {
  const QString name = work.file.isEmpty() ? QObject::tr("an untitled project") : QFileInfo(work.file).fileName();
  QMessageBox question(QMessageBox::Question, QObject::tr("Recover unsaved work?"),
                       QObject::tr("Palp ended without saving %1. Changes up to %2 can be recovered.")
                           .arg(name, momentWords(work.saved)),
                       QMessageBox::NoButton, &window);
  question.setObjectName("recovery");
  const auto* recover = question.addButton(QObject::tr("Recover"), QMessageBox::AcceptRole);
  const auto* discard = question.addButton(QObject::tr("Discard"), QMessageBox::DestructiveRole);
  question.addButton(QObject::tr("Ask again later"), QMessageBox::RejectRole);
  question.exec();
  if (question.clickedButton() == recover) return RecoveryWish::Recover;
  return question.clickedButton() == discard ? RecoveryWish::Discard : RecoveryWish::Later;
}

void recoverWork(MainWindow& window, Autosave& autosave, const LeftWork& work) {
  try {
    window.document().recover(
        Autosave::project(work), work.file, Autosave::results(work).toStdString(),
        [&autosave, work](bool complete) { complete ? autosave.takeOver(work) : autosave.hold(work); });
  } catch (const std::exception& error) {
    QMessageBox::warning(&window, QObject::tr("Cannot recover"),
                         QObject::tr("%1\n\nIt stays in %2.").arg(QString(error.what()), work.folder));
  }
}

} // namespace

void offerRecovery(MainWindow& window, Autosave& autosave, const QString& root) {
  const std::vector<LeftWork> left = Autosave::left(root); // no other window offers any of it meanwhile
  reportCutRecordings(window, left);
  for (const LeftWork& work : left) {
    const RecoveryWish wish = work.project ? askAbout(window, work) : RecoveryWish::Discard;
    if (wish == RecoveryWish::Discard) Autosave::forget(work);
    if (wish == RecoveryWish::Recover)
      return recoverWork(window, autosave, work); // one project; the next start asks for others
  }
}

} // namespace palp
