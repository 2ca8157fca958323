#include "app/gui/live/LiveHost.h"

#include "app/study/live/LiveSource.h"
#include "io/DesignFile.h"
#include "model/base/Error.h"

#include <algorithm>

namespace palp {

namespace {

/// Failures while a source is opened are reported in the session's state.
template <class Open> std::unique_ptr<ReportSource> orRefuse(const Open& open) {
  try {
    return open();
  } catch (const BoardError&) {
    throw;
  } catch (const std::exception& refusal) {
    throw BoardError(refusal.what());
  }
}

} // namespace

bool sameSource(const LiveSettings& a, const LiveSettings& b) {
  return a.source == b.source && a.device == b.device && a.recording == b.recording &&
         a.simulation.seed == b.simulation.seed;
}

LiveHost::LiveHost(BoardAccess access, QObject* parent)
    : QObject(parent), access_(std::move(access)), sensor_(paperDesign()) {
  connect(&network_, &LiveNetwork::changed, this, &LiveHost::applyNetwork);
  connect(&network_, &LiveNetwork::marked, this, [this](const QString& text) { mark(text.toStdString()); });
  connect(&simulatedDesign_, &SimulatedDesign::solved, this, &LiveHost::followDesign);
}

LiveHost::~LiveHost() = default;

void LiveHost::setSettings(const LiveSettings& settings, const SensorDesign& design) {
  const LiveSettings before = std::exchange(settings_, settings);
  const bool otherDesign = !(design == std::exchange(design_, design));
  if (session_) sending_.follow(settings.receivers); // else when it is first seen
  if (replay_) {
    replay_->speed = settings.replaySpeed;
    replay_->past_s = settings.window_s;
  }
  if (simulation_) simulation_->set(faults(), disturbance());
  hold();
  const bool otherAlarm = before.alarmOn != settings.alarmOn || !(before.alarm == settings.alarm);
  if (otherAlarm && session_) session_->setAlarm(alarm());
  if (!visible_ && (otherAlarm || before.receivers != settings.receivers)) applyPause();
  network_.follow(settings);
  if (!session_) return; // opened when the scene is first seen
  if (!network_.requested()) loadNetwork();
  if (otherDesign || before.simulation.moving != settings.simulation.moving) followDesign();
  if (before.simulation.seed != settings.simulation.seed) tares_.clear(); // another sensor
  if (!sameSource(before, settings)) return restart();
  if (before.rate_Hz != settings.rate_Hz || before.row != settings.row) configured_ = 0;
}

BoardDisturbance LiveHost::disturbance() const {
  BoardDisturbance disturbance;
  disturbance.noise = settings_.simulation.noise;
  disturbance.warming_degC = settings_.simulation.warming_degC;
  disturbance.hysteresisShare = settings_.simulation.hysteresisShare;
  return disturbance;
}

BoardFaults LiveHost::faults() const {
  BoardFaults faults;
  if (settings_.simulation.openRow >= 0) faults.openRows = {settings_.simulation.openRow};
  if (settings_.simulation.openColumn >= 0) faults.openColumns = {settings_.simulation.openColumn};
  faults.dropEvery = settings_.simulation.dropEvery;
  return faults;
}

void LiveHost::hold() {
  const SimulationSettings& simulation = settings_.simulation;
  const auto& force_N = simulation.heldForce_N;
  if (!simulation.held) return hand_->hold({});
  SimulatedTouch::Truth touch{simulation.heldArea, {force_N[0], force_N[1], force_N[2]}};
  if (simulation.moving) touch.place_mm = Eigen::Vector2d(simulation.heldPlace_mm.data());
  hand_->hold(touch);
}

std::optional<ForceAlarm> LiveHost::alarm() const {
  return settings_.alarmOn ? std::optional(settings_.alarm) : std::nullopt;
}

const SensorDesign& LiveHost::simulatedSensor() const {
  static const SensorDesign paper = paperDesign();
  return own() != nullptr ? design_ : paper;
}

const SimulatedDesign::Solved* LiveHost::own() const {
  return simulatedDesign_.of(design_, settings_.simulation.moving);
}

bool LiveHost::simulatesOwnDesign() const {
  return own() != nullptr || (!settings_.simulation.moving && simulatedSensor() == design_);
}

std::optional<SimulatedTouch::Truth> LiveHost::trueTouch(const BoardFrame& at) const {
  return simulated() && running_ && running_->hasTouches() ? hand_->at(at.time_s) : std::nullopt;
}

/// The simulated board and the network that was trained on it go with the project's design.
void LiveHost::followDesign() {
  const bool other = simulation_ && simulated() && running_ != (own() != nullptr ? own()->samples : nullptr);
  designWaits_ = other && session_ && recording(); // a recording is of one sensor
  if (designWaits_) return;
  const bool ofSimulation = network_.ofSimulation() || own() != nullptr;
  if (settings_.network.empty() && ofSimulation && network_.requested() && session_)
    loadNetwork();
  else
    network_.refresh();
  if (!other || !session_) return;
  tares_.clear(); // the simulated sensor is another one
  restart();
}

/// The project's design where the network is of it; none leaves the choice to the decoder.
std::optional<SensorDesign> LiveHost::tareDesign() const {
  if (network_.decoder() && designFingerprint(design_) == network_.decoder()->designFingerprint) return design_;
  return {};
}

LiveOptions LiveHost::options() {
  LiveOptions options;
  options.decoder = network_.decoder();
  options.design = tareDesign();
  options.alarm = alarm();
  options.alsoTo = sending_.taker();
  options.tareOf = [kept = tares_](const BoardInfo& board) { return kept.of(board); };
  simulation_ = std::make_shared<SimulationControl>();
  simulation_->set(faults(), disturbance());
  replay_.reset();
  boardSeen_ = std::make_shared<std::atomic<bool>>(false);
  const auto board = [open = access_.open, device = settings_.device] {
    return orRefuse([&] { return open(device); });
  };
  running_ = own() != nullptr ? own()->samples : nullptr;
  const auto simulated = [control = simulation_, hand = hand_, solved = running_, rate_Hz = settings_.rate_Hz,
                          seed = settings_.simulation.seed]() -> std::unique_ptr<ReportSource> {
    if (!control->pluggedIn) return nullptr;
    SimulatedBoardOptions wanted;
    wanted.rate_Hz = rate_Hz;
    wanted.seed = seed;
    wanted.solved = solved;
    wanted.hand = hand;
    return orRefuse([&] { return openSimulatedBoard(wanted, control); });
  };
  switch (settings_.source) {
  case LiveSourceKind::Automatic:
    // After a board was connected, its absence is reported and nothing else replaces it.
    options.open = [simulated, access = access_, seen = boardSeen_]() -> std::unique_ptr<ReportSource> {
      return orRefuse([&]() -> std::unique_ptr<ReportSource> {
        const std::vector<HidBoard> boards = access.list();
        const bool there = std::any_of(boards.begin(), boards.end(), access.free);
        if (!there && !*seen) return simulated();
        *seen = true;
        return access.open({});
      });
    };
    break;
  case LiveSourceKind::Board:
    *boardSeen_ = true;
    options.open = board;
    break;
  case LiveSourceKind::Simulated:
    options.open = simulated;
    break;
  case LiveSourceKind::Recording: // it contains its tare
    options.tareOf = {};
    replay_ = std::make_shared<ReplayControl>();
    replay_->speed = settings_.replaySpeed;
    replay_->past_s = settings_.window_s;
    options.replay = replay_;
    options.waitForReader = true;
    options.reconnect = false;
    options.open = [path = settings_.recording, control = replay_] {
      return orRefuse([&] { return std::make_unique<ReplaySource>(path, control); });
    };
    break;
  }
  return options;
}

void LiveHost::open() {
  ++openings_;
  history_.clear();
  fresh_.clear();
  waiting_.clear();
  status_ = {};
  configured_ = 0;
  session_ = std::make_unique<LiveSession>(options());
  sending_.follow(settings_.receivers);
  applyPause();
}

// A source may take long to end, and a future waits where it is destroyed: neither in the window's thread.
template <class Running> void LiveHost::endInBackground(std::unique_ptr<Running> old) {
  std::erase_if(closing_, [](const std::future<void>& ending) {
    return ending.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  if (old) closing_.push_back(std::async(std::launch::async, [old = std::move(old)]() mutable { old.reset(); }));
}

void LiveHost::restart() {
  paused_ = false;
  endInBackground(std::move(session_));
  open();
}

void LiveHost::setVisible(bool visible) {
  visible_ = visible;
  if (!visible) endInBackground(std::move(watch_));
  if (visible && !watch_) watch_ = std::make_unique<BoardWatch>(access_);
  if (visible && !session_) open();
  if (visible && !network_.requested()) loadNetwork();
  applyPause();
}

bool LiveHost::worksHidden() const {
  return session_ && (watches() || recording());
}

void LiveHost::close() {
  simulator().cancel();
  network_.loader().cancel();
  sending_.follow({});
  endInBackground(std::move(watch_));
  endInBackground(std::move(session_));
  status_ = {};
}

bool LiveHost::closed() {
  endInBackground<LiveSession>(nullptr); // forgets those that have ended
  return closing_.empty() && sending_.settled() && !session_ && !watch_ && !network_.loading() &&
         !simulator().running();
}

void LiveHost::applyPause() {
  if (!session_) return;
  recorded_ = recording();
  const bool idle = !visible_ && !watches();
  const bool held = (visible_ && paused_) || (idle && !recorded_); // its curves have no hole where one was elsewhere
  session_->idle(idle);
  if (replay_)
    replay_->paused = held;
  else
    session_->pause(held);
}

void LiveHost::loadNetwork() {
  network_.load(own(), status_.info);
}

void LiveHost::useChosenNetwork() {
  mark(tr("network: as selected").toStdString());
  loadNetwork();
}

/// The decoder of the session, and the design of the board that it belongs to.
void LiveHost::applyNetwork() {
  const std::optional<Decoder>& decoder = network_.decoder();
  const bool paper = decoder && designFingerprint(paperDesign()) == decoder->designFingerprint;
  sensor_ = tareDesign() || !paper ? design_ : paperDesign();
  if (session_) session_->setDecoder(decoder, tareDesign());
  emit decoderChanged();
}

bool LiveHost::look() {
  if (!session_) return false;
  status_ = session_->status();
  timeRecording();
  if (status_.info && !replay_) tares_.keep(*status_.info, status_.tare);
  drain();
  for (const auto& frame : fresh_) history_.add(frame);
  if (recording() != recorded_) applyPause();
  if (designWaits_ && !recording()) followDesign();
  if (watch_) watch_->setQuiet(*boardSeen_ && status_.state == LiveState::Streaming);
  configureOnce();
  const bool stoodIn = settings_.source == LiveSourceKind::Automatic && !*boardSeen_ && status_.connections > 0;
  if (!stoodIn || recording()) return !fresh_.empty();
  const std::vector<HidBoard> there = boards();
  if (std::any_of(there.begin(), there.end(), access_.free))
    restart(); // a board was plugged in: it takes the place of the simulated one
  return !fresh_.empty();
}

/// Gives each connection its rate and rows.
void LiveHost::configureOnce() {
  if (replay_ || !status_.configuration || status_.state != LiveState::Streaming || configured_ == status_.connections)
    return;
  configured_ = status_.connections;
  BoardConfiguration wanted = *status_.configuration;
  const int rows = status_.info->rowWires;
  const bool alone = settings_.row >= 0 && settings_.row < rows;
  wanted.mode = alone ? BoardMode::SingleRow : BoardMode::Stream;
  wanted.rowMask =
      alone ? std::uint32_t{1} << settings_.row : static_cast<std::uint32_t>((std::uint64_t{1} << rows) - 1);
  wanted.rate_Hz = std::min(settings_.rate_Hz, status_.info->highestRate_Hz);
  if (!(wanted == *status_.configuration)) session_->configure(wanted);
}

std::vector<HidBoard> LiveHost::boards() const {
  return watch_ ? watch_->boards() : std::vector<HidBoard>{};
}

bool LiveHost::simulated() const {
  return !replay_ && boardSeen_ && !*boardSeen_;
}

void LiveHost::tare() {
  if (session_) session_->tare(settings_.tareFrames);
}

void LiveHost::clearTare() {
  if (session_) session_->clearTare();
}

void LiveHost::setPaused(bool paused) {
  paused_ = paused;
  applyPause();
}

void LiveHost::mark(const std::string& text) {
  if (session_) session_->mark(text);
}

void LiveHost::setPluggedIn(bool in) {
  if (simulation_) simulation_->pluggedIn = in;
}

bool LiveHost::pluggedIn() const {
  return simulation_ && simulation_->pluggedIn;
}

void LiveHost::seek(double to_s) {
  if (replay_) replay_->seek(to_s);
}

/// What is read of the past after a jump is shown with the place that was gone to, not before it.
void LiveHost::drain() {
  for (auto& frame : session_->drain()) waiting_.push_back(std::move(frame));
  auto end = waiting_.end();
  if (!waiting_.empty() && waiting_.back()->past && status_.state != LiveState::Ended)
    end = std::find_if(waiting_.begin(), waiting_.end(),
                       [&](const auto& frame) { return frame->jumps == waiting_.back()->jumps; });
  fresh_.assign(waiting_.begin(), end);
  waiting_.erase(waiting_.begin(), end);
}

void LiveHost::step(int frames) {
  if (!replay_) return;
  setPaused(true);
  if (frames > 0) {
    replay_->steps += frames;
    return;
  }
  if (const LiveFrame* last = history_.last()) replay_->seekFrameBefore(last->frame.hostTime_s);
}

void LiveHost::startRecording(const std::filesystem::path& path, bool replace) {
  if (!session_) throw Error(path.string() + ": cannot record, as no source is open");
  if (replay_ && std::filesystem::weakly_canonical(path) == std::filesystem::weakly_canonical(settings_.recording))
    throw Error(path.string() + ": is being played; record to another file");
  session_->startRecording(path, network_.fingerprint(), replace);
  recordingFile_ = path;
  recordedBefore_s_ = 0;
  recordsSince_s_.reset();
  recordingEnds_ = false;
}

/// The clock of a recording stops while nothing arrives that could be recorded.
void LiveHost::timeRecording() {
  const bool goesOn = status_.recording && !recordingEnds_;
  if (goesOn == recordsSince_s_.has_value()) return;
  if (goesOn) {
    recordsSince_s_ = hostClock_s();
  } else {
    recordedBefore_s_ = recorded_s();
    recordsSince_s_.reset();
  }
}

double LiveHost::recorded_s() const {
  return recordedBefore_s_ + (recordsSince_s_ ? hostClock_s() - *recordsSince_s_ : 0);
}

void LiveHost::stopRecording() {
  recordingEnds_ = true;
  timeRecording();
  if (session_) session_->stopRecording();
}

} // namespace palp
