#include "app/gui/live/LiveHost.h"

#include "app/gui/project/FileKind.h"
#include "app/study/live/LiveSource.h"
#include "io/AtomicFile.h"
#include "io/DecoderFile.h"
#include "io/DesignFile.h"
#include "io/Fingerprint.h"
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
  connect(&loader_, &JobRunner::failed, this, [this](const QString& sentence) { emit networkRefused(sentence); });
  connect(&simulatedDesign_, &SimulatedDesign::solved, this, &LiveHost::followDesign);
  connect(&loader_, &JobRunner::finished, this, [this](bool cancelled) {
    if (cancelled) networkAsked_ = network_.decoder && network_.file == settings_.network; // else when next seen
  });
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
  if (before.alarmOn != settings.alarmOn || !(before.alarm == settings.alarm)) {
    if (session_) session_->setAlarm(alarm());
    if (!visible_) applyPause();
  }
  if (before.receivers != settings.receivers && !visible_) applyPause();
  if (before.network != settings.network) {
    networkAsked_ = network_.decoder && network_.file == settings.network; // the one in use was wanted back
    if (networkAsked_) loader_.cancel();
  }
  if (before.calibrated != settings.calibrated && settings.calibrated != network_.calibrated) networkAsked_ = false;
  if (!session_) return; // opened when the scene is first seen
  if (!networkAsked_) loadNetwork();
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
  return simulated() && running_ && running_->hasTouches() ? hand_->told(at.time_s) : std::nullopt;
}

/// The simulated board and the network that was trained on it go with the project's design.
void LiveHost::followDesign() {
  const bool other = simulation_ && simulated() && running_ != (own() != nullptr ? own()->samples : nullptr);
  designWaits_ = other && session_ && recording(); // a recording is of one sensor
  if (designWaits_) return;
  const bool ofSimulation = network_.ofSimulation || own() != nullptr;
  if (settings_.network.empty() && ofSimulation && networkAsked_ && session_)
    loadNetwork();
  else
    setNetwork(network_);
  if (!other || !session_) return;
  tares_.clear(); // the simulated sensor is another one
  restart();
}

/// The project's design where the network is of it; none leaves the choice to the decoder.
std::optional<SensorDesign> LiveHost::tareDesign() const {
  if (network_.decoder && designFingerprint(design_) == network_.decoder->designFingerprint) return design_;
  return {};
}

LiveOptions LiveHost::options() {
  LiveOptions options;
  options.decoder = network_.decoder;
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
template <class Running> void LiveHost::letGo(std::unique_ptr<Running> old) {
  std::erase_if(closing_, [](const std::future<void>& ending) {
    return ending.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  if (old) closing_.push_back(std::async(std::launch::async, [old = std::move(old)]() mutable { old.reset(); }));
}

void LiveHost::restart() {
  paused_ = false;
  letGo(std::move(session_));
  open();
}

void LiveHost::setVisible(bool visible) {
  visible_ = visible;
  if (!visible) letGo(std::move(watch_));
  if (visible && !watch_) watch_ = std::make_unique<BoardWatch>(access_);
  if (visible && !session_) open();
  if (visible && !networkAsked_) loadNetwork();
  applyPause();
}

bool LiveHost::worksHidden() const {
  return session_ && (watches() || recording());
}

void LiveHost::close() {
  simulator().cancel();
  loader_.cancel();
  sending_.follow({});
  letGo(std::move(watch_));
  letGo(std::move(session_));
  status_ = {};
}

bool LiveHost::closed() {
  letGo<LiveSession>(nullptr); // forgets those that have ended
  return closing_.empty() && sending_.settled() && !session_ && !watch_ && !loader_.running() && !simulator().running();
}

void LiveHost::applyPause() {
  if (!session_) return;
  recorded_ = recording();
  const bool idle = !visible_ && !watches();
  const bool held = (visible_ && paused_) || (idle && !recorded_); // its curves have no hole where one was elsewhere
  session_->idle(idle);
  if (replay_) {
    replay_->paused = held;
  } else {
    session_->pause(held);
  }
}

void LiveHost::loadNetwork() {
  networkAsked_ = true;
  if (settings_.calibrated && settings_.calibrated != network_.calibrated) {
    loader_.cancel();
    networkAsked_ = true;
    return useCalibrated(settings_.calibrated, settings_.network);
  }
  if (settings_.network.empty() && own() != nullptr) {
    loader_.cancel();
    networkAsked_ = true;
    before_ = {};
    return setNetwork({own()->decoder, {}, {}, tr("Network of the simulated design"), true});
  }
  // A network that cannot read the connected board does not replace one that can.
  const std::optional<BoardInfo> info = network_.decoder ? status_.info : std::nullopt;
  loader_.start(tr("Reading the network"), [this, file = settings_.network, info](const std::stop_token&,
                                                                                  JobProgress&) {
    if (!file.empty()) requireKind(QString::fromStdString(file), FileKind::Network);
    const std::filesystem::path path = file.empty() ? shippedNetwork() : std::filesystem::path(file);
    auto loaded = std::make_shared<Network>(Network{readNetwork(path), file, fingerprint(readFile(path)), {}, false});
    if (!file.empty() && info)
      static_cast<void>(ForceDecoder(*loaded->decoder, *info)); // throws where it cannot read it
    return [this, loaded] { takeNetwork(std::move(*loaded)); };
  });
}

/// One that was chosen and has been read.
void LiveHost::takeNetwork(Network network) {
  Network inUse = network_;
  inUse.name = networkName();
  const bool first = std::exchange(anotherProject_, false);
  const bool wanted = inUse.decoder && inUse.file != network.file && !first;
  before_ = wanted ? std::move(inUse) : Network{};
  setNetwork(std::move(network));
}

void LiveHost::forgetNetworkBefore() {
  before_ = {};
  anotherProject_ = loader_.running() || !networkAsked_;
  emit decoderChanged();
}

void LiveHost::setNetwork(Network network) {
  network_ = std::move(network);
  const bool paper = network_.decoder && designFingerprint(paperDesign()) == network_.decoder->designFingerprint;
  sensor_ = tareDesign() || !paper ? design_ : paperDesign();
  if (session_) session_->setDecoder(network_.decoder, tareDesign());
  emit decoderChanged();
  if (network_.decoder && networkAsked_ && !loader_.running() && !namedBySettings()) emit otherNetworkInUse();
}

bool LiveHost::namedBySettings() const {
  return network_.file == settings_.network && network_.calibrated == settings_.calibrated;
}

QString LiveHost::networkName() const {
  if (!network_.name.isEmpty()) return network_.name;
  if (network_.file.empty()) return tr("Built-in network");
  return QString::fromStdString(std::filesystem::path(network_.file).filename().string());
}

void LiveHost::useDecoder(Decoder decoder, const QString& name) {
  before_ = network_;
  before_.name = networkName();
  mark(tr("network: %1").arg(name).toStdString());
  useCalibrated(std::make_shared<const CalibratedNetwork>(CalibratedNetwork{std::move(decoder), name.toStdString()}),
                network_.file);
}

/// `file`: of the network that it was refined from.
void LiveHost::useCalibrated(const std::shared_ptr<const CalibratedNetwork>& calibrated, const std::string& file) {
  anotherProject_ = false;
  setNetwork(
      {calibrated->decoder, file, {}, QString::fromStdString(calibrated->name), network_.ofSimulation, calibrated});
}

void LiveHost::useChosenNetwork() {
  mark(tr("network: as selected").toStdString());
  loadNetwork();
}

void LiveHost::backToNetwork() {
  if (before_.name.isEmpty()) return;
  Network back = std::exchange(before_, {});
  mark(tr("network: %1").arg(back.name).toStdString());
  setNetwork(std::move(back));
  if (!namedBySettings()) emit otherNetworkInUse(); // while another one is being read, too
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

} // namespace palp
