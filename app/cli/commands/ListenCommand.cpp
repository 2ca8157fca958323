#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/cli/commands/ListenSenders.h"
#include "app/cli/commands/ListenSimulation.h"
#include "app/study/decoding/Calibration.h"
#include "app/study/live/BoardCheck.h"
#include "app/study/live/LiveSession.h"
#include "app/study/live/LiveSource.h"
#include "io/AtomicFile.h"
#include "io/DecoderFile.h"
#include "io/DesignFile.h"
#include "io/Fingerprint.h"

#include <cstdio>
#include <iostream>
#include <memory>
#include <thread>

namespace palp {

namespace {

using Json = nlohmann::ordered_json;

constexpr auto kDrainInterval = std::chrono::milliseconds(5);
constexpr double kLineInterval_s = 0.5; // of the lines for people
constexpr double kCheck_s = 5;
constexpr double kPatience_s = 1; // with a board that is looked for
constexpr const char* kNoBoardYet = "; --list shows what is plugged in, --simulate plays a virtual board";

struct ListenArguments {
  bool list = false, check = false;
  std::string device, replay, network, design, record, usb = "1209:0001", speed = "1";
  SimulationArguments simulation;
  std::string frames = "0", seconds = "0", tare = "0", row, label, append, average = "50";
  bool force = false;
  SendOptions send;
};

UsbId usbOption(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto hex = [&](const std::string& part) {
    if (part.empty() || part.size() > 4 || part.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
      throw UsageError("--usb: '" + text + "'; allowed is VENDOR:PRODUCT in hexadecimal, for example 1209:0001");
    return static_cast<std::uint16_t>(std::stoul(part, nullptr, 16));
  };
  return {hex(text.substr(0, colon)), hex(colon == std::string::npos ? "" : text.substr(colon + 1))};
}

/// What can be opened once is opened here, so that its refusals come before the session begins.
LiveOptions liveOptions(const ListenArguments& arguments) {
  LiveOptions options;
  if (!arguments.network.empty())
    options.decoder = readNetwork(arguments.network);
  else if (arguments.simulation.on && arguments.simulation.samples.empty())
    options.decoder = readNetwork(shippedNetwork());
  if (!arguments.design.empty()) options.design = designOption(arguments.design);
  if (options.decoder && options.design && designFingerprint(*options.design) != options.decoder->designFingerprint)
    throw UsageError("--design " + arguments.design + " is of design " + designFingerprint(*options.design) +
                     ", the network of " + options.decoder->designFingerprint +
                     "; give the design that it was trained for");
  options.tareFrames = wholeNumber("--tare", arguments.tare, 0, 100'000);
  options.ringFrames = 8192;
  if (arguments.simulation.on || !arguments.replay.empty()) {
    std::shared_ptr<std::unique_ptr<ReportSource>> once;
    if (arguments.simulation.on) {
      once = std::make_shared<std::unique_ptr<ReportSource>>(openSimulated(arguments.simulation, arguments.design));
    } else {
      options.replay = std::make_shared<ReplayControl>();
      options.replay->speed = numberUpTo("--speed", arguments.speed, 1000);
      once = std::make_shared<std::unique_ptr<ReportSource>>(
          std::make_unique<ReplaySource>(arguments.replay, options.replay));
    }
    options.reconnect = false;
    options.open = [once] { return std::move(*once); };
    return options;
  }
  options.open = [id = usbOption(arguments.usb), device = arguments.device] { return openBoard(id, device); };
  return options;
}

std::vector<double> list(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const auto all = values.reshaped(); // one view: its iterators belong together
  return {all.begin(), all.end()};
}

Json frameJson(const LiveFrame& live) {
  const DecodedForces& forces = live.forces;
  Json json{{"t_s", live.frame.time_s},
            {"frame", live.frame.number},
            {"complete", live.frame.complete},
            {"lost_reports", live.lostReports},
            {"forces_N", list(forces.measuredAlone(forces.forces_N))}, // null: not measured
            {"standard_deviation_N", list(forces.measuredAlone(forces.standardDeviation_N))},
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
    if (forces.place_mm) json["place_mm"] = list(*forces.place_mm);
    if (forces.placeDeviation_mm) json["place_deviation_mm"] = list(*forces.placeDeviation_mm);
  } else if (!forces.reason.empty()) {
    json["reason"] = forces.reason;
  }
  if (!live.faults.empty()) json["faults"] = live.faults;
  if (live.frame.temperature_degC) json["temperature_degC"] = *live.frame.temperature_degC;
  return json;
}

Json latencyJson(const LatencySummary& latency) {
  return {{"p50", 1e3 * latency.p50_s}, {"p99", 1e3 * latency.p99_s}, {"max", 1e3 * latency.longest_s}};
}

void printLine(const LiveStatus& status, const LiveFrame& live) {
  std::printf("%9.3f s  %-9s %7.1f reports/s  lost %llu  bad %llu", live.frame.time_s, name(status.state),
              status.reportsPerSecond, static_cast<unsigned long long>(status.counts.lost),
              static_cast<unsigned long long>(status.counts.bad));
  for (Eigen::Index i = 0; live.forces.valid && i < live.forces.forces_N.cols(); ++i)
    std::printf("  (%+.3f %+.3f %+.3f) N", live.forces.forces_N(0, i), live.forces.forces_N(1, i),
                live.forces.forces_N(2, i));
  if (const auto& place_mm = live.forces.place_mm) std::printf("  at (%.2f, %.2f) mm", place_mm->x(), place_mm->y());
  if (!live.forces.valid) std::printf("  no force: %s", live.forces.reason.c_str());
  std::printf("\n");
  std::fflush(stdout);
}

/// Whether the board's read-out can be held against the network's.
void tellReadout(Session& session, const LiveStatus& status, const std::optional<Readout>& networks) {
  if (!status.info) return;
  const std::optional<Readout>& boards = status.info->readout;
  session.result["readout"] = boards ? Json(kReadouts.name(*boards)) : Json();
  if (networks && !boards)
    session.warnings.push_back("the board does not say its read-out; the network was trained for " +
                               kReadouts.name(*networks));
}

void fillTotals(Session& session, const LiveStatus& status, const std::optional<Readout>& networksReadout = {}) {
  Json& result = session.result;
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
    session.warnings.push_back(std::to_string(status.overflowed) + " frames were decoded but not printed in time");
  if (!status.decoderProblem.empty()) session.warnings.push_back(status.decoderProblem);
  if (!status.recordingFailure.empty()) session.warnings.push_back(status.recordingFailure);
}

Exit listBoards(const ListenArguments& arguments, Session& session) {
  session.result["boards"] = Json::array();
  for (const HidBoard& board : hidBoards(usbOption(arguments.usb))) {
    Json json{{"serial", board.serial}, {"path", board.path}, {"product", board.product}};
    json["permission"] = board.permission;
    session.result["boards"].push_back(json);
    if (!board.permission) session.warnings.push_back(board.path + ": no permission; " + permissionRemedy());
    if (!session.json)
      std::cout << board.serial << "  " << board.path << "  " << board.product
                << (board.permission ? "" : "  no permission: " + permissionRemedy()) << '\n';
  }
  if (!session.json && session.result["boards"].empty())
    std::cout << "no board with USB ID " << arguments.usb << " is plugged in\n";
  return Exit::Done;
}

/// The labelled frame that is asked for; none without --label.
std::optional<FrameAverage> labelledFrame(const ListenArguments& arguments, const LiveOptions& options) {
  if (arguments.label.empty() != arguments.append.empty())
    throw UsageError("--label and --append go together: --label AREA:FX,FY,FZ (or @X,Y:FX,FY,FZ) --append frames.csv");
  if (arguments.label.empty()) return {};
  if (!options.decoder) throw UsageError("--label needs --network: it says of which design the frames are");
  const SensorDesign design = options.design.value_or(paperDesign());
  if (arguments.label.starts_with('@')) {
    const auto [place_mm, force_N] = placedForceOption("--label", arguments.label.substr(1));
    return FrameAverage(*options.decoder, design, knownTouch(design, place_mm, force_N));
  }
  return FrameAverage(*options.decoder, design, {areaLoadOption("--label", arguments.label, design)});
}

/// When to stop.
struct Limits {
  std::uint64_t frames = 0; ///< 0: none
  double seconds = 0;       ///< 0: none
  int average = 0;          ///< labelled frames; 0: none
};

/// Prints what comes until a limit, the end of the recording or Ctrl-C; returns when the source ended well.
bool listen(LiveSession& live, const ListenArguments& arguments, Session& session, const Limits& limits,
            std::optional<FrameAverage>& average) {
  const double start_s = hostClock_s();
  double line_s = 0;
  std::uint64_t frames = 0;
  LiveState reported = LiveState::Streaming;
  double lost_s = start_s; // when it streamed last
  bool recording = arguments.record.empty();
  while (!session.stop.stop_requested()) {
    const LiveStatus status = live.status(); // before the frames: what ended has nothing to add
    if (status.state == LiveState::Streaming) lost_s = hostClock_s();
    // A board that is there answers at once: what lasts a moment is no news.
    const bool lasts = status.state != LiveState::Searching || hostClock_s() - lost_s > kPatience_s;
    if (status.state != reported && status.state != LiveState::Ended && lasts) {
      std::cerr << "palp listen: " << name(status.state) << (status.reason.empty() ? "" : ": ") << status.reason
                << (status.connections == 0 && status.state == LiveState::Searching ? kNoBoardYet : "") << '\n';
      reported = status.state;
    }
    if (!recording && status.state == LiveState::Streaming) {
      live.startRecording(arguments.record, arguments.network.empty() ? "" : fingerprint(readFile(arguments.network)),
                          arguments.force);
      recording = true;
    }
    for (const auto& frame : live.drain()) {
      ++frames;
      if (average && !status.taring && average->count() < limits.average) average->add(frame->forces);
      if (session.json) std::cout << frameJson(*frame).dump() << '\n';
      if (!session.json && !arguments.send.takeStandardOutput() && hostClock_s() > line_s + kLineInterval_s) {
        line_s = hostClock_s();
        printLine(status, *frame);
      }
      if (limits.frames > 0 && frames >= limits.frames) return true;
    }
    if (session.json) std::cout << std::flush;
    if (average && average->count() >= limits.average) return true;
    if (limits.seconds > 0 && hostClock_s() - start_s >= limits.seconds) return true;
    if (status.state == LiveState::Ended) return status.connections > 0;
    std::this_thread::sleep_for(kDrainInterval);
  }
  return true;
}

std::vector<std::uint8_t> descriptorOf(const ListenArguments& arguments, const std::string& source) {
  if (arguments.simulation.on || !arguments.replay.empty()) return {};
  for (const HidBoard& board : hidBoards(usbOption(arguments.usb)))
    if (source.find(board.path) != std::string::npos) return reportDescriptorOf(board);
  return {};
}

/// Lets the board run for a while and judges it.
Exit check(LiveSession& live, const ListenArguments& arguments, Session& session, double seconds) {
  const double start_s = hostClock_s();
  while (hostClock_s() - start_s < seconds && !session.stop.stop_requested()) {
    live.drain();
    std::this_thread::sleep_for(kDrainInterval);
  }
  const LiveStatus status = live.status();
  fillTotals(session, status);
  bool all = true;
  session.result["checks"] = Json::array();
  for (const BoardCheckResult& result :
       checkBoard(status, hostClock_s() - start_s, descriptorOf(arguments, status.source))) {
    all = all && result.passed;
    session.result["checks"].push_back({{"what", result.what}, {"passed", result.passed}, {"found", result.found}});
    if (!session.json)
      std::cout << (result.passed ? "passed  " : "FAILED  ") << result.what << ": " << result.found << '\n';
  }
  session.result["passed"] = all;
  return all ? Exit::Done : Exit::NoResult;
}

void configureRow(LiveSession& live, const std::string& row) {
  for (int i = 0; i < 200; ++i) { // the board is opened within milliseconds, or is not there
    const LiveStatus status = live.status();
    if (status.configuration) {
      BoardConfiguration wanted = *status.configuration;
      wanted.mode = BoardMode::SingleRow;
      wanted.rowMask = std::uint32_t{1} << wholeNumber("--row", row, 0, status.info->rowWires - 1);
      live.configure(wanted);
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw UsageError("--row: no board that can be asked to scan one row-wire");
}

Exit run(const ListenArguments& arguments, Session& session) {
  session.indent = -1; // JSON Lines
  const int sources = static_cast<int>(!arguments.device.empty()) + static_cast<int>(!arguments.replay.empty()) +
                      static_cast<int>(arguments.simulation.on);
  if (sources > 1) throw UsageError("--device, --replay and --simulate exclude each other; give one of them");
  if (arguments.list) return listBoards(arguments, session);
  const double seconds = numberUpTo("--seconds", arguments.seconds, 1e9);
  Limits limits{static_cast<std::uint64_t>(wholeNumber("--frames", arguments.frames, 0, 2'000'000'000)), seconds,
                wholeNumber("--average", arguments.average, 1, 100'000)};
  if (arguments.check && !arguments.record.empty()) throw UsageError("--record: not with --check, which keeps nothing");
  if (!arguments.record.empty()) {
    requireNoStream("--record", arguments.record);
    requireWritable(arguments.record, arguments.force);
  }
  if (!arguments.append.empty()) {
    requireNoStream("--append", arguments.append);
    requireWritable(arguments.append, true);
  }
  if (session.json && arguments.send.takeStandardOutput())
    throw UsageError("--send csv:-: standard output holds the JSON of --json; give one of the two");
  LiveOptions options = liveOptions(arguments);
  const ListenSenders senders(arguments.send, arguments.force);
  options.alsoTo = senders.taker();
  options.waitForRecording = !arguments.record.empty();
  std::optional<FrameAverage> average = labelledFrame(arguments, options);
  const std::optional<Readout> networksReadout = options.decoder ? options.decoder->readout : std::nullopt;
  LiveSession live(std::move(options));
  if (!arguments.row.empty()) configureRow(live, arguments.row);
  if (arguments.check) return check(live, arguments, session, seconds > 0 ? seconds : kCheck_s);
  const bool well = listen(live, arguments, session, limits, average);
  if (average && average->count() > 0) {
    appendFrames(arguments.append, average->sample());
    session.result["averaged_frames"] = average->count();
    session.result["file"] = arguments.append;
  }
  live.stop();
  senders.finish(session);
  const LiveStatus status = live.status();
  fillTotals(session, status, networksReadout);
  return well && status.counts.reports > 0 ? Exit::Done : Exit::NoResult;
}

} // namespace

void addListen(Cli& cli) {
  auto arguments = std::make_shared<ListenArguments>();
  Command command = cli.command("listen", "forces of a live board, a recording or the virtual board",
                                "palp listen --simulate --network network.json --tare 50 --seconds 10",
                                [arguments](Session& session) { return run(*arguments, session); });
  ListenArguments& a = *arguments;
  command.flag("--list", a.list, "show the boards that are plugged in");
  command.flag("--check", a.check, "judge a board by the protocol (5 s, or --seconds)");
  command.option("--device", a.device, "serial number or path of the board (default: the first)");
  command.option("--usb", a.usb, "USB ID of the board, VENDOR:PRODUCT (default 1209:0001)");
  command.option("--replay", a.replay, "recording to play");
  command.option("--speed", a.speed, "of the replay; 0 as fast as it can be read (default 1)");
  a.simulation.declare(command);
  command.option("--network", a.network,
                 "network that was trained with --input resistance (default with --simulate: the paper's)");
  command.option("--design", a.design, "design of the network, for tare (default: paper)");
  command.option("--tare", a.tare, "frames at the start that are averaged as rest (default 0: no tare)");
  command.option("--row", a.row, "scan this row-wire alone");
  command.option("--record", a.record, "record the raw reports to this file");
  command.flag("--force", a.force, "overwrite the recording, and a file of --send");
  a.send.declare(command);
  command.option("--frames", a.frames, "stop after so many frames (default 0: go on)");
  command.option("--seconds", a.seconds, "stop after so many seconds (default 0: go on)");
  command.option(
      "--label", a.label,
      "AREA:FX,FY,FZ: the known load now on the sensor, for palp calibrate; @X,Y:FX,FY,FZ [mm, N] a touch at a place");
  command.option("--append", a.append, "file of labelled frames to which the mean is added");
  command.option("--average", a.average, "frames of that mean (default 50)");
}

} // namespace palp
