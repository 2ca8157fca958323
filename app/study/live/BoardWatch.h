#pragma once

#include "app/study/live/LiveSource.h"

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace palp {

/// The boards that are plugged in, looked for in a thread of its own when the system reports that some came or went.
class BoardWatch {
public:
  explicit BoardWatch(BoardAccess access = {});

  [[nodiscard]] std::vector<HidBoard> boards() const;
  /// Why the last look failed; empty where it did not.
  [[nodiscard]] std::string problem() const;
  /// False before the first look.
  [[nodiscard]] bool looked() const { return looks_ > 0; }
  /// While a board streams nobody enumerates, which would disturb it, unless a device has come or gone.
  void setQuiet(bool quiet) { quiet_ = quiet; }

private:
  void run(const std::stop_token& stop);

  BoardAccess access_;
  mutable std::mutex mutex_;
  std::vector<HidBoard> boards_;
  std::string problem_;
  std::atomic<int> looks_{0};
  std::atomic<bool> quiet_{false};
  std::jthread thread_; ///< last: it uses all of the above
};

} // namespace palp
