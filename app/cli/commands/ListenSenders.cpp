#include "app/cli/commands/ListenSenders.h"

#include "model/base/Error.h"

#include <algorithm>
#include <chrono>
#include <iostream>

namespace palp {

namespace {

constexpr std::chrono::milliseconds kLastFrames{2000}, kAfterCancel{100};

} // namespace

void SendOptions::declare(Command command) {
  command
      .option("--send", to, "RECEIVER",
              "send each frame's forces to udp:HOST:PORT (JSON, for PlotJuggler), osc:HOST:PORT, zmq:HOST:PORT, "
              "lsl:NAME (Lab Streaming Layer, needs its library) or csv:FILE (csv:- is standard output); may be "
              "repeated")
      .oneValueEach();
  command.flag("--send-to-many", toMany, "allow broadcast and multicast addresses in --send");
}

bool SendOptions::takeStandardOutput() const {
  return std::find(to.begin(), to.end(), "csv:-") != to.end();
}

ListenSenders::ListenSenders(const SendOptions& options, bool force, bool wait) : all_(std::make_shared<Receivers>()) {
  all_->where = options.to;
  for (const std::string& where : options.to) {
    try {
      all_->senders.push_back(std::make_unique<ForceSender>(openOutlet(where, options.toMany, force), wait));
    } catch (const Error& error) {
      throw Error(std::string("--send: ") + error.what());
    }
  }
}

std::function<void(const std::shared_ptr<const LiveFrame>&)> ListenSenders::taker() const {
  if (all_->senders.empty()) return {};
  return [all = all_](const std::shared_ptr<const LiveFrame>& frame) {
    const double unix_s = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    for (const auto& sender : all->senders) sender->give(frame, unix_s);
  };
}

std::vector<std::string> ListenSenders::failures() const {
  std::vector<std::string> failures;
  for (const auto& sender : all_->senders)
    if (std::string failure = sender->counts().failure; !failure.empty()) failures.push_back(std::move(failure));
  return failures;
}

void ListenSenders::finish(Session& session) const {
  if (all_->senders.empty()) return;
  session.result["sent_to"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < all_->senders.size(); ++i) {
    all_->senders[i]->finish(session.stop.stop_requested() ? kAfterCancel : kLastFrames);
    const SenderCounts counts = all_->senders[i]->counts();
    session.result["sent_to"].push_back({{"receiver", all_->where[i]},
                                         {"sent", counts.sent},
                                         {"dropped", counts.dropped},
                                         {"latency_ms",
                                          {{"p50", 1e3 * counts.latency.p50_s},
                                           {"p99", 1e3 * counts.latency.p99_s},
                                           {"max", 1e3 * counts.latency.longest_s}}}});
    if (!session.json)
      std::cerr << all_->where[i] << ": " << counts.sent << " frames passed to the system (receipt unknown), "
                << counts.dropped << " dropped, p99 " << 1e3 * counts.latency.p99_s << " ms from force to sending\n";
  }
}

} // namespace palp
