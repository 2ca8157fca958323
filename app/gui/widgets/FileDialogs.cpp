#include "app/gui/widgets/FileDialogs.h"

#include <QAbstractItemView>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>

namespace palp {

namespace {

constexpr const char* kLastFolder = "lastFolder";

QString lastFolder() {
  const QString folder = QSettings().value(kLastFolder).toString();
  return QFileInfo(folder).isDir() ? folder : QString();
}

/// Behind the name of the project whose window asks: files of several projects meet in one folder.
QString afterProject(const QWidget* parent, const QString& proposal) {
  const QString project =
      parent == nullptr ? QString() : QFileInfo(parent->window()->windowFilePath()).completeBaseName();
  if (project.isEmpty() || proposal.contains('/') || proposal.startsWith(project)) return proposal;
  return project + '-' + proposal;
}

/// The next number behind a name without folder that is there already, so that Return alone replaces nothing.
QString freeIn(const QDir& folder, const QString& proposal) {
  if (proposal.contains('/')) return proposal;
  const QString ending = QFileInfo(proposal).suffix().isEmpty() ? QString() : '.' + QFileInfo(proposal).suffix();
  const QString stem = proposal.chopped(ending.size());
  QString free = proposal;
  for (int number = 2; folder.exists(free); ++number) free = stem + '-' + QString::number(number) + ending;
  return free;
}

QStringList chosen(QFileDialog& dialog) {
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  QSettings().setValue(kLastFolder, QFileInfo(dialog.selectedFiles().front()).absolutePath());
  return dialog.selectedFiles();
}

QStringList opened(QWidget* parent, const QString& title, const QString& filter, const QString& folder,
                   QFileDialog::FileMode mode) {
  QFileDialog dialog(parent, title, QFileInfo(folder).isDir() ? folder : lastFolder(), filter);
  dialog.setFileMode(mode);
  return chosen(dialog);
}

} // namespace

QString askFileToSave(QWidget* parent, const QString& title, const QString& proposal, const QString& filter) {
  QFileDialog dialog(parent, title, lastFolder(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setFileMode(QFileDialog::AnyFile);
  dialog.setDefaultSuffix(QFileInfo(proposal).suffix());
  dialog.selectFile(freeIn(dialog.directory(), afterProject(parent, proposal)));
  // A proposal that is there is chosen in the list too, and Qt would take it before a path that is typed.
  for (auto* list : dialog.findChildren<QAbstractItemView*>())
    if (list->selectionModel() != nullptr) list->selectionModel()->clear();
  return chosen(dialog).value(0);
}

QString askFileToOpen(QWidget* parent, const QString& title, const QString& filter, const QString& folder) {
  return opened(parent, title, filter, folder, QFileDialog::ExistingFile).value(0);
}

QStringList askFilesToOpen(QWidget* parent, const QString& title, const QString& filter) {
  return opened(parent, title, filter, {}, QFileDialog::ExistingFiles);
}

} // namespace palp
