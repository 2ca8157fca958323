#pragma once

#include "app/cli/Cli.h"
#include "app/study/live/LiveSession.h"
#include "app/study/live/trust/DeviationNote.h"

#include <iosfwd>

namespace palp {

/// What became of the frames of a session.
struct ListenTally {
  std::uint64_t frames = 0;
  std::uint64_t forces = 0;  ///< frames that gave a force
  std::uint64_t doubted = 0; ///< of these, those whose force can hardly be true
  std::string reason;        ///< why the last frame without a force had none
  std::string doubt;         ///< the last one

  void add(const LiveFrame& live);
};

/// Once, on standard error and among the warnings of --json.
void warnOnce(Session& session, const std::string& warning);

/// A frame of --json; `problem` is the reason for missing forces where the frame has none.
nlohmann::ordered_json frameJson(const LiveFrame& live, const std::string& problem);
/// A frame for people.
void printFrame(const LiveStatus& status, const LiveFrame& live);

/// The totals of --json, with what there is to warn of.
void fillTotals(Session& session, const LiveStatus& status, const std::optional<Readout>& networksReadout = {});
/// The same for people, with what the deviations hold; `record` is the file that was recorded to, or empty.
void printTotals(std::ostream& out, const LiveStatus& status, const ListenTally& tally, const DeviationNote& note,
                 const std::string& record);

} // namespace palp
