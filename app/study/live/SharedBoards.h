#pragma once

#include "app/study/live/LiveSource.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace palp {

/// The boards of one program that reads several together: each board is read by one session at a time, and "the first
/// board" is the first that no other session reads.
class SharedBoards : public std::enable_shared_from_this<SharedBoards> {
public:
  explicit SharedBoards(BoardAccess access = {}) : access_(std::move(access)) {}

  /// How one of the readers lists and opens boards. A reader that opens its own board again may still hold it.
  [[nodiscard]] BoardAccess accessOf(int reader);
  /// No other reader holds the board at this path.
  [[nodiscard]] bool free(const std::string& path, int reader) const;

private:
  friend class HeldBoard;
  struct Holder {
    int reader = 0;
    int times = 0;
  };
  std::unique_ptr<ReportSource> open(const std::string& device, int reader);
  bool take(const std::string& path, int reader);
  void release(const std::string& path);

  BoardAccess access_;
  mutable std::mutex mutex_;
  std::map<std::string, Holder> held_; ///< by the board's path
};

} // namespace palp
