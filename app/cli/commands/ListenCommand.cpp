#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/cli/commands/ListenSenders.h"
#include "app/cli/commands/ListenSimulation.h"
#include "app/cli/commands/listen/ListenDevice.h"
#include "app/cli/commands/listen/ListenLabel.h"
#include "app/cli/commands/listen/ListenOutput.h"
#include "app/study/live/BoardCheck.h"
#include "app/study/live/LiveSession.h"
#include "app/study/live/LiveSource.h"
#include "app/study/live/trust/DeviationNote.h"
#include "io/AtomicFile.h"
#include "io/DecoderFile.h"
#include "io/DesignFile.h"
#include "io/Fingerprint.h"
#include "io/StrictJson.h"

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

struct ListenArguments {
  bool list = false, check = false;
  std::string device, replay, network, design, record, usb = "1209:0001", speed = "1";
  SimulationArguments simulation;
  std::string frames = "0", seconds = "0", tare = "0", row;
  LabelArguments label;
  bool force = false;
  SendOptions send;
};

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
                     "; give the design that the network was trained for");
  options.tareFrames = wholeNumber("--tare", arguments.tare, 0, 100'000);
  options.ringFrames = 8192;
  return options;
}

/// Sets what the session reads; what is known of its sensor.
DecodedSensor setSource(LiveOptions& options, const ListenArguments& arguments) {
  const std::string design = options.design ? designFingerprint(*options.design) : "";
  if (!arguments.simulation.on && arguments.replay.empty()) {
    requireDevice(arguments.device, arguments.usb);
    options.open = [id = usbOption(arguments.usb), device = arguments.device] { return openBoard(id, device); };
    return {design};
  }
  DecodedSensor sensor{design};
  auto once = std::make_shared<std::unique_ptr<ReportSource>>();
  if (arguments.simulation.on) {
    SimulatedSensor simulated = openSimulated(arguments.simulation, arguments.design);
    *once = std::move(simulated.source);
    sensor = {simulated.designFingerprint, true};
  } else {
    options.replay = std::make_shared<ReplayControl>();
    options.waitForReader = true;
    options.replay->speed = numberUpTo("--speed", arguments.speed, 1000);
    *once = std::make_unique<ReplaySource>(arguments.replay, options.replay);
  }
  options.reconnect = false;
  options.open = [once] { return std::move(*once); };
  return sensor;
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
  if (!session.json && session.result["boards"].empty()) std::cout << noBoardInWords({}, arguments.usb) << '\n';
  return Exit::Done;
}

/// When to stop.
struct Limits {
  std::uint64_t frames = 0; ///< 0: none
  double seconds = 0;       ///< 0: none
};

/// What takes part in a session in addition to it.
struct Listening {
  const ListenArguments& arguments;
  Session& session;
  const ListenSenders& senders;
  std::optional<LabelledMean> label;
  TareQuestion tare;
  const std::optional<Decoder>& decoder;
  DecodedSensor sensor;
  DeviationNote note; ///< of the first frame that gave a force
  ListenTally tally;
  bool recording = false; ///< was begun
};

/// Errors are printed when they occur, on standard error.
void warnOfStatus(Listening& all, const LiveStatus& status) {
  warnOnce(all.session, status.decoderProblem);
  warnOnce(all.session, status.recordingFailure);
  for (const std::string& failure : all.senders.failures()) warnOnce(all.session, failure);
}

/// From the first force: whether a recording is of a simulated board, and what its deviation includes.
void judgeDeviation(Listening& all, const LiveFrame& live) {
  if (!all.decoder || !live.forces.valid || all.tally.forces > 0) return;
  if ((live.frame.flags & ReadingFlag::Simulated) != 0) all.sensor.simulated = true;
  all.note = deviationNote(*all.decoder, all.sensor);
  if (!all.note.brief.empty()) warnOnce(all.session, all.note.sentence);
}

void takeFrame(Listening& all, const LiveStatus& status, const LiveFrame& live, double& line_s) {
  judgeDeviation(all, live);
  all.tally.add(live);
  all.tare.add(live.forces);
  if (all.label && !status.taring) all.label->add(live.forces);
  if (all.session.json) {
    std::cout << jsonText(frameJson(live, status.decoderProblem)) << '\n';
  } else if (!all.arguments.send.takeStandardOutput() && hostClock_s() > line_s + kLineInterval_s) {
    line_s = hostClock_s();
    printFrame(status, live);
  }
}

/// What was requested and not done, as text; empty where all was done.
std::vector<std::string> undone(const Listening& all, const LiveStatus& status, bool decodes, int tareFrames) {
  std::vector<std::string> words;
  if (status.counts.reports > 0 && all.tally.frames == 0)
    words.push_back("no frame was read: " + std::to_string(status.counts.bad) + " of " +
                    std::to_string(status.counts.reports) + " reports are corrupt, " +
                    std::to_string(status.counts.stale) + " of another configuration");
  if (decodes && status.decoderProblem.empty() && all.tally.frames > 0 && all.tally.forces == 0)
    words.push_back("no frame gave a force: " + all.tally.reason);
  if (!decodes && !all.arguments.send.to.empty())
    words.emplace_back("--send: no forces were sent, because no --network is given");
  if (tareFrames > 0 && !status.tared)
    words.push_back("--tare: not tared: " +
                    (decodes ? std::to_string(tareFrames) + " frames at rest are needed" : "no --network is given"));
  if (!all.arguments.record.empty() && !all.recording) words.push_back("--record: nothing was recorded");
  return words;
}

/// Prints what comes until a limit, the end of the recording or Ctrl-C; returns when the source ended well.
bool listen(LiveSession& live, Listening& all, const Limits& limits) {
  const ListenArguments& arguments = all.arguments;
  const double start_s = hostClock_s();
  double line_s = 0;
  LiveState reported = LiveState::Streaming;
  double lost_s = start_s; // when it streamed last
  while (!all.session.stop.stop_requested()) {
    const LiveStatus status = live.status(); // before the frames: what ended has nothing to add
    if (status.state == LiveState::Streaming) lost_s = hostClock_s();
    // A board that is plugged in responds immediately: a short search is not reported.
    const bool lasts = status.state != LiveState::Searching || hostClock_s() - lost_s > kPatience_s;
    if (status.state != reported && status.state != LiveState::Ended && lasts) {
      const bool none = status.connections == 0 && status.state == LiveState::Searching;
      const std::string why = none ? noBoardInWords(arguments.device, arguments.usb) : status.reason;
      std::cerr << "palp listen: " << name(status.state) << (why.empty() ? "" : ": ") << why << '\n';
      reported = status.state;
    }
    if (!arguments.record.empty() && !all.recording && status.state == LiveState::Streaming) {
      live.startRecording(arguments.record, arguments.network.empty() ? "" : fingerprint(readFile(arguments.network)),
                          arguments.force);
      all.recording = true;
    }
    for (const auto& frame : live.drain()) {
      takeFrame(all, status, *frame, line_s);
      if (limits.frames > 0 && all.tally.frames >= limits.frames) return true;
    }
    warnOfStatus(all, status);
    if (all.session.json) std::cout << std::flush;
    if (all.label && all.label->done()) return true;
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

/// Lets the board run for a while and judges it; a recording by its own time, and no longer than it lasts.
Exit check(LiveSession& live, const ListenArguments& arguments, Session& session, double seconds,
           const ReplayControl* replay) {
  const double start_s = hostClock_s();
  while (hostClock_s() - start_s < seconds && !session.stop.stop_requested() &&
         (replay == nullptr || live.status().state != LiveState::Ended)) {
    live.drain();
    std::this_thread::sleep_for(kDrainInterval);
  }
  const double took_s = replay != nullptr ? replay->position_s.load() : hostClock_s() - start_s;
  const LiveStatus status = live.status();
  fillTotals(session, status);
  bool all = true;
  session.result["checks"] = Json::array();
  for (const BoardCheckResult& result : checkBoard(status, took_s, descriptorOf(arguments, status.source))) {
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
  throw UsageError("--row: this source cannot scan one row-wire only");
}

/// Prints the totals; whether everything requested was done.
bool finish(LiveSession& live, Listening& all, int tareFrames) {
  const std::optional<Decoder>& decoder = all.decoder;
  live.stop();
  all.senders.finish(all.session);
  const LiveStatus status = live.status();
  bool done = status.recordingFailure.empty() && (!decoder || status.decoderProblem.empty()) &&
              all.senders.failures().empty() && status.counts.reports > 0;
  fillTotals(all.session, status, decoder ? decoder->readout : std::nullopt);
  if (!all.note.sentence.empty()) all.session.result["deviation_note"] = all.note.sentence;
  warnOfStatus(all, status);
  for (const std::string& words : undone(all, status, decoder.has_value(), tareFrames)) {
    warnOnce(all.session, words);
    done = false;
  }
  const bool free = !all.arguments.send.takeStandardOutput();
  if (!all.session.json)
    printTotals(free ? std::cout : std::cerr, status, all.tally, all.note, all.recording ? all.arguments.record : "");
  if (all.label && !all.label->append(all.session, all.arguments.force)) {
    warnOnce(all.session, "--label: no frame had a force; nothing was added to " + all.arguments.label.append);
    done = false;
  }
  return done;
}

void requireOneUse(const ListenArguments& arguments, const Session& session) {
  const int sources = static_cast<int>(!arguments.device.empty()) + static_cast<int>(!arguments.replay.empty()) +
                      static_cast<int>(arguments.simulation.on);
  if (sources > 1) throw UsageError("--device, --replay and --simulate exclude each other; give one of them");
  if (arguments.check && !arguments.record.empty())
    throw UsageError("--record: not together with --check, which records nothing");
  if (session.json && arguments.send.takeStandardOutput())
    throw UsageError("--send csv:-: not together with --json, which also writes to standard output");
}

void requireFiles(const ListenArguments& arguments) {
  if (!arguments.record.empty()) {
    requireNoStream("--record", arguments.record);
    requireWritable(arguments.record, arguments.force);
  }
  if (!arguments.label.append.empty()) {
    requireNoStream("--append", arguments.label.append);
    requireWritable(arguments.label.append, true);
  }
}

Exit run(const ListenArguments& arguments, Session& session) {
  session.indent = -1; // JSON Lines
  requireOneUse(arguments, session);
  if (arguments.list) return listBoards(arguments, session);
  const double seconds = numberUpTo("--seconds", arguments.seconds, 1e9);
  const Limits limits{static_cast<std::uint64_t>(wholeNumber("--frames", arguments.frames, 0, 2'000'000'000)), seconds};
  requireFiles(arguments);
  LiveOptions options = liveOptions(arguments);
  const DecodedSensor sensor = setSource(options, arguments);
  const ListenSenders senders(arguments.send, arguments.force, options.replay != nullptr);
  options.alsoTo = senders.taker();
  options.waitForRecording = !arguments.record.empty();
  const std::optional<Decoder> decoder = options.decoder;
  const int tareFrames = options.tareFrames;
  Listening all{arguments,
                session,
                senders,
                labelledMean(arguments.label, options),
                TareQuestion(arguments.force ? 0 : tareFrames),
                decoder,
                sensor,
                {},
                {}};
  const std::shared_ptr<ReplayControl> replay = options.replay;
  LiveSession live(std::move(options));
  if (!arguments.row.empty()) configureRow(live, arguments.row);
  if (arguments.check) return check(live, arguments, session, seconds > 0 ? seconds : kCheck_s, replay.get());
  const bool well = listen(live, all, limits);
  return finish(live, all, tareFrames) && well ? Exit::Done : Exit::NoResult;
}

} // namespace

void addListen(Cli& cli) {
  auto arguments = std::make_shared<ListenArguments>();
  Command command = cli.command("listen", "Decodes forces from a live board, a recording or the simulated board.",
                                "palp listen --simulate --network network.json --tare 50 --seconds 10",
                                [arguments](Session& session) { return run(*arguments, session); });
  ListenArguments& a = *arguments;
  command.group("Source");
  command.flag("--list", a.list, "list the boards that are plugged in");
  command.flag("--check", a.check, "check a board against the protocol (for 5 s, or --seconds)");
  command.option("--device", a.device, "TEXT", "serial number or path of the board (default: the first one)");
  command.option("--usb", a.usb, "VENDOR:PRODUCT", "USB ID of the board (default 1209:0001)");
  command.option("--replay", a.replay, "FILE", "recording to play");
  command.option("--speed", a.speed, "NUMBER", "speed of the replay; 0 for as fast as possible (default 1)");
  a.simulation.declare(command);
  command.group("Network");
  command.option("--network", a.network, "FILE",
                 "network trained with --input resistance (default with --simulate: one for the paper's design)");
  command.option("--design", a.design, "DESIGN", "design of the network, for the tare: a file, or paper (default)");
  command.option("--tare", a.tare, "N", "number of first frames averaged as the state at rest (default 0: no tare)");
  command.option("--row", a.row, "N", "scan only this row-wire");
  command.group("Output");
  command.option("--record", a.record, "FILE", "recording of the raw reports to write");
  command.flag(
      "--force", a.force,
      "overwrite the recording and a file of --send, tare under a load, add a label that the network contradicts");
  a.send.declare(command);
  command.group("End");
  command.option("--frames", a.frames, "N", "stop after N frames (default 0: no limit)");
  command.option("--seconds", a.seconds, "NUMBER", "stop after this time [s] (default 0: no limit)");
  a.label.declare(command);
}

} // namespace palp
