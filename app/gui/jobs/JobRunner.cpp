#include "app/gui/jobs/JobRunner.h"

#include "app/gui/jobs/CallLater.h"
#include "app/gui/jobs/ReturnMemory.h"
#include "model/base/Cancelled.h"

namespace palp {

namespace {

constexpr int kReportEvery_ms = 60;

/// Runs `act`; what it threw, in words, else nothing. Whatever is thrown ends here: there is nobody above.
template <class Act> QString failureOf(const Act& act) {
  try {
    act();
  } catch (const Cancelled&) { // asked for, no failure
  } catch (const std::exception& failure) {
    return QString::fromStdString(failure.what());
  } catch (...) {
    return QObject::tr("Something failed and gave no reason.");
  }
  return {};
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
    const QString error = failureOf([&] { taking = work(stop, *progress); });
    returnMemory();
    callLater(*this, [this, taking = std::move(taking), error] { end(taking, error); });
  });
  timer_.start();
  emit started(title_);
}

void JobRunner::end(const Taking& taking, const QString& error) {
  thread_.join();
  timer_.stop();
  const bool wanted = !cancelled_ && !waiting_;
  if (!error.isEmpty() && wanted) emit failed(error);
  if (taking && wanted) {
    const QString refused = failureOf(taking);
    if (!refused.isEmpty()) emit failed(refused);
  }
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
