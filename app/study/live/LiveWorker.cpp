#include "app/study/live/LiveWorker.h"

#include "app/study/Failure.h"
#include "model/base/Error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

namespace {

constexpr auto kReadTimeout = std::chrono::milliseconds(100);
constexpr auto kSearchInterval = std::chrono::milliseconds(100);
constexpr double kStall_s = 0.25;
constexpr double kLate_s = 0.02;
constexpr int kBlindFrames = 25; // in a row without forces: fewer are lost reports
constexpr int kStaleBeforeAsking = 20;
constexpr double kAskAgain_s = 0.5;

ReportCounts sum(const ReportCounts& a, const ReportCounts& b) {
  return {a.reports + b.reports,       a.lost + b.lost,           a.bad + b.bad,
          a.duplicates + b.duplicates, a.backwards + b.backwards, a.stale + b.stale,
          a.restarts + b.restarts,     a.frames + b.frames,       a.incompleteFrames + b.incompleteFrames};
}

LatencySummary summary(const LatencyMeter& meter) {
  return {meter.quantile_s(0.5), meter.quantile_s(0.99), meter.longest_s()};
}

} // namespace

LiveWorker::LiveWorker(LiveOptions options, TakeFrame take) : options_(std::move(options)), give_(std::move(take)) {
  alarm_.set(options_.alarm);
}

void LiveWorker::step() {
  if (idle_ && !records()) return rest();
  const bool sought = options_.replay && options_.replay->sought();
  if (status_.state == LiveState::Ended && source_ && sought) status_.state = LiveState::Streaming;
  if (status_.state == LiveState::Ended) return std::this_thread::sleep_for(kReadTimeout / 10);
  guarded([this] { source_ ? read() : search(); });
}

/// While nobody looks: a board that streams would cost what reading it costs.
void LiveWorker::rest() {
  if (source_ && !options_.replay) {
    source_.reset();
    searched_ = false;
    status_.state = LiveState::Paused;
    status_.reason.clear();
    status_.reportsPerSecond = status_.framesPerSecond = 0;
  }
  std::this_thread::sleep_for(kReadTimeout);
}

void LiveWorker::guarded(const std::function<void()>& call) {
  try {
    call();
  } catch (const BoardError& gone) { // the board went during a command
    status_.lastEvent = gone.what(); // stays when the connection is made again
    disconnect(LiveState::Searching, gone.what());
  } catch (...) { // the last resort: whatever fails here must not end the program
    status_.lastEvent = failureInWords(std::current_exception());
    disconnect(LiveState::Refused, status_.lastEvent);
  }
}

void LiveWorker::search() {
  if (searched_ && !hotplug_.wait(kSearchInterval)) return;
  searched_ = true;
  std::unique_ptr<ReportSource> source;
  try {
    source = options_.open();
  } catch (...) { // tried again: the permission may be given, the file mended
    status_.state = LiveState::Refused;
    status_.reason = failureInWords(std::current_exception());
    return;
  }
  if (!source) { // also after a refusal: the board that was refused is gone
    otherProtocol_.reset();
    if (status_.state == LiveState::Refused) status_.reason.clear();
    status_.state = LiveState::Searching;
    return;
  }
  if (otherProtocol_ && *otherProtocol_ == BoardIdentity(source->name(), source->info())) return;
  otherProtocol_.reset();
  connect(std::move(source));
}

void LiveWorker::connect(std::unique_ptr<ReportSource> source) {
  source_ = std::move(source);
  if (assembler_) earlier_ = sum(earlier_, assembler_->counts());
  const bool sameBoard = assembler_ && assembler_->info() == source_->info();
  assembler_.emplace(source_->info(), source_->configuration());
  assembler_->restart(); // it sends already: what was sent of a frame before is not lost
  latency_.restart();
  arrival_s_ = rateStart_s_ = hostClock_s();
  rateReports_ = rateFrames_ = 0;
  ++status_.connections;
  status_.state = LiveState::Streaming;
  status_.reason.clear();
  status_.source = source_->name();
  status_.info = source_->info();
  if (!sameBoard) {
    tare_ = options_.tareOf ? options_.tareOf(source_->info()) : nullptr;
    makeDecoder();
  }
  if (records() && !sameBoard) {
    endRecording();
    status_.recordingFailure = "the recording ended because another board was connected";
  }
  if (!writer_) return;
  writer_->append(RecordingEntry::Kind::Connected, arrival_s_, encode(source_->info()));
  recordConfiguration();
  mark("the board is connected again");
}

void LiveWorker::disconnect(LiveState state, const std::string& reason) {
  if (source_ && writer_) mark("the board is disconnected");
  source_.reset();
  status_.state = options_.reconnect ? state : LiveState::Ended;
  status_.reason = reason;
  status_.reportsPerSecond = status_.framesPerSecond = 0;
}

void LiveWorker::read() {
  if (options_.waitForRecording) { // until setWriter
    arrival_s_ = hostClock_s();
    return std::this_thread::sleep_for(kReadTimeout / 10);
  }
  const ReportSource::Outcome outcome = source_->read(report_, kReadTimeout);
  if (replay() != nullptr && replay()->jumped()) jumped();
  const double now_s = hostClock_s();
  switch (outcome) {
  case ReportSource::Outcome::Read:
    arrival_s_ = now_s;
    status_.state = paused_ ? LiveState::Paused : LiveState::Streaming;
    take(report_);
    if (inPast()) restartRates(now_s); // it was read as fast as it can be
    break;
  case ReportSource::Outcome::Nothing:
    if (options_.replay) {
      if (options_.replay->paused) status_.state = LiveState::Paused;
      status_.reason = source_->reason();
    } else if (now_s - arrival_s_ > kStall_s) {
      status_.state = LiveState::Stalled;
      status_.reason =
          "no report received from the board for " + std::to_string(std::lround(1e3 * (now_s - arrival_s_))) + " ms";
    }
    break;
  case ReportSource::Outcome::Gone:
    disconnect(LiveState::Searching, source_->reason());
    return;
  case ReportSource::Outcome::End:
    status_.state = LiveState::Ended;
    status_.reason = source_->reason();
    return;
  }
  measureRates(now_s);
}

/// The recording continues at another place: reports between are not lost, and earlier ones belong to other frames.
void LiveWorker::jumped() {
  assembler_->restart();
  drift_.restart();
  restartRates(hostClock_s()); // the jump itself took time
  ++jumps_;
}

void LiveWorker::restartRates(double now_s) {
  rateStart_s_ = now_s;
  rateReports_ = rateFrames_ = 0;
}

void LiveWorker::take(const RawReport& report) {
  ++rateReports_;
  status_.reason.clear();
  followConfiguration(); // of a recording it changes from one report to the next
  if (writer_ && !inPast()) writer_->append(RecordingEntry::Kind::Raw, report.hostTime_s, report.bytes);
  if (paused_) return;
  const auto decoded =
      assembler_->add(report.bytes, report.hostTime_s, [this](const BoardFrame& frame) { takeFrame(frame); });
  if (const auto* event = std::get_if<BoardEvent>(&decoded)) takeEvent(*event);
  const auto* fault = std::get_if<ReportFault>(&decoded);
  if (fault && *fault == ReportFault::Protocol) {
    const std::string board = source_->name();
    otherProtocol_.emplace(board, source_->info());
    disconnect(LiveState::Refused, board + ": " + sentence(*fault) + "; a newer Palp may understand it");
    return;
  }
  const double now_s = hostClock_s();
  if (assembler_->staleInARow() < kStaleBeforeAsking || now_s < requestedAgain_s_ + kAskAgain_s) return;
  requestedAgain_s_ = now_s;
  readConfigurationAgain();
}

void LiveWorker::takeEvent(const BoardEvent& event) {
  status_.lastEvent = event.text;
  if (event.code == EventCode::ConfigurationChanged) readConfigurationAgain();
}

void LiveWorker::readConfigurationAgain() {
  source_->readConfiguration();
  followConfiguration();
}

void LiveWorker::followConfiguration() {
  if (source_->configuration() == assembler_->configuration()) return;
  assembler_->setConfiguration(source_->configuration());
  recordConfiguration();
}

void LiveWorker::takeFrame(const BoardFrame& frame) {
  ++rateFrames_;
  auto live = std::make_shared<LiveFrame>();
  live->frame = frame;
  live->connection = status_.connections;
  live->jumps = jumps_;
  live->faults = wireFaults(frame);
  const ReplaySource* replay = this->replay();
  live->past = replay && replay->past(frame.hostTime_s);
  if (replay && !ownTare_ && replay->tare() != tare_) holdTare(replay->tare());
  rest_.add(frame);
  if (decoder_) {
    const int before = decoder_->tares();
    live->forces = decoder_->decode(frame);
    if (decoder_->tares() != before) {
      holdTare(std::make_shared<const Tare>(decoder_->tare()));
      drift_.forgetPace();
      recordTare();
    }
  }
  if (!live->past) watch(live->forces);
  live->change = rest_.change(frame);
  drift_.judge(*live, decoder_ ? &*decoder_ : nullptr, hostClock_s(), status_);
  if (frame.restarted) latency_.restart();
  // What waited in the source before it was handed over counts too; a recording's times are its own.
  const double arrival_s = options_.replay ? arrival_s_ : std::min(arrival_s_, frame.hostTime_s);
  live->decoding_s = hostClock_s() - arrival_s;
  decoding_.add(live->decoding_s, 0);
  live->latency_s = latency_.add(frame.hostTime_s + live->decoding_s, frame.endTime_s);
  if (live->latency_s > kLate_s) ++status_.lateFrames;
  live->lostReports = earlier_.lost + assembler_->counts().lost;
  live->mark = replay ? replay->mark() : mark_;
  live->markFollowsJump = replay && replay->markFollowsJump();
  if (frame.temperature_degC) status_.temperature_degC = frame.temperature_degC;
  if (!live->past && options_.replay && options_.replay->steps > 0) --options_.replay->steps;
  give_(std::move(live));
}

/// An alarm becomes a mark, so that curves and recordings have it.
void LiveWorker::watch(const DecodedForces& forces) {
  blindFrames_ = forces.valid ? 0 : blindFrames_ + 1;
  status_.blind = blindFrames_ >= kBlindFrames;
  if (status_.blind)
    if (const auto event = alarm_.lose()) mark(*event);
  if (!forces.valid) return;
  Eigen::Matrix3Xd forces_N = forces.forces_N;
  for (Eigen::Index column = 0; column < forces_N.cols(); ++column)
    if (!forces.shown[static_cast<std::size_t>(column)]) forces_N.col(column).setZero(); // it may be noise alone
  const std::optional<std::string> event = alarm_.add(forces_N);
  if (!event) return;
  mark(*event);
  if (alarm_.words().empty()) return;
  status_.lastAlarm = *event;
  ++status_.alarms;
}

void LiveWorker::measureRates(double now_s) {
  const double span_s = now_s - rateStart_s_;
  if (span_s < 1) return;
  status_.reportsPerSecond = static_cast<double>(rateReports_) / span_s;
  status_.framesPerSecond = static_cast<double>(rateFrames_) / span_s;
  restartRates(now_s);
}

LiveStatus LiveWorker::status() {
  if (assembler_) {
    status_.counts = sum(earlier_, assembler_->counts());
    status_.configuration = assembler_->configuration();
  }
  status_.latency = summary(latency_);
  status_.decoding = summary(decoding_);
  status_.taring = decoder_ && decoder_->taring();
  status_.tared = decoder_ && decoder_->tared();
  status_.tare = tare_;
  status_.tareOfRecording = tare_ && options_.replay && !ownTare_;
  status_.restName = status_.tareOfRecording ? "the tare of the recording" : rest_.name();
  status_.alarm = alarm_.words();
  status_.noise = decoder_ ? decoder_->noise() : 0;
  if (writer_) statusOfRecording();
  status_.recording = records() && source_; // never "recording" while the board is gone
  status_.recordingWaits = records() && !source_;
  return status_;
}

void LiveWorker::makeDecoder() {
  decoder_.reset();
  rest_.reset({});
  drift_.forget(status_);
  status_.decoderProblem = options_.decoder ? "" : "no network: raw readings only";
  if (!options_.decoder || !status_.info) return;
  try {
    decoder_.emplace(*options_.decoder, *status_.info, options_.design);
    alarm_.setRange(decoder_->range_N());
    rest_.reset(decoder_->restResistances_ohm());
    if (tare_) holdTare(tare_); // it is the board's, whatever reads it
    if (options_.tareFrames > 0) tare(options_.tareFrames);
  } catch (...) { // the readings are of use without it
    decoder_.reset();
    status_.decoderProblem = failureInWords(std::current_exception());
  }
}

/// What is known of a board at rest outlives networks and connections.
void LiveWorker::holdTare(std::shared_ptr<const Tare> tare) {
  tare_ = std::move(tare);
  if (tare_) {
    if (decoder_) decoder_->setTare(*tare_);
    return rest_.setTare(tare_->rest_ohm);
  }
  rest_.clearTare();
  if (decoder_) decoder_->clearTare();
}

void LiveWorker::tare(int frames) {
  if (frames < 1) return;
  ownTare_ = true;
  if (!decoder_) return rest_.startTare(frames);
  try {
    decoder_->startTare(frames);
  } catch (const Error& refused) {
    status_.lastEvent = refused.what();
  }
}

void LiveWorker::clearTare() {
  ownTare_ = true;
  holdTare(nullptr);
  recordTare();
}

void LiveWorker::setDecoder(std::optional<Decoder> decoder, std::optional<SensorDesign> design) {
  options_.decoder = std::move(decoder);
  options_.design = std::move(design);
  makeDecoder();
}

void LiveWorker::pause(bool paused) {
  if (paused_ && !paused && assembler_) assembler_->restart(); // reports of the pause do not count as lost
  paused_ = paused;
}

void LiveWorker::idle(bool idle) {
  idle_ = idle;
}

void LiveWorker::configure(const BoardConfiguration& configuration) {
  if (!source_) return;
  if (!source_->configure(configuration)) {
    status_.lastEvent = "the board refuses the configuration";
    return;
  }
  assembler_->setConfiguration(source_->configuration());
  recordConfiguration();
}

} // namespace palp
