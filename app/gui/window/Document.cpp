#include "app/gui/window/Document.h"

#include "app/gui/project/ProjectFile.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/window/MainWindow.h"
#include "model/base/Error.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QSettings>

namespace palp {

namespace {

constexpr int kRecentFiles = 8;
constexpr const char* kRecentKey = "recentFiles";

void remember(const QString& file) {
  QSettings settings;
  QStringList files = settings.value(kRecentKey).toStringList();
  const QString whole = QFileInfo(file).absoluteFilePath();
  files.removeAll(whole);
  files.prepend(whole);
  settings.setValue(kRecentKey, files.mid(0, kRecentFiles));
}

/// Projects are named so in dialogs and lists.
QString withSuffix(const QString& file) {
  return file.endsWith(".json", Qt::CaseInsensitive) ? file : file + ".json";
}

} // namespace

Document::Document(MainWindow& window, Workbench& workbench)
    : QObject(&window), window_(window), workbench_(workbench) {
  connect(&workbench, &Workbench::fileChanged, this, &Document::showTitle);
  showTitle();
}

QStringList Document::recent() {
  return QSettings().value(kRecentKey).toStringList();
}

void Document::showTitle() {
  const QString& file = workbench_.file();
  window_.setWindowTitle(tr("%1[*] - Palp").arg(file.isEmpty() ? tr("Untitled") : QFileInfo(file).fileName()));
  window_.setWindowFilePath(file);
  window_.setWindowModified(workbench_.modified());
}

bool Document::mayLeave() {
  if (!workbench_.modified()) return true;
  QMessageBox question(
      QMessageBox::Question, tr("Save the project?"),
      tr("%1 has changes that are not saved.")
          .arg(workbench_.file().isEmpty() ? tr("The project") : QFileInfo(workbench_.file()).fileName()),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window_);
  question.setObjectName("unsaved");
  question.setDefaultButton(QMessageBox::Save);
  switch (question.exec()) {
  case QMessageBox::Save:
    return save();
  case QMessageBox::Discard:
    return true;
  default:
    return false;
  }
}

void Document::open() {
  const QString file = QFileDialog::getOpenFileName(&window_, tr("Open"), {}, tr("Designs and projects (*.json)"));
  if (!file.isEmpty()) open(file);
}

void Document::open(const QString& file) {
  try {
    Project base = workbench_.project();
    base.view.scene = window_.currentScene().objectName().toStdString();
    const Project opened = loadProject(file.toStdString(), base);
    if (!mayLeave()) return;
    const bool whole = isProjectFile(file.toStdString()); // a design alone begins a project that has no file yet
    workbench_.replace(tr("Open %1").arg(QFileInfo(file).fileName()), opened,
                       whole ? QFileInfo(file).absoluteFilePath() : QString());
    window_.showScene(QString::fromStdString(opened.view.scene));
    remember(file);
    window_.showMessage(tr("Opened %1.").arg(file));
  } catch (const std::exception& error) {
    QMessageBox::warning(&window_, tr("Cannot open"),
                         tr("%1\n\nWhat was open stays as it is.").arg(QString::fromStdString(error.what())));
  }
}

void Document::startAnew() {
  if (!mayLeave()) return;
  workbench_.replace(tr("The paper's design"), exampleProject());
}

bool Document::save() {
  return workbench_.file().isEmpty() ? saveAs() : write(workbench_.file());
}

bool Document::saveAs() {
  const QString proposal = workbench_.file().isEmpty() ? "project.json" : workbench_.file();
  const QString file = QFileDialog::getSaveFileName(&window_, tr("Save project"), proposal, tr("Projects (*.json)"));
  return !file.isEmpty() && write(withSuffix(file));
}

bool Document::write(const QString& file) {
  try {
    Project project = workbench_.project();
    project.view.scene = window_.currentScene().objectName().toStdString();
    saveProject(file.toStdString(), project);
  } catch (const Error& error) {
    QMessageBox::warning(&window_, tr("Cannot save"), QString::fromStdString(error.what()));
    return false;
  }
  workbench_.saved(QFileInfo(file).absoluteFilePath());
  remember(file);
  window_.showMessage(tr("Saved %1.").arg(file));
  return true;
}

} // namespace palp
