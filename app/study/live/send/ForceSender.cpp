#include "app/study/live/send/ForceSender.h"

#include "app/study/Failure.h"

#include <utility>

namespace palp {

namespace {

constexpr std::size_t kMostWaiting = 1024;         ///< a second at the usual rate
constexpr std::chrono::milliseconds kPatience{50}; ///< with one frame, before it is dropped

} // namespace

OutgoingFrame outgoing(const LiveFrame& live, double host_unix_s) {
  OutgoingFrame frame{live.frame.time_s,
                      host_unix_s,
                      live.frame.number,
                      live.forces.valid,
                      live.forces.measuredAlone(live.forces.forces_N),
                      live.forces.measuredAlone(live.forces.standardDeviation_N),
                      live.forces.area,
                      live.forces.place_mm,
                      live.forces.placeDeviation_mm,
                      !live.forces.doubt.empty()};
  return frame;
}

ForceSender::ForceSender(std::unique_ptr<ForceOutlet> outlet, bool waits) : outlet_(std::move(outlet)), waits_(waits) {
  if (outlet_->mayWait()) thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

ForceSender::~ForceSender() {
  thread_.request_stop();
  changed_.notify_all();
}

void ForceSender::give(std::shared_ptr<const LiveFrame> frame, double host_unix_s) {
  Waiting given{std::move(frame), host_unix_s, std::chrono::steady_clock::now()};
  if (!outlet_->mayWait()) {
    const std::lock_guard lock(direct_);
    return send(given);
  }
  {
    std::unique_lock lock(mutex_);
    if (waits_) changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting; });
    if (waiting_.size() >= kMostWaiting) {
      ++counts_.dropped;
      return;
    }
    waiting_.push_back(std::move(given));
  }
  changed_.notify_all();
}

SenderCounts ForceSender::counts() const {
  const std::lock_guard lock(mutex_);
  SenderCounts now = counts_;
  now.latency = {latency_.quantile_s(0.5), latency_.quantile_s(0.99), latency_.longest_s()};
  return now;
}

void ForceSender::finish(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, most, [this] { return waiting_.empty() && !sending_; });
  counts_.dropped += waiting_.size();
  waiting_.clear();
}

void ForceSender::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    sending_ = true;
    lock.unlock();
    send(next);
    lock.lock();
    sending_ = false;
    if (waiting_.empty() || waits_) changed_.notify_all();
    if (stop.stop_requested()) break;
  }
}

void ForceSender::send(const Waiting& next) {
  bool sent = false;
  std::string failure;
  try {
    sent = outlet_->send(outgoing(*next.frame, next.host_unix_s), kPatience);
    failure = outlet_->failure();
  } catch (...) { // the last catch of this thread: the frame is dropped
    failure = failureInWords(std::current_exception());
  }
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - next.given).count();
  const std::lock_guard lock(mutex_);
  counts_.failure = std::move(failure);
  if (sent) {
    ++counts_.sent;
    latency_.addMeasured(took_s);
  } else {
    ++counts_.dropped;
  }
}

} // namespace palp
