#pragma once

#include "app/study/live/send/ForceSender.h"

#include <cstdint>
#include <map>
#include <string>

namespace palp {

/// Receivers of live forces that come and go while frames stream, one sender each. All from any thread.
class ForceReceivers {
public:
  /// Opens a receiver (as openOutlet() takes it) in the calling thread, under a number that no other has; it gets each
  /// frame from then on. Throws Error.
  void open(std::uint64_t number, const std::string& where);
  /// Ends its sender, in the calling thread: frames that wait are dropped. Nothing where it is not open.
  void close(std::uint64_t number);
  /// A frame for all that are open; waits for none of them.
  void give(const std::shared_ptr<const LiveFrame>& frame) const;
  /// None where it is not open.
  [[nodiscard]] std::optional<SenderCounts> counts(std::uint64_t number) const;

private:
  mutable std::mutex mutex_;
  std::map<std::uint64_t, std::unique_ptr<ForceSender>> senders_;
};

} // namespace palp
