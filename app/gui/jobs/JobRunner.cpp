#include "app/gui/jobs/JobRunner.h"

#include <QMetaObject>

#include <malloc.h>

namespace palp {

namespace {

constexpr int kReportEvery_ms = 60;

/// A solve needs hundreds of megabytes for a second; the C library would keep most of them.
void returnMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

} // namespace

void JobProgress::set(double share, const std::string& what) {
  const std::lock_guard lock(mutex_);
  values_ = {share, what};
}

JobProgress::Values JobProgress::values() const {
  const std::lock_guard lock(mutex_);
  return values_;
}

JobRunner::JobRunner(QObject* parent) : QObject(parent) {
  timer_.setInterval(kReportEvery_ms);
  connect(&timer_, &QTimer::timeout, this, &JobRunner::report);
}

JobRunner::~JobRunner() = default; // the jthread asks the work to stop and waits for it

void JobRunner::start(const QString& title, Work work) {
  if (!running()) {
    launch({title, std::move(work)});
    return;
  }
  thread_.request_stop();
  waiting_ = Order{title, std::move(work)};
}

void JobRunner::cancel() {
  waiting_.reset();
  if (!running()) return;
  cancelled_ = true;
  thread_.request_stop();
}

void JobRunner::launch(Order order) {
  cancelled_ = false;
  title_ = order.title;
  progress_ = std::make_shared<JobProgress>();
  progress_->set(-1, title_.toStdString());
  thread_ = std::jthread([this, work = std::move(order.work), progress = progress_](const std::stop_token& stop) {
    Taking taking;
    QString error;
    try {
      taking = work(stop, *progress);
    } catch (const std::exception& refusal) {
      error = QString::fromStdString(refusal.what());
    }
    returnMemory();
    QMetaObject::invokeMethod(
        this, [this, taking = std::move(taking), error] { end(taking, error); }, Qt::QueuedConnection);
  });
  timer_.start();
  emit started(title_);
}

void JobRunner::end(const Taking& taking, const QString& error) {
  thread_.join();
  timer_.stop();
  const bool replaced = waiting_.has_value();
  if (!error.isEmpty() && !cancelled_ && !replaced) emit failed(error);
  if (taking && !cancelled_ && !replaced) taking();
  if (waiting_) {
    Order next = std::move(*waiting_);
    waiting_.reset();
    launch(std::move(next));
    return;
  }
  // What was taken may have started the next job already.
  if (!running()) emit finished(cancelled_);
}

void JobRunner::report() {
  const JobProgress::Values values = progress_->values();
  emit progressed(values.share, QString::fromStdString(values.what));
}

} // namespace palp
