#pragma once

#include "app/cli/Cli.h"
#include "app/cli/Command.h"
#include "app/study/live/send/ForceSender.h"

#include <memory>
#include <string>
#include <vector>

namespace palp {

/// --send: the receivers of live forces, as often as wanted.
struct SendOptions {
  std::vector<std::string> to;
  bool toMany = false;
  void declare(Command command);
  /// Whether one of them is standard output, which then holds nothing else.
  [[nodiscard]] bool takeStandardOutput() const;
};

/// One sender a receiver; shared with the session that gives them its frames.
class ListenSenders {
public:
  /// `wait`: the frames come from a recording, which waits for files and pipes. Throws Error, which names the
  /// receiver.
  ListenSenders(const SendOptions& options, bool force, bool wait);

  /// What the session calls with each frame; empty where nobody receives.
  [[nodiscard]] std::function<void(const std::shared_ptr<const LiveFrame>&)> taker() const;
  /// Of those that take nothing any more, why.
  [[nodiscard]] std::vector<std::string> failures() const;
  /// Once the session has ended: waits for the last frames, and prints what was sent and dropped.
  void finish(Session& session) const;

private:
  struct Receivers {
    std::vector<std::string> where;
    std::vector<std::unique_ptr<ForceSender>> senders;
  };
  std::shared_ptr<Receivers> all_;
};

} // namespace palp
