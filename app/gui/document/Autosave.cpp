#include "app/gui/document/Autosave.h"

#include "app/gui/document/Document.h"
#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/project/Workbench.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <QUuid>

#include <algorithm>

namespace palp {

namespace {

constexpr int kWait_ms = 2000; ///< from a change to its writing: what is typed and dragged meanwhile goes with it
constexpr const char* kLock = "lock";
constexpr const char* kProject = "project.json";
constexpr const char* kFile = "file.txt"; ///< the path of the project's own file
constexpr const char* kResults = "results";

/// Held by the window as long as it lives; left by one that was killed, and stale then.
std::unique_ptr<QLockFile> lockOf(const QString& folder) {
  auto lock = std::make_unique<QLockFile>(QDir(folder).filePath(kLock));
  lock->setStaleLockTime(0); // however long the window is open
  return lock;
}

} // namespace

Autosave::Autosave(Workbench& workbench, NetworkSession& network, Document& document, const QString& root,
                   QObject* parent)
    : QObject(parent), workbench_(workbench), network_(network), document_(document),
      folder_(QDir(root).filePath(QUuid::createUuid().toString(QUuid::WithoutBraces))) {
  if (!QDir().mkpath(folder_))
    throw Error(folder_.toStdString() + ": cannot be made; unsaved work is not kept for the case of a crash");
  lock_ = lockOf(folder_);
  lock_->tryLock(0);
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, &Autosave::keep);
  connect(&runner_, &JobRunner::failed, this, &Autosave::say);
  connect(&workbench, &Workbench::projectChanged, this, &Autosave::changed);
  connect(&document, &Document::unsavedChanged, this, &Autosave::changed);
}

Autosave::~Autosave() {
  runner_.cancel();
  lock_->unlock();
  QDir(folder_).removeRecursively();
}

QString Autosave::standardRoot() {
  return QDir(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)).filePath("recovery");
}

std::vector<LeftWork> Autosave::left(const QString& root) {
  std::vector<LeftWork> all;
  for (const QString& name : QDir(root).entryList(QDir::Dirs | QDir::NoDotAndDotDot)) {
    const QDir folder(QDir(root).filePath(name));
    const auto lock = lockOf(folder.path());
    if (!lock->tryLock(0)) continue; // its window is open
    const QFileInfo project(folder.filePath(kProject));
    if (!project.exists()) { // nothing was unsaved
      lock->unlock();
      QDir(folder).removeRecursively();
      continue;
    }
    LeftWork work{folder.path(), {}, project.lastModified()};
    if (QFileInfo::exists(folder.filePath(kFile)))
      work.file = QString::fromStdString(readFile(folder.filePath(kFile).toStdString()));
    all.push_back(work);
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
  QDir(work.folder).removeRecursively();
}

void Autosave::changed() {
  if (!timer_.isActive()) timer_.start(kWait_ms); // not anew at each change: work that goes on is kept as well
}

void Autosave::keep() {
  try {
    if (!document_.unsaved()) {
      drop();
      return;
    }
    const QByteArray text = projectText(document_.project());
    const QDir folder(folder_);
    if (text != kept_) {
      writeFile(folder.filePath(kFile).toStdString(), workbench_.file().toStdString(), true);
      writeFile(folder.filePath(kProject).toStdString(), text.toStdString(), true);
      kept_ = text;
    }
    keepResults();
  } catch (const std::exception& error) {
    say(QString::fromUtf8(error.what()));
  }
}

void Autosave::say(const QString& reason) {
  emit failed(tr("Unsaved work cannot be kept for the case of a crash: %1").arg(reason));
}

void Autosave::keepResults() {
  const NetworkResults& now = network_.results();
  if (!network_.upToDate() || keptResults_.is(now)) return;
  if (runner_.running()) { // what it writes now is written to its end
    timer_.start(kWait_ms);
    return;
  }
  const std::string folder = QDir(folder_).filePath(kResults).toStdString();
  runner_.start(tr("Keeping samples and network"), [this, folder, results = now](const auto&, JobProgress&) {
    saveResults(folder, results, resultFiles(folder));
    return [this, results] { keptResults_.set(results); };
  });
}

/// All is saved: there is nothing to recover.
void Autosave::drop() {
  if (kept_.isEmpty()) return;
  QFile::remove(QDir(folder_).filePath(kProject));
  kept_.clear();
}

} // namespace palp
