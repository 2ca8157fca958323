#include "app/study/live/send/ForceReceivers.h"

#include <chrono>
#include <utility>

namespace palp {

void ForceReceivers::open(std::uint64_t number, const std::string& where) {
  auto sender = std::make_unique<ForceSender>(openOutlet(where, false, false));
  const std::lock_guard lock(mutex_);
  senders_.emplace(number, std::move(sender));
}

void ForceReceivers::close(std::uint64_t number) {
  std::unique_ptr<ForceSender> ending; // ends without the lock: frames go on meanwhile
  {
    const std::lock_guard lock(mutex_);
    const auto found = senders_.find(number);
    if (found == senders_.end()) return;
    ending = std::move(found->second);
    senders_.erase(found);
  }
}

void ForceReceivers::give(const std::shared_ptr<const LiveFrame>& frame) const {
  const double unix_s = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  const std::lock_guard lock(mutex_);
  for (const auto& [number, sender] : senders_) sender->give(frame, unix_s);
}

std::optional<SenderCounts> ForceReceivers::counts(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  const auto found = senders_.find(number);
  if (found == senders_.end()) return {};
  return found->second->counts();
}

} // namespace palp
