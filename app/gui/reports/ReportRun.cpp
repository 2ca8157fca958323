#include "app/gui/reports/ReportRun.h"

#include <QProcessEnvironment>

#include <csignal>

namespace palp {

namespace {

constexpr int kEndWithin_ms = 3000;
constexpr int kInterrupted = 130; // of a shell's child after Ctrl-C
constexpr int kNoResult = 1;

} // namespace

ReportRun::ReportRun(QObject* parent) : QObject(parent) {
  process_.setProcessChannelMode(QProcess::MergedChannels);
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("PALP_PROGRESS_LINES", "1");
  process_.setProcessEnvironment(environment);
  connect(&process_, &QProcess::readyRead, this, &ReportRun::read);
  connect(&process_, &QProcess::finished, this, &ReportRun::end);
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) emit ended(Ending::NotStarted); // else finished() comes as well
  });
}

ReportRun::~ReportRun() {
  kill();
}

void ReportRun::kill() {
  process_.disconnect(this);
  if (!running()) return;
  process_.terminate();
  if (!process_.waitForFinished(kEndWithin_ms)) process_.kill();
}

void ReportRun::start(const QString& program, const QStringList& arguments) {
  cancelled_ = false;
  clock_.start();
  process_.start(program, arguments);
}

void ReportRun::cancel() {
  if (!running()) return;
  cancelled_ = true;
  ::kill(static_cast<pid_t>(process_.processId()), SIGINT);
}

void ReportRun::read() {
  while (process_.canReadLine()) say(QString::fromUtf8(process_.readLine()).trimmed());
}

/// "progress DONE TOTAL WHAT", or something for the user.
void ReportRun::say(const QString& line) {
  const QStringList words = line.split(' ');
  if (words.size() < 3 || words.front() != "progress") {
    if (!line.isEmpty()) emit said(line);
    return;
  }
  const double total = words[2].toDouble();
  if (total > 0) emit progressed(words[1].toDouble() / total, words.mid(3).join(' '));
}

void ReportRun::end(int status, QProcess::ExitStatus how) {
  read();
  say(QString::fromUtf8(process_.readAll()).trimmed()); // a last line without an end
  if (how == QProcess::NormalExit && status == 0)
    emit ended(Ending::Done);
  else if (cancelled_)
    emit ended(Ending::Cancelled);
  else
    emit ended(how == QProcess::NormalExit && (status == kInterrupted || status == kNoResult) ? Ending::NoResult
                                                                                              : Ending::Failed);
}

} // namespace palp
