#include "app/gui/live/send/LiveSending.h"

#include "app/gui/live/recordings/RecordingName.h"
#include "app/study/Failure.h"

#include <algorithm>

namespace palp {

namespace {

template <class Value> bool isReady(const std::future<Value>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

/// Lines never replace a file: they go into one next to it with the date in its name, as recordings do.
std::string besideWhatIsThere(const std::string& to) {
  const std::string lines = "csv:";
  std::error_code unknown; // what cannot be looked at is refused when it is opened
  if (!to.starts_with(lines) || !std::filesystem::is_regular_file(to.substr(lines.size()), unknown)) return to;
  return lines + freeFile(to.substr(lines.size()), QDateTime::currentDateTime()).string();
}

} // namespace

void LiveSending::follow(const std::vector<LiveReceiver>& wanted) {
  std::erase_if(closing_, [](const std::future<void>& closing) { return isReady(closing); });
  const auto isWanted = [&](const std::string& to) {
    return std::any_of(wanted.begin(), wanted.end(), [&](const LiveReceiver& w) { return w.on && w.to == to; });
  };
  for (auto open = open_.begin(); open != open_.end();) {
    if (isWanted(open->first)) {
      ++open;
      continue;
    }
    // One that still opens is ended behind that.
    closing_.push_back(std::async(std::launch::async, [receivers = receivers_, number = open->second.number,
                                                       opening = std::move(open->second.opening)] {
      if (opening.valid()) opening.wait();
      receivers->close(number);
    }));
    open = open_.erase(open);
  }
  for (const LiveReceiver& receiver : wanted) {
    if (!receiver.on || open_.contains(receiver.to)) continue;
    Open& open = open_[receiver.to];
    open.number = ++numbers_;
    open.to = besideWhatIsThere(receiver.to);
    open.opening =
        std::async(std::launch::async, [receivers = receivers_, number = numbers_, to = open.to]() -> std::string {
          try {
            receivers->open(number, to);
            return {};
          } catch (...) {
            return failureInWords(std::current_exception());
          }
        });
  }
}

bool LiveSending::settled() const {
  return std::all_of(closing_.begin(), closing_.end(), [](const auto& closing) { return isReady(closing); });
}

std::vector<SendingState> LiveSending::states(const std::vector<LiveReceiver>& wanted) {
  std::vector<SendingState> states;
  for (const LiveReceiver& receiver : wanted) {
    SendingState state;
    if (const auto found = open_.find(receiver.to); receiver.on && found != open_.end()) {
      Open& open = found->second;
      if (open.opening.valid() && isReady(open.opening)) open.problem = open.opening.get();
      state.problem = open.problem;
      state.to = open.to;
      state.kind = open.opening.valid()   ? SendingState::Kind::Opening
                   : open.problem.empty() ? SendingState::Kind::Sending
                                          : SendingState::Kind::Refused;
      if (const auto counts = receivers_->counts(open.number)) {
        state.sent = counts->sent;
        state.dropped = counts->dropped;
        if (!counts->failure.empty()) state.kind = SendingState::Kind::Refused;
        if (!counts->failure.empty()) state.problem = counts->failure;
      }
    }
    states.push_back(std::move(state));
  }
  return states;
}

std::function<void(const std::shared_ptr<const LiveFrame>&)> LiveSending::taker() const {
  return [receivers = receivers_](const std::shared_ptr<const LiveFrame>& frame) { receivers->give(frame); };
}

} // namespace palp
