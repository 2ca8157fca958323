#include "app/gui/widgets/FileDialogs.h"

#include <QAbstractItemView>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QRegularExpression>
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

/// The next number after an existing name without folder, so that Return alone replaces nothing.
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

/// The name that will be written: one whose ending the filter does not have gets that of the proposal ("sensor.v2" is
/// written as sensor.v2.json).
QString withEnding(const QString& file, const QString& proposal, const QString& filter) {
  const QString ending = QFileInfo(proposal).suffix();
  if (file.isEmpty() || ending.isEmpty()) return file;
  static const QRegularExpression pattern("\\*\\.(\\w+)");
  QStringList allowed{ending};
  for (auto match = pattern.globalMatch(filter); match.hasNext();) allowed << match.next().captured(1);
  return allowed.contains(QFileInfo(file).suffix(), Qt::CaseInsensitive) ? file : file + '.' + ending;
}

bool mayReplace(QWidget* parent, const QString& title, const QString& file) {
  return !QFileInfo(file).isFile() ||
         QMessageBox::question(parent, title, QObject::tr("%1 exists already. Replace it?").arg(file),
                               QMessageBox::Yes | QMessageBox::No, QMessageBox::No) == QMessageBox::Yes;
}

} // namespace

QString askFileToSave(QWidget* parent, const QString& title, const QString& proposal, const QString& filter) {
  QFileDialog dialog(parent, title, lastFolder(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setFileMode(QFileDialog::AnyFile);
  dialog.setDefaultSuffix(QFileInfo(proposal).suffix());
  dialog.selectFile(freeIn(dialog.directory(), afterProject(parent, proposal)));
  // An existing proposal is selected in the list too, and Qt would prefer it to a path that is typed.
  for (auto* list : dialog.findChildren<QAbstractItemView*>())
    if (list->selectionModel() != nullptr) list->selectionModel()->clear();
  dialog.setOption(QFileDialog::DontConfirmOverwrite); // Qt would ask about the name before it has its ending
  for (;;) {
    const QString file = withEnding(chosen(dialog).value(0), proposal, filter);
    if (file.isEmpty() || mayReplace(parent, title, file)) return file;
  }
}

QString askFileToOpen(QWidget* parent, const QString& title, const QString& filter, const QString& folder) {
  return opened(parent, title, filter, folder, QFileDialog::ExistingFile).value(0);
}

QStringList askFilesToOpen(QWidget* parent, const QString& title, const QString& filter) {
  return opened(parent, title, filter, {}, QFileDialog::ExistingFiles);
}

} // namespace palp
