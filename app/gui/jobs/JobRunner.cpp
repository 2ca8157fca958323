#include "app/gui/jobs/JobRunner.h"

#include "app/gui/jobs/CallLater.h"
#include "app/gui/jobs/ReturnMemory.h"
#include "app/study/Failure.h"
#include "model/base/Cancelled.h"

#include <utility>

namespace palp {

namespace {

constexpr int kReportEvery_ms = 60;

/// Runs `act`; returns the message of its exception, or an empty text. Every exception ends here, in its thread.
template <class Act> QString failureOf(const Act& act, bool& cancelled) {
  try {
    act();
  } catch (const Cancelled&) { // requested, not a failure
    cancelled = true;
  } catch (...) {
    return QString::fromStdString(failureInWords(std::current_exception()));
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

JobRunner::JobRunner(Orders orders, QObject* parent) : QObject(parent), orders_(orders) {
  timer_.setInterval(kReportEvery_ms);
  connect(&timer_, &QTimer::timeout, this, &JobRunner::report);
}

JobRunner::~JobRunner() = default; // the jthread asks the work to stop and waits for it

void JobRunner::start(const QString& title, Work work, Loss loss) {
  if (!running() && waiting_.empty()) return launch({title, std::move(work), loss});
  if (orders_ == Orders::Newest) {
    thread_.request_stop();
    waiting_.clear();
  }
  waiting_.push_back({title, std::move(work), loss});
}

QString JobRunner::loss() const {
  QStringList lost;
  const bool replaced = orders_ == Orders::Newest && !waiting_.empty();
  if (running() && !cancelled_ && !replaced && loss_ == Loss::Work) lost << title_;
  for (const Order& order : waiting_)
    if (order.loss == Loss::Work) lost << order.title;
  if (lost.isEmpty()) return {};
  return tr("%1: running; it will be cancelled and its result lost.").arg(lost.join(", "));
}

void JobRunner::cancel() {
  const std::deque<Order> dropping = std::exchange(waiting_, {});
  if (running()) thread_.request_stop();
  cancelled_ = running() && orders_ == Orders::Newest;
  if (orders_ == Orders::Each)
    for (const Order& order : dropping) emit dropped(order.title);
}

void JobRunner::launch(Order order) {
  title_ = order.title;
  loss_ = order.loss;
  progress_ = std::make_shared<JobProgress>();
  progress_->set(-1, title_.toStdString());
  thread_ = std::jthread([this, work = std::move(order.work), progress = progress_](const std::stop_token& stop) {
    Ending ending;
    ending.error = failureOf([&] { ending.taking = work(stop, *progress); }, ending.cancelled);
    returnMemory();
    callLater(*this, [this, ending = std::move(ending)] { end(ending); });
  });
  timer_.start();
  emit started(title_);
}

void JobRunner::end(const Ending& ending) {
  thread_.join();
  timer_.stop();
  const bool each = orders_ == Orders::Each;
  const bool wanted = each || (!cancelled_ && waiting_.empty());
  if (!ending.error.isEmpty() && wanted) emit failed(ending.error);
  if (ending.taking && wanted) {
    bool cancelled = false;
    const QString refused = failureOf(ending.taking, cancelled);
    if (!refused.isEmpty()) emit failed(refused);
  }
  if (each && ending.cancelled) emit dropped(title_);
  if (running()) return; // what was taken has started the next job already
  if (waiting_.empty()) {
    emit finished(std::exchange(cancelled_, false));
    return;
  }
  Order next = std::move(waiting_.front());
  waiting_.pop_front();
  cancelled_ = false;
  launch(std::move(next));
}

void JobRunner::report() {
  const JobProgress::Values values = progress_->values();
  emit progressed(values.share, QString::fromStdString(values.what));
}

} // namespace palp
