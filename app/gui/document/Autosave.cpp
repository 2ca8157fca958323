#include "app/gui/document/Autosave.h"

#include "app/gui/document/Document.h"
#include "app/gui/jobs/CallLater.h"
#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/window/MainWindow.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <QUuid>

#include <algorithm>
#include <utility>

namespace palp {

namespace {

constexpr int kWait_ms = 2000; ///< from a change to its writing: what is typed and dragged meanwhile goes with it
constexpr int kTries = 3;      ///< to make a folder that no other window removes as an empty one
constexpr const char* kLock = "lock";
constexpr const char* kProject = "project.json";
constexpr const char* kFile = "file.txt"; ///< the path of the project's own file
constexpr const char* kResults = "results";
constexpr const char* kRecordings = "recordings.txt"; ///< a path a line

/// Held by the window as long as it lives; left by one that was killed, and stale then.
std::shared_ptr<QLockFile> lockOf(const QString& folder) {
  auto lock = std::make_shared<QLockFile>(QDir(folder).filePath(kLock));
  lock->setStaleLockTime(0); // however long the window is open
  return lock;
}

QString textIn(const QDir& folder, const char* name) {
  return QFileInfo::exists(folder.filePath(name))
             ? QString::fromStdString(readFile(folder.filePath(name).toStdString()))
             : QString();
}

LeftWork workIn(const QDir& folder, const std::shared_ptr<QLockFile>& lock) {
  const QFileInfo project(folder.filePath(kProject));
  LeftWork work{folder.path(), project.exists(), {}, project.lastModified(), {}, lock};
  if (work.project) work.file = textIn(folder, kFile);
  work.recordings = textIn(folder, kRecordings).split('\n', Qt::SkipEmptyParts);
  return work;
}

} // namespace

Autosave::Autosave(Workbench& workbench, NetworkSession& network, MainWindow& window, const QString& root,
                   QObject* parent)
    : QObject(parent), workbench_(workbench), network_(network), document_(window.document()), root_(root),
      runner_(std::make_unique<JobRunner>()) {
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, &Autosave::keep);
  connect(runner_.get(), &JobRunner::failed, this, &Autosave::say);
  connect(&workbench, &Workbench::projectChanged, this, &Autosave::changed);
  connect(&workbench, &Workbench::projectReplaced, this, [this] {
    leaveFolder();
    attempt([this] { keepRecordings(); });
  });
  connect(&document_, &Document::unsavedChanged, this, &Autosave::changed);
  connect(&window, &MainWindow::recordingsChanged, this, [this](const QStringList& files) {
    recordings_ = files;
    attempt([this] { keepRecordings(); });
  });
  callLater(*this,
            [this] { attempt([this] { makeFolder(); }); }); // reported in the window before there is work to lose
}

Autosave::~Autosave() {
  runner_.reset(); // when what it writes is written
  for (const LeftWork& work : left_) forget(work);
  if (lock_) forget({folder_, {}, {}, {}, {}, lock_});
}

QString Autosave::standardRoot() {
  return QDir(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)).filePath("recovery");
}

std::vector<LeftWork> Autosave::left(const QString& root) {
  std::vector<LeftWork> all;
  for (const QString& name : QDir(root).entryList(QDir::Dirs | QDir::NoDotAndDotDot)) {
    const QDir folder(QDir(root).filePath(name));
    const auto lock = lockOf(folder.path());
    if (!lock->tryLock(0)) continue; // its window is open, or another one offers it
    const LeftWork work = workIn(folder, lock);
    if (work.project || !work.recordings.isEmpty())
      all.push_back(work);
    else
      forget(work); // nothing was unsaved
  }
  std::sort(all.begin(), all.end(), [](const LeftWork& a, const LeftWork& b) { return a.saved > b.saved; });
  return all;
}

QByteArray Autosave::project(const LeftWork& work) {
  return QByteArray::fromStdString(readFile(QDir(work.folder).filePath(kProject).toStdString()));
}

QString Autosave::results(const LeftWork& work) {
  return QDir(work.folder).filePath(kResults);
}

void Autosave::forget(const LeftWork& work) {
  QDir folder(work.folder);
  for (const char* name : {kProject, kFile, kRecordings}) folder.remove(name);
  QDir(results(work)).removeRecursively();
  work.lock->unlock(); // last: nobody else can have taken it meanwhile
  folder.rmdir(work.folder);
}

void Autosave::forgetRecordings(const LeftWork& work) {
  QFile::remove(QDir(work.folder).filePath(kRecordings));
}

void Autosave::takeOver(const LeftWork& work) {
  leaveFolder();
  folder_ = work.folder;
  lock_ = work.lock;
  attempt([this] { keepRecordings(); });
  changed();
}

std::filesystem::path Autosave::at(const char* name) const {
  return QDir(folder_).filePath(name).toStdString();
}

/// Throws Error.
void Autosave::makeFolder() {
  for (int tried = 0; tried < kTries && !lock_; ++tried) {
    folder_ = QDir(root_).filePath(QUuid::createUuid().toString(QUuid::WithoutBraces));
    if (!QDir().mkpath(folder_)) throw Error(root_.toStdString() + ": a folder cannot be created there");
    if (const auto lock = lockOf(folder_); lock->tryLock(0)) lock_ = lock;
  }
  if (!lock_) throw Error(root_.toStdString() + ": a folder cannot be locked there");
}

/// What it holds is of a project that was left: it is not offered any more, and goes.
void Autosave::leaveFolder() {
  kept_.clear();
  keptResults_ = {};
  if (!lock_) return;
  std::error_code ignored;
  std::filesystem::remove(at(kProject), ignored);
  std::filesystem::remove(at(kRecordings), ignored);
  left_.push_back({folder_, {}, {}, {}, {}, std::exchange(lock_, nullptr)});
  runner_->cancel(); // what it writes now is written to its end
  runner_->start(tr("Removing copies"), [this, left = left_](const auto&, JobProgress&) {
    for (const LeftWork& work : left) forget(work);
    return [this] { left_.clear(); };
  });
}

void Autosave::changed() {
  if (!timer_.isActive()) timer_.start(kWait_ms); // not restarted at each change: continuous work is saved as well
}

void Autosave::attempt(const std::function<void()>& act) {
  try {
    act();
    said_.clear();
  } catch (const std::exception& error) {
    say(QString::fromUtf8(error.what()));
  }
}

void Autosave::keep() {
  if (!document_.unsaved()) return drop();
  attempt([this] {
    makeFolder();
    keepProject();
    keepResults();
  });
}

/// Once for each reason.
void Autosave::say(const QString& reason) {
  if (reason == std::exchange(said_, reason)) return;
  emit failed(tr("Unsaved work cannot be stored for recovery after a crash: %1").arg(reason));
}

void Autosave::keepProject() {
  const QByteArray text = projectText(document_.project());
  if (text == kept_) return;
  writeFile(at(kFile), workbench_.file().toStdString(), true);
  writeFile(at(kProject), text.toStdString(), true);
  kept_ = text;
}

void Autosave::keepResults() {
  const NetworkResults& now = network_.results();
  if (!network_.upToDate() || keptResults_.is(now)) return;
  if (runner_->running()) { // what it writes now is written to its end
    timer_.start(kWait_ms);
    return;
  }
  const std::filesystem::path folder = at(kResults);
  runner_->start(tr("Storing samples and network for recovery"),
                 [this, folder, results = now](const auto&, JobProgress&) {
                   saveResults(folder, results, resultFiles(folder));
                   return [this, results] { keptResults_.set(results); };
                 });
}

void Autosave::keepRecordings() {
  std::error_code none;
  if (recordings_.isEmpty()) {
    if (lock_) std::filesystem::remove(at(kRecordings), none);
    return;
  }
  makeFolder();
  QStringList files;
  for (const QString& file : recordings_) files << QFileInfo(file).absoluteFilePath();
  writeFile(at(kRecordings), files.join('\n').toStdString() + "\n", true);
}

/// All is saved: there is nothing to recover.
void Autosave::drop() {
  if (!lock_) return;
  std::error_code ignored;
  std::filesystem::remove(at(kProject), ignored);
  kept_.clear();
}

} // namespace palp
