#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>

namespace palp {

/// Passes counts of many threads to one callback, one call at a time and without a lock during the call: a thread that
/// comes while another one calls leaves its count to that one and continues its work.
class ProgressRelay {
public:
  explicit ProgressRelay(std::function<void(std::size_t)> callback) : callback_(std::move(callback)) {}

  /// Every count has been handed over when all calls of this have returned. An exception of the callback passes
  /// through; the callback is not called again then.
  void add(std::size_t count) {
    if (!callback_) return;
    std::unique_lock lock(mutex_);
    waiting_ += count;
    if (calling_) return;
    calling_ = true;
    while (waiting_ > 0) {
      const std::size_t some = std::exchange(waiting_, 0);
      lock.unlock();
      callback_(some);
      lock.lock();
    }
    calling_ = false;
  }

private:
  std::function<void(std::size_t)> callback_;
  std::mutex mutex_; ///< guards the two below
  std::size_t waiting_ = 0;
  bool calling_ = false;
};

} // namespace palp
