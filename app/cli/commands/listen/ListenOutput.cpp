#include "app/cli/commands/listen/ListenOutput.h"

#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace palp {

namespace {

using FrameJson = nlohmann::ordered_json;

std::vector<double> listOf(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const auto all = values.reshaped(); // one view: its iterators belong together
  return {all.begin(), all.end()};
}

FrameJson latencyJson(const LatencySummary& latency) {
  return {{"p50", 1e3 * latency.p50_s}, {"p99", 1e3 * latency.p99_s}, {"max", 1e3 * latency.longest_s}};
}

const std::string& reasonOf(const LiveFrame& live, const std::string& problem) {
  return live.forces.reason.empty() ? problem : live.forces.reason;
}

/// A dash where a component is not measured.
void printForce(const Eigen::Vector3d& force_N) {
  std::printf("  (");
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (axis > 0) std::printf(" ");
    std::fputs(std::isfinite(force_N(axis)) ? withSign(withDecimals(force_N(axis), 3)).c_str() : "-", stdout);
  }
  std::printf(") N");
}

/// Whether the board's read-out can be held against the network's.
void tellReadout(Session& session, const LiveStatus& status, const std::optional<Readout>& networks) {
  if (!status.info) return;
  const std::optional<Readout>& boards = status.info->readout;
  session.result["readout"] = boards ? FrameJson(kReadouts.name(*boards)) : FrameJson();
  if (networks && !boards)
    warnOnce(session,
             "the board does not report its read-out; the network was trained for " + kReadouts.name(*networks));
}

} // namespace

void ListenTally::add(const LiveFrame& live) {
  ++frames;
  if (!live.forces.valid) {
    reason = live.forces.reason;
    return;
  }
  ++forces;
  if (!live.forces.doubted && live.forces.doubt.empty()) return;
  ++doubted;
  if (!live.forces.doubt.empty()) doubt = live.forces.doubt;
}

void warnOnce(Session& session, const std::string& warning) {
  if (warning.empty() || std::find(session.warnings.begin(), session.warnings.end(), warning) != session.warnings.end())
    return;
  session.warnings.push_back(warning);
  std::cerr << "palp listen: " << warning << '\n';
}

FrameJson frameJson(const LiveFrame& live, const std::string& problem) {
  const DecodedForces& forces = live.forces;
  FrameJson json{{"t_s", live.frame.time_s},
                 {"frame", live.frame.number},
                 {"complete", live.frame.complete},
                 {"lost_reports", live.lostReports},
                 {"forces_N", listOf(forces.measuredAlone(forces.forces_N))}, // null: not measured
                 {"standard_deviation_N", listOf(forces.measuredAlone(forces.standardDeviation_N))},
                 {"valid", forces.valid},
                 {"latency_ms", 1e3 * live.latency_s}};
  if (forces.valid) {
    json["shown"] = forces.shown;
    json["outside_training_range"] = forces.outsideTrainingRange;
    if (forces.missingReadings > 0) json["missing_readings"] = forces.missingReadings;
    if (forces.misfit) json["misfit"] = *forces.misfit;
    if (!forces.doubt.empty()) json["doubt"] = forces.doubt;
    if (forces.area) {
      json["area"] = *forces.area;
      json["area_confidence"] = forces.areaConfidence;
    }
    if (forces.place_mm) json["place_mm"] = listOf(*forces.place_mm);
    if (forces.placeDeviation_mm) json["place_deviation_mm"] = listOf(*forces.placeDeviation_mm);
  } else if (!reasonOf(live, problem).empty()) {
    json["reason"] = reasonOf(live, problem);
  }
  if (!live.faults.empty()) json["faults"] = live.faults;
  if (live.frame.temperature_degC) json["temperature_degC"] = *live.frame.temperature_degC;
  return json;
}

void printFrame(const LiveStatus& status, const LiveFrame& live) {
  const DecodedForces& forces = live.forces;
  std::printf("%9s s  %-9s %7s reports/s  lost %llu  bad %llu", withDecimals(live.frame.time_s, 3).c_str(),
              name(status.state), withDecimals(status.reportsPerSecond, 1).c_str(),
              static_cast<unsigned long long>(status.counts.lost), static_cast<unsigned long long>(status.counts.bad));
  const Eigen::Matrix3Xd forces_N = forces.measuredAlone(forces.forces_N);
  for (Eigen::Index i = 0; forces.valid && i < forces_N.cols(); ++i) printForce(forces_N.col(i));
  if (const auto& place_mm = forces.place_mm)
    std::printf("  at (%s, %s) mm", withDecimals(place_mm->x(), 2).c_str(), withDecimals(place_mm->y(), 2).c_str());
  if (forces.valid && !forces.doubt.empty()) std::printf("  implausible: %s", forces.doubt.c_str());
  if (!forces.valid) std::printf("  no force: %s", reasonOf(live, status.decoderProblem).c_str());
  std::printf("\n");
  std::fflush(stdout);
}

void fillTotals(Session& session, const LiveStatus& status, const std::optional<Readout>& networksReadout) {
  FrameJson& result = session.result;
  tellReadout(session, status, networksReadout);
  result["source"] = status.source;
  result["state"] = name(status.state);
  if (!status.reason.empty()) result["reason"] = status.reason;
  result["frames"] = status.counts.frames;
  result["incomplete_frames"] = status.counts.incompleteFrames;
  result["reports"] = status.counts.reports;
  result["lost_reports"] = status.counts.lost;
  result["bad_reports"] = status.counts.bad;
  result["duplicate_reports"] = status.counts.duplicates;
  result["late_frames"] = status.lateFrames;
  result["restarts"] = status.counts.restarts;
  result["connections"] = status.connections;
  result["latency_ms"] = latencyJson(status.latency);
  result["decoding_ms"] = latencyJson(status.decoding);
  result["noise"] = status.noise;
  result["tared"] = status.tared;
  if (status.overflowed > 0)
    warnOnce(session, std::to_string(status.overflowed) + " frames were decoded but not printed in time");
  warnOnce(session, status.decoderProblem);
  warnOnce(session, status.recordingFailure);
  if (status.state == LiveState::Ended) warnOnce(session, status.reason);
}

void printTotals(std::ostream& out, const LiveStatus& status, const ListenTally& tally, const DeviationNote& note,
                 const std::string& record) {
  if (!note.sentence.empty()) out << "deviations: " << note.sentence << '\n';
  const ReportCounts& counts = status.counts;
  out << tally.frames << " frames, " << counts.incompleteFrames << " incomplete; " << tally.forces << " with a force, "
      << tally.doubted << " of them implausible" << (tally.doubt.empty() ? "" : " (" + tally.doubt + ")") << "; "
      << counts.reports << " reports, " << counts.lost << " lost, " << counts.bad << " corrupt";
  if (!record.empty())
    out << "; " << status.recordedReports << " reports written to " << record << ", " << status.recordingDropped
        << " entries not written";
  out << std::endl;
}

} // namespace palp
