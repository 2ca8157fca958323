#include "app/gui/document/Document.h"

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/jobs/ReturnMemory.h"
#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/project/FileKind.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/window/MainWindow.h"
#include "model/base/Error.h"

#include <QEventLoop>
#include <QFileInfo>
#include <QMessageBox>
#include <QScopedValueRollback>
#include <QSettings>
#include <QTimer>

#include <algorithm>

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

/// The folder of the samples and the network of a project: NAME.palp next to NAME.json.
std::filesystem::path resultsFolder(const QString& file) {
  return std::filesystem::path(file.toStdString()).replace_extension(".palp");
}

} // namespace

Document::Document(MainWindow& window, Workbench& workbench, NetworkSession& network)
    : QObject(&window), window_(window), workbench_(workbench), network_(network) {
  for (const auto changed : {&NetworkSession::samplesChanged, &NetworkSession::fitChanged,
                             &NetworkSession::sweepChanged, &NetworkSession::trialsChanged})
    connect(&network, changed, this, &Document::showTitle);
  connect(&workbench, &Workbench::fileChanged, this, &Document::showTitle);
  connect(&workbench, &Workbench::projectReplaced, this, [this] {
    network_.clear(); // what the other project held
    ours_ = std::make_shared<std::set<std::filesystem::path>>();
    openResults();
    QTimer::singleShot(0, this, returnMemory); // when the views have released it
  });
  connect(&network, &NetworkSession::saved, this, [this](const std::vector<std::filesystem::path>& files) {
    QStringList names;
    for (const std::filesystem::path& file : files) names << QString::fromStdString(file.string());
    window_.showMessage(tr("Saved %1.").arg(names.join(tr(" and "))));
  });
  connect(&network, &NetworkSession::samplesOpened, this,
          [this](const QString& file) { window_.showMessage(tr("Opened %1.").arg(file)); });
  connect(&network.writer(), &JobRunner::failed, this, [this](const QString& sentence) {
    auto* box =
        new QMessageBox(QMessageBox::Warning, tr("Cannot save"),
                        tr("%1\n\nThe file saved earlier is unchanged.").arg(sentence), QMessageBox::Ok, &window_);
    box->setObjectName("cannotSave");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->open(); // the job ends meanwhile
  });
  showTitle();
}

QStringList Document::recent() {
  return QSettings().value(kRecentKey).toStringList();
}

Project Document::project() const {
  Project project = workbench_.project();
  project.view.scene = window_.currentScene().objectName().toStdString();
  return project;
}

bool Document::unsaved() const {
  return workbench_.modified() || resultsUnsaved();
}

bool Document::resultsUnsaved() const {
  const NetworkResults& made = network_.results();
  return network_.upToDate() && !saved_.is(made);
}

void Document::showTitle() {
  const QString& file = workbench_.file();
  window_.setWindowTitle(tr("%1[*] - Palp").arg(file.isEmpty() ? tr("Untitled") : QFileInfo(file).fileName()));
  window_.setWindowFilePath(file);
  window_.setWindowModified(unsaved());
  emit unsavedChanged();
}

/// What was ordered to be saved is saved, or has failed. The window draws meanwhile and takes no input.
void Document::finishWriting() {
  if (!network_.writer().running()) return;
  window_.setEnabled(false);
  QEventLoop waiting;
  connect(&network_.writer(), &JobRunner::finished, &waiting, &QEventLoop::quit);
  waiting.exec();
  window_.setEnabled(true);
}

QString Document::unsavedWords() const {
  const QString& file = workbench_.file();
  const QString name = file.isEmpty() ? tr("the project") : QFileInfo(file).fileName();
  const QString results = tr("The samples and networks of %1 are not saved.").arg(name);
  switch (workbench_.modification()) {
  case Workbench::Modified::Project:
    return file.isEmpty() ? tr("The project has changes that are not saved.")
                          : tr("%1 has changes that are not saved.").arg(name);
  case Workbench::Modified::Calibration: {
    const QString calibration = tr("Labelled frames or the calibrated network of %1 are not saved.").arg(name);
    return resultsUnsaved() ? calibration + "\n\n" + results : calibration;
  }
  case Workbench::Modified::LiveSettings:
    if (resultsUnsaved()) break; // the dearer half is named
    return tr("Settings of the Live scene have changed and are not saved in %1.").arg(name);
  case Workbench::Modified::Nothing:
    break;
  }
  return results;
}

bool Document::mayLeave(const Leaving& leaving) {
  if (leaving_) return false; // the question is open, or its answer is being carried out
  const QScopedValueRollback<bool> asking(leaving_, true);
  finishWriting();
  const QStringList losses = workbench_.lossQuestion().losses(leaving);
  if (!unsaved()) return acceptsLosses(losses, &window_);
  QMessageBox question(QMessageBox::Question, tr("Save the project?"),
                       (QStringList(unsavedWords()) + losses).join("\n\n"),
                       QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window_);
  question.setInformativeText(tr("Save writes the changes to the project's file; Discard loses them."));
  question.setObjectName("unsaved");
  question.setDefaultButton(QMessageBox::Save);
  const int answer = question.exec();
  if (answer == QMessageBox::Discard) return true;
  if (answer != QMessageBox::Save || !save()) return false;
  finishWriting();
  return !unsaved();
}

bool Document::mayReplace(const Project& next) {
  return mayLeave({Leaving::Way::OtherProject, &next});
}

void Document::open() {
  const QStringList files = askFilesToOpen(
      &window_, tr("Open"),
      tr("Palp files and tables (*.json *.csv *.h5 *.hdf5 *.npz *.palprec *.tsv *.txt *.dat *.mat);;All files (*)"));
  if (!files.isEmpty()) open(files);
}

void Document::open(const QStringList& files) {
  if (files.size() == 1) {
    open(files.front());
    return;
  }
  try {
    if (areTables(files)) return window_.importTables(files);
    std::vector<std::filesystem::path> samples;
    for (const QString& file : files) {
      if (fileKind(file) != FileKind::Samples)
        throw Error(file.toStdString() + ": not a sample file; several files can be opened together only if all of "
                                         "them are sample files, or all of them measured tables");
      samples.emplace_back(file.toStdString());
    }
    window_.openSamples(samples);
  } catch (const std::exception& error) {
    QMessageBox::warning(&window_, tr("Cannot open"), QString::fromStdString(error.what()));
  }
}

void Document::open(const QString& file) {
  try {
    const FileKind kind = fileKind(file);
    if (areTables({file})) return window_.importTables({file});
    if (kind == FileKind::ImportMap)
      throw Error(file.toStdString() + ": is a map for importing a table; open it together with the table");
    if (kind == FileKind::Design || kind == FileKind::Project) {
      openProject(file);
    } else if (kind == FileKind::Samples) {
      window_.openSamples({file.toStdString()});
    } else if (kind == FileKind::Network && network_.upToDate() && window_.currentScene().objectName() != "live") {
      window_.showScene("network");
      network_.open(file.toStdString());
    } else if (kind == FileKind::Study) {
      window_.showStudy(file);
    } else { // there are no samples to try a network on, or it is meant for the board
      Project next = workbench_.project();
      if (kind == FileKind::Network) {
        next.live.network = file.toStdString();
        next.live.calibrated.reset();
      } else {
        next.live.source = LiveSourceKind::Recording;
        next.live.recording = file.toStdString();
      }
      workbench_.edit(tr("Open %1").arg(QFileInfo(file).fileName()), next);
      window_.showScene("live");
    }
  } catch (const std::exception& error) {
    QMessageBox::warning(&window_, tr("Cannot open"),
                         tr("%1\n\nThe open project is unchanged.").arg(QString::fromStdString(error.what())));
  }
}

void Document::openProject(const QString& file) {
  const Project opened = loadProject(file.toStdString(), project());
  if (!mayReplace(opened)) return;
  const bool whole = fileKind(file) == FileKind::Project; // a design alone begins a project that has no file yet
  workbench_.replace(opened, whole ? QFileInfo(file).absoluteFilePath() : QString());
  window_.showScene(QString::fromStdString(opened.view.scene));
  remember(file);
  window_.showMessage(tr("Opened %1.").arg(file));
}

void Document::beganWith(const QString& file) {
  remember(file);
  if (fileKind(file) != FileKind::Project) return;
  workbench_.saved(QFileInfo(file).absoluteFilePath());
  openResults();
}

/// Samples and network next to the project.
void Document::openResults() {
  const QString& file = workbench_.file();
  if (file.isEmpty()) return;
  network_.openResults(resultsFolder(file), [this](const OpenedResults& opened) {
    ours_ = std::make_shared<std::set<std::filesystem::path>>(opened.opened);
    sayProblems(opened);
    resultsSaved(network_.results());
  });
}

void Document::sayProblems(const OpenedResults& opened) {
  if (opened.ofOtherDesigns > 0)
    window_.showMessage(
        tr("%1 of the trained networks belong to other designs; they stay in their files and are not listed.")
            .arg(opened.ofOtherDesigns));
  QStringList all;
  for (const std::string& problem : opened.problems) all << QString::fromStdString(problem);
  if (all.isEmpty()) return;
  all << tr("Files that cannot be opened are left unchanged.");
  network_.sayProblem(all.join("\n"));
  window_.showMessage(all.join(' '));
}

void Document::startAnew() {
  const Project paper = exampleProject();
  if (mayReplace(paper)) workbench_.replace(paper);
}

void Document::openExample(const QString& file, const QString& title) {
  try {
    const Project opened = loadProject(file.toStdString(), project());
    if (!mayReplace(opened)) return;
    workbench_.replace(opened);
    window_.showScene(QString::fromStdString(opened.view.scene));
    window_.showMessage(tr("%1: the example is a copy; saving asks for a file name.").arg(title));
  } catch (const Error& error) {
    QMessageBox::warning(&window_, tr("Cannot open"), QString::fromStdString(error.what()));
  }
}

bool Document::save() {
  return workbench_.file().isEmpty() ? saveAs() : write(workbench_.file());
}

bool Document::saveAs() {
  const QString proposal = workbench_.file().isEmpty() ? "project.json" : workbench_.file();
  const QString file = askFileToSave(&window_, tr("Save project"), proposal, tr("Projects (*.json)"));
  return !file.isEmpty() && write(file);
}

bool Document::write(const QString& file) {
  try {
    saveProject(file.toStdString(), project());
  } catch (const Error& error) {
    QMessageBox::warning(&window_, tr("Cannot save"), QString::fromStdString(error.what()));
    return false;
  }
  workbench_.saved(QFileInfo(file).absoluteFilePath());
  remember(file);
  const std::filesystem::path folder = resultsFolder(workbench_.file());
  const bool withResults = network_.upToDate();
  window_.showMessage(withResults ? tr("Saved %1; its samples and networks are in the folder %2 next to it.")
                                        .arg(file, QString::fromStdString(folder.filename().string()))
                                  : tr("Saved %1.").arg(file));
  if (!withResults) return true;
  network_.saveResults(folder, ours_, [this, folder, ours = ours_](const NetworkResults& results, const auto& said) {
    ours->merge(resultFiles(folder));
    for (const QString& sentence : said) window_.showMessage(sentence);
    resultsSaved(results);
  });
  return true;
}

void Document::resultsSaved(const NetworkResults& results) {
  saved_.set(results);
  showTitle();
}

void Document::recover(const QByteArray& project, const QString& file, const std::filesystem::path& results,
                       const std::function<void(bool complete)>& done) {
  const Project recovered = parseProject(project, tr("the recovered project"), exampleProject());
  replaceByRecovered(recovered, file);
  window_.showScene(QString::fromStdString(recovered.view.scene));
  network_.openResults(results, [this, done, results](const OpenedResults& opened) {
    sayProblems(opened);
    if (!opened.problems.empty())
      window_.showMessage(
          tr("Files that cannot be opened are left in %1.").arg(QString::fromStdString(results.string())));
    done(opened.problems.empty());
  });
}

/// As an edit of what the file holds, so that undoing leads there; where that cannot be read, it is all there is.
void Document::replaceByRecovered(const Project& recovered, const QString& file) {
  try {
    workbench_.replace(file.isEmpty() ? exampleProject() : loadProject(file.toStdString(), exampleProject()), file);
  } catch (const Error& error) {
    workbench_.replaceUnsaved(recovered, file);
    window_.showMessage(tr("%1. The recovered project is complete without this file; saving replaces it.")
                            .arg(QString::fromStdString(error.what())));
    return;
  }
  workbench_.edit(tr("Recover unsaved work"), recovered);
}

} // namespace palp
