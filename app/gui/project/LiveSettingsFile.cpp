#include "app/gui/project/LiveSettingsFile.h"

#include "app/gui/project/live/BoardCalibrationFile.h"
#include "io/ForceOutlet.h"

#include <QJsonArray>

#include <cmath>

namespace palp {

namespace {

constexpr int kLargestArea = 10000; ///< more than any design has

} // namespace

QJsonObject liveJson(const LiveSettings& live) {
  const SimulationSettings& simulation = live.simulation;
  QJsonObject json{
      {"source", QString::fromStdString(kLiveSourceKinds.name(live.source))},
      {"device", QString::fromStdString(live.device)},
      {"recording", QString::fromStdString(live.recording)},
      {"replay_speed", live.replaySpeed},
      {"rate_Hz", live.rate_Hz},
      {"row", live.row},
      {"network", QString::fromStdString(live.network)},
      {"tare_frames", live.tareFrames},
      {"arrow_mm_per_N", live.arrow_mm_per_N},
      {"change_percent", live.change_percent},
      {"window_s", live.window_s},
      {"force_scale", QString::fromStdString(kForceScales.name(live.forceScale))},
      {"force_N", live.force_N},
      {"alarm", QJsonObject{{"on", live.alarmOn},
                            {"force", QString::fromStdString(kForceQuantities.name(live.alarm.quantity))},
                            {"side", QString::fromStdString(kAlarmSides.name(live.alarm.side))},
                            {"limit_N", live.alarm.limit_N}}},
      {"simulation", QJsonObject{{"noise", simulation.noise},
                                 {"warming_degC", simulation.warming_degC},
                                 {"hysteresis_share", simulation.hysteresisShare},
                                 {"seed", static_cast<double>(simulation.seed)},
                                 {"open_row", simulation.openRow},
                                 {"open_column", simulation.openColumn},
                                 {"drop_every", simulation.dropEvery},
                                 {"held", simulation.held},
                                 {"held_area", simulation.heldArea},
                                 {"held_force_N", QJsonArray{simulation.heldForce_N[0], simulation.heldForce_N[1],
                                                             simulation.heldForce_N[2]}}}}};
  if (simulation.moving) {
    QJsonObject moving = json["simulation"].toObject();
    moving["moving"] = true;
    moving["held_place_mm"] = QJsonArray{simulation.heldPlace_mm[0], simulation.heldPlace_mm[1]};
    json["simulation"] = moving;
  }
  QJsonArray receivers;
  for (const LiveReceiver& receiver : live.receivers)
    receivers.append(
        QJsonObject{{"to", QString::fromStdString(receiver.to)}, {"on", receiver.on || receiver.heldBack}});
  if (!receivers.isEmpty()) json["send"] = receivers;
  if (const QJsonObject calibration = calibrationJson(live); !calibration.isEmpty()) json["calibration"] = calibration;
  return json;
}

namespace {

std::vector<LiveReceiver> receiversOf(const JsonPlace& place) {
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

LiveSettings liveOf(const JsonPlace& place) {
  place.onlyKeys({"source", "device", "recording", "replay_speed", "rate_Hz", "row", "network", "tare_frames",
                  "arrow_mm_per_N", "change_percent", "window_s", "simulation"},
                 {"force_scale", "force_N", "alarm", "send", "calibration"});
  LiveSettings live;
  live.source = place.at("source").named(kLiveSourceKinds);
  live.device = place.at("device").string();
  live.recording = place.at("recording").string();
  live.replaySpeed = place.at("replay_speed").number(0, 1000);
  live.rate_Hz = place.at("rate_Hz").integer(1, 8000);
  live.row = place.at("row").integer(-1, 31);
  live.network = place.at("network").string();
  live.tareFrames = place.at("tare_frames").integer(1, 100000);
  live.arrow_mm_per_N = place.at("arrow_mm_per_N").number(0.1, 100);
  live.change_percent = place.at("change_percent").number(1e-4, 100);
  live.window_s = place.at("window_s").number(1, 60);
  if (place.has("force_scale")) live.forceScale = place.at("force_scale").named(kForceScales);
  if (place.has("force_N")) live.force_N = place.at("force_N").number(0.01, 1000);
  if (place.has("alarm")) {
    const JsonPlace alarm = place.at("alarm");
    alarm.onlyKeys({"on", "force", "side", "limit_N"});
    live.alarmOn = alarm.at("on").boolean();
    live.alarm.quantity = alarm.at("force").named(kForceQuantities);
    live.alarm.side = alarm.at("side").named(kAlarmSides);
    live.alarm.limit_N = alarm.at("limit_N").number(-1000, 1000);
  }
  if (place.has("send")) live.receivers = receiversOf(place.at("send"));
  if (place.has("calibration")) readCalibration(place.at("calibration"), live);
  const JsonPlace simulation = place.at("simulation");
  simulation.onlyKeys({"noise", "warming_degC", "hysteresis_share", "seed", "open_row", "open_column", "drop_every"},
                      {"held", "held_area", "held_force_N", "moving", "held_place_mm"});
  live.simulation.noise = simulation.at("noise").number(0, 1);
  live.simulation.warming_degC = simulation.at("warming_degC").number(0, 100);
  live.simulation.hysteresisShare = simulation.at("hysteresis_share").number(0, 1);
  live.simulation.seed = static_cast<std::uint64_t>(simulation.at("seed").integer(0, 1000000000));
  live.simulation.openRow = simulation.at("open_row").integer(-1, 31);
  live.simulation.openColumn = simulation.at("open_column").integer(-1, 254);
  live.simulation.dropEvery = simulation.at("drop_every").integer(0, 100000);
  if (simulation.has("held")) live.simulation.held = simulation.at("held").boolean();
  if (simulation.has("held_area")) live.simulation.heldArea = simulation.at("held_area").integer(0, kLargestArea);
  if (simulation.has("held_force_N")) {
    const std::vector<double> force_N = simulation.at("held_force_N").numbers(3);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(std::abs(force_N[axis]) <= 1000)) simulation.at("held_force_N").refuse("three forces, -1000 to 1000 N");
      live.simulation.heldForce_N[axis] = force_N[axis];
    }
  }
  if (simulation.has("moving")) live.simulation.moving = simulation.at("moving").boolean();
  if (simulation.has("held_place_mm")) {
    const std::vector<double> place_mm = simulation.at("held_place_mm").numbers(2);
    live.simulation.heldPlace_mm = {place_mm[0], place_mm[1]};
  }
  return live;
}

QJsonArray boardsJson(const std::vector<LiveSettings>& boards) {
  QJsonArray array;
  for (const LiveSettings& board : boards) array.append(liveJson(board));
  return array;
}

std::vector<LiveSettings> boardsOf(const JsonPlace& place) {
  std::vector<LiveSettings> boards;
  for (const JsonPlace& board : place.list()) boards.push_back(liveOf(board));
  if (boards.size() >= Project::kMostBoards)
    place.refuse("at most " + std::to_string(Project::kMostBoards - 1) + " further boards");
  return boards;
}

} // namespace palp
