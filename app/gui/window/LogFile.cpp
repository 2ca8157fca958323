#include "app/gui/window/LogFile.h"

#include "app/gui/jobs/CallLater.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QStandardPaths>

#include <utility>

namespace palp {

namespace {

constexpr qint64 kMostLog_bytes = 1000000;

// Qt hands its messages to a function alone.
std::recursive_mutex logGuard; ///< of the two below
LogFile* logOfQt = nullptr;
QtMessageHandler handlerBefore = nullptr;

void keepQtMessage(QtMsgType type, const QMessageLogContext& context, const QString& words) {
  const std::scoped_lock lock(logGuard);
  if (handlerBefore != nullptr) handlerBefore(type, context, words);
  if (logOfQt != nullptr && type != QtDebugMsg) logOfQt->add("Qt: " + words);
}

} // namespace

LogFile::LogFile(const QString& folder, QObject* parent) : QObject(parent) {
  if (folder.isEmpty()) return;
  QDir().mkpath(folder); // a failure is reported by the first line
  path_ = QDir(folder).filePath("palp-studio.log");
  works_ = true;
}

LogFile::~LogFile() {
  const std::scoped_lock lock(logGuard);
  if (logOfQt == this) {
    logOfQt = nullptr;
    qInstallMessageHandler(std::exchange(handlerBefore, nullptr));
  }
}

void LogFile::takeQtMessages() {
  const std::scoped_lock lock(logGuard);
  logOfQt = this;
  handlerBefore = qInstallMessageHandler(keepQtMessage);
}

void LogFile::add(const QString& sentence) {
  QString why;
  {
    const std::scoped_lock lock(writing_);
    if (!works_ || sentence.isEmpty()) return;
    QString line = sentence;
    line.replace('\n', ' ');
    why = write((QDateTime::currentDateTime().toString("yyyy-MM-dd HH:mm:ss  ") + line + "\n").toUtf8());
    works_ = why.isEmpty();
  }
  if (!why.isEmpty())
    callLater(*this, [this, why] {
      emit failed(tr("Messages are not saved to a file: %1 cannot be written: %2.").arg(path_, why));
    });
}

QString LogFile::write(const QByteArray& line) {
  QFile file(path_);
  if (file.size() > kMostLog_bytes) {
    QFile::remove(path_ + ".1");
    QFile::rename(path_, path_ + ".1");
  }
  // Each line by a file of its own and at the end: another window may write to it, or move it away.
  const bool whole =
      file.open(QIODevice::WriteOnly | QIODevice::Append | QIODevice::Unbuffered) && file.write(line) == line.size();
  if (whole) return {};
  return file.error() == QFile::NoError ? tr("the disk is full") : file.errorString();
}

QString LogFile::standardFolder() {
  return QDir(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)).filePath("log");
}

} // namespace palp
