#pragma once

#include "app/gui/project/LiveSettings.h"
#include "app/study/live/send/ForceReceivers.h"

#include <future>

namespace palp {

/// The status of one receiver.
struct SendingState {
  enum class Kind { Off, Opening, Sending, Refused };
  Kind kind = Kind::Off;
  std::uint64_t sent = 0, dropped = 0; ///< since it was opened
  std::string problem;                 ///< why it was refused
  std::string to;                      ///< where it goes: not to an existing file, but to a new one next to it
};

/// Keeps the receivers open that the settings ask for. Opening and ending take their time in threads of their own:
/// none of these calls waits.
class LiveSending {
public:
  /// Opens what is switched on and was not, ends what is switched off or gone.
  void follow(const std::vector<LiveReceiver>& wanted);
  /// Of each receiver, in the order of the settings. Looks whether those that open have come so far.
  [[nodiscard]] std::vector<SendingState> states(const std::vector<LiveReceiver>& wanted);
  /// None that was switched off is still ending.
  [[nodiscard]] bool settled() const;
  /// Some receiver is switched on.
  [[nodiscard]] bool on() const { return !open_.empty(); }
  /// What the session calls with each frame.
  [[nodiscard]] std::function<void(const std::shared_ptr<const LiveFrame>&)> taker() const;

private:
  struct Open {
    std::uint64_t number = 0;
    std::future<std::string> opening; ///< gives the refusal; empty: it sends
    std::string problem, to;
  };
  std::shared_ptr<ForceReceivers> receivers_ = std::make_shared<ForceReceivers>();
  std::map<std::string, Open> open_; ///< by address
  std::uint64_t numbers_ = 0;        ///< that were given
  std::vector<std::future<void>> closing_;
};

} // namespace palp
