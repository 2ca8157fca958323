#include "app/gui/project/ProjectFields.h"

#include "app/gui/project/live/BoardCalibration.h"
#include "io/DecoderFile.h"
#include "io/ForceOutlet.h"
#include "io/SampleFile.h"
#include "model/base/Error.h"

#include <limits>
#include <memory>
#include <sstream>

namespace palp {

namespace {

/// What another format's reader returns; its refusal becomes one of `place`.
template <class Read> auto within(const JsonPlace& place, const std::string& expected, const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    place.refuse(expected + " (" + error.what() + ")");
  }
}

/// The lines of a sample file.
Json lines(const SampleSet& samples) {
  Json lines = Json::array();
  std::istringstream text(samplesText(samples));
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

SampleSet readLines(const JsonPlace& place) {
  std::string text;
  for (const JsonPlace& line : place.list()) text += line.string() + "\n";
  return within(place, "the lines of a sample file", [&] { return parseSamples(text, "frames"); });
}

Json readingsJson(const Eigen::Matrix3Xd& read_N) {
  Json all = Json::array();
  for (const Eigen::Vector3d force_N : read_N.colwise()) all.push_back(force_N.allFinite() ? jsonOf(force_N) : Json());
  return all;
}

Eigen::Matrix3Xd readReadings(const JsonPlace& place, Eigen::Index frames) {
  const std::vector<JsonPlace> entries = place.list();
  if (static_cast<Eigen::Index>(entries.size()) != frames)
    place.refuse("three forces or null for each of the " + std::to_string(frames) + " frames");
  Eigen::Matrix3Xd read_N = Eigen::Matrix3Xd::Constant(3, frames, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index frame = 0; frame < frames; ++frame) {
    const JsonPlace& entry = entries[static_cast<std::size_t>(frame)];
    if (!entry.isNull()) read_N.col(frame) = Eigen::Vector3d(entry.numbers(3).data());
  }
  return read_N;
}

/// Labelled frames and calibrated network of a board.
void calibration(JsonFields& fields, LiveSettings& live) {
  if (fields.form("frames", live.frames != nullptr)) {
    BoardFrames frames = live.frames ? *live.frames : BoardFrames{};
    fields.custom(
        "frames", JsonFields::kBranch, [&] { return lines(frames.samples); },
        [&](const JsonPlace& place) { frames.samples = readLines(place); });
    fields.custom(
        "network_read_N", JsonFields::kBranch, [&] { return readingsJson(frames.read_N); },
        [&](const JsonPlace& place) { frames.read_N = readReadings(place, frames.samples.size()); });
    if (fields.reading()) live.frames = std::make_shared<const BoardFrames>(std::move(frames));
  }
  if (fields.form("network", live.calibrated != nullptr)) {
    CalibratedNetwork network = live.calibrated ? *live.calibrated : CalibratedNetwork{};
    fields.custom(
        "network", JsonFields::kBranch, [&] { return Json::parse(networkText(network.decoder)); },
        [&](const JsonPlace& place) {
          network.decoder =
              within(place, "a network of Palp", [&] { return parseNetwork(place.asJson(), std::string("network")); });
        });
    fields.branch("name", network.name);
    if (fields.reading()) live.calibrated = std::make_shared<const CalibratedNetwork>(std::move(network));
  }
}

void alarm(JsonFields& fields, LiveSettings& live) {
  fields.field("on", live.alarmOn);
  fields.field("force", live.alarm.quantity, kForceQuantities);
  fields.field("side", live.alarm.side, kAlarmSides);
  fields.field("limit_N", live.alarm.limit_N, Within{-1000, 1000});
}

Json receiversJson(const std::vector<LiveReceiver>& receivers) {
  Json all = Json::array();
  for (const LiveReceiver& receiver : receivers)
    all.push_back({{"to", receiver.to}, {"on", receiver.on || receiver.heldBack}});
  return all;
}

std::vector<LiveReceiver> readReceivers(const JsonPlace& place) {
  std::vector<LiveReceiver> receivers;
  for (const JsonPlace& one : place.list()) {
    one.onlyKeys({"to", "on"});
    LiveReceiver receiver{one.at("to").string(), one.at("on").boolean()};
    receiver.heldBack = receiver.on && !staysOnThisComputer(receiver.to); // a file may come from anybody
    receiver.on = receiver.on && !receiver.heldBack;
    for (const LiveReceiver& other : receivers)
      if (other.to == receiver.to) one.at("to").refuse("an address that no other receiver has");
    receivers.push_back(std::move(receiver));
  }
  if (receivers.size() > LiveSettings::kMostReceivers)
    place.refuse("at most " + std::to_string(LiveSettings::kMostReceivers) + " receivers");
  return receivers;
}

} // namespace

static void describe(JsonFields& fields, SimulationSettings& simulation) {
  fields.field("noise", simulation.noise, Within{0, 1});
  fields.field("warming_degC", simulation.warming_degC, Within{0, 100});
  fields.field("hysteresis_share", simulation.hysteresisShare, Within{0, 1});
  fields.field("seed", simulation.seed, Within{0, 1e9});
  fields.field("open_row", simulation.openRow, Within{-1, 31});
  fields.field("open_column", simulation.openColumn, Within{-1, 254});
  fields.field("drop_every", simulation.dropEvery, Within{0, 100000});
  fields.added("held", simulation.held);
  fields.added("held_area", simulation.heldArea, Within{0, 10000});
  fields.added("held_force_N", simulation.heldForce_N, Within{-1000, 1000});
  if (!fields.form("moving", simulation.moving)) return; // older versions read other projects
  fields.branch("moving", simulation.moving);
  fields.added("held_place_mm", simulation.heldPlace_mm);
}

void describe(JsonFields& fields, LiveSettings& live) {
  fields.field("source", live.source, kLiveSourceKinds);
  fields.field("device", live.device);
  fields.field("recording", live.recording);
  fields.field("replay_speed", live.replaySpeed, Within{0, 1000});
  fields.field("rate_Hz", live.rate_Hz, Within{1, 8000});
  fields.field("row", live.row, Within{-1, 31});
  fields.field("network", live.network);
  fields.field("tare_frames", live.tareFrames, Within{1, 100000});
  fields.field("arrow_mm_per_N", live.arrow_mm_per_N, Within{0.1, 100});
  fields.field("change_percent", live.change_percent, Within{1e-4, 100});
  fields.field("window_s", live.window_s, Within{1, 60});
  fields.added("force_scale", live.forceScale, kForceScales);
  fields.added("force_N", live.force_N, Within{0.01, 1000});
  fields.group("alarm", false, [&](JsonFields& inner) { alarm(inner, live); });
  fields.custom(
      "send", {false, false, !live.receivers.empty()}, [&] { return receiversJson(live.receivers); },
      [&](const JsonPlace& place) { live.receivers = readReceivers(place); });
  fields.group("calibration", false, [&](JsonFields& inner) { calibration(inner, live); });
  fields.field("simulation", live.simulation);
}

} // namespace palp
