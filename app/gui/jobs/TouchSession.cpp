#include "app/gui/jobs/TouchSession.h"

#include "solver/DiscretisationError.h"

#include <cmath>

namespace palp {

namespace {

/// A hundred megabytes, against a third of a second for the next load after a pause.
constexpr int kKeepFactorFor_ms = 5000;

} // namespace

void NewtonTrace::add(const NewtonStep& step) {
  const std::lock_guard lock(mutex_);
  steps_.push_back(step);
}

std::vector<NewtonStep> NewtonTrace::steps() const {
  const std::lock_guard lock(mutex_);
  return steps_;
}

TouchSession::TouchSession(QObject* parent) : QObject(parent) {
  idle_.setSingleShot(true);
  idle_.setInterval(kKeepFactorFor_ms);
  connect(&idle_, &QTimer::timeout, this, &TouchSession::rest);
  connect(&runner_, &JobRunner::finished, &idle_, qOverload<>(&QTimer::start));
  connect(&runner_, &JobRunner::progressed, this, &TouchSession::newtonStepped);
  connect(&runner_, &JobRunner::finished, this, [this] { scrubbing_.reset(); });
}

void TouchSession::setInputs(const SensorDesign& design, const LoadCase& load, const MeshOptions& mesh) {
  if (design == wanted_.design() && load == wanted_.load() && mesh == wanted_.meshOptions()) return;
  wanted_.setDesign(design);
  wanted_.setLoad(load);
  wanted_.setMeshOptions(mesh);
  ++revision_;
  if (need_ > Stage::Design) run();
}

void TouchSession::need(Stage stage) {
  need_ = stage;
  if (missing() && !computing()) run();
}

void TouchSession::resume() {
  if (missing()) run();
}

bool TouchSession::computing() const {
  return runner_.running() && computed_ == revision_;
}

int TouchSession::incrementCount() const {
  return shown_.solution() != nullptr ? static_cast<int>(shown_.solution()->increments.size()) : 0;
}

double TouchSession::loadFraction() const {
  if (shown_.solution() == nullptr || increment_ < 0) return 0;
  return shown_.solution()->increments[static_cast<std::size_t>(increment_)].loadFraction;
}

std::vector<NewtonStep> TouchSession::newton() const {
  if (runner_.running() && trace_ && !trace_->steps().empty()) return trace_->steps();
  return shown_.solution() != nullptr ? shown_.solution()->newton : std::vector<NewtonStep>{};
}

bool TouchSession::computable() const {
  return check(wanted_.design()).empty() && !whyInvalid(wanted_.load(), wanted_.design());
}

void TouchSession::run() {
  if (!computable()) {
    runner_.cancel(); // the panels say what is wrong; the last good result stays
    return;
  }
  // This replaces it.
  scrubbing_.reset();
  // A new problem wants the memory of the old one's factor.
  if (wanted_.problem() == nullptr) rest();
  trace_ = std::make_shared<NewtonTrace>();
  computed_ = revision_;
  const auto work = [this, touch = wanted_, target = need_, revision = revision_,
                     trace = trace_](const std::stop_token& stop, JobProgress& progress) mutable -> JobRunner::Taking {
    progress.set(-1, "Meshing");
    touch.advance(std::min(target, Stage::Mesh), {}, {.step = {}, .stop = stop});
    if (stop.stop_requested()) return {};
    std::shared_ptr<const NodalFields> fields;
    if (target > Stage::Mesh) {
      progress.set(-1, "Solving");
      touch.advance(Stage::Solution, {.oneTangent = true},
                    {[&](const NewtonStep& step) {
                       trace->add(step);
                       progress.set(step.loadFraction, "Newton at load fraction " +
                                                           QString::number(step.loadFraction, 'g', 3).toStdString());
                     },
                     stop});
      if (stop.stop_requested()) return {};
      touch.advance(Stage::Resistances);
      fields = std::make_shared<const NodalFields>(touch.problem()->fields(touch.solution()->state()));
    }
    return [this, touch, fields, revision] { take(touch, fields, revision); };
  };
  runner_.start(tr("Computing the touch"), work);
}

void TouchSession::take(const Touch& touch, std::shared_ptr<const NodalFields> fields, quint64 revision) {
  if (revision != revision_) return; // whoever changed the inputs, or needed them since, has asked for the next run
  const bool meshChanged = touch.mesh() != shown_.mesh();
  wanted_ = touch;
  shown_ = touch;
  shownRevision_ = revision;
  stages_ = touch.stages();
  fields_ = std::move(fields);
  increment_ = incrementCount() - 1;
  electrodes_ = touch.displacements() != nullptr
                    ? std::make_shared<const ElectrodeDisplacements>(*touch.displacements())
                    : nullptr;
  emit changed(meshChanged);
  emit newtonStepped();
  if (missing()) run();
}

void TouchSession::showIncrement(int increment) {
  if (increment < 0 || increment >= incrementCount() || increment == scrubbingTo()) return;
  if (runner_.running() && !scrubbing_) return;
  scrubbing_ = increment;
  computed_ = 0;
  const auto work = [this, touch = shown_, increment, revision = revision_](const std::stop_token&,
                                                                            JobProgress&) -> JobRunner::Taking {
    const LoadIncrement& state = touch.solution()->increments[static_cast<std::size_t>(increment)];
    auto fields = std::make_shared<const NodalFields>(touch.problem()->fields(state));
    auto electrodes = std::make_shared<const ElectrodeDisplacements>(touch.problem()->electrodes(state));
    return [this, fields, electrodes, increment, revision] {
      if (revision != revision_) return;
      fields_ = fields;
      electrodes_ = electrodes;
      increment_ = increment;
      scrubbing_.reset();
      emit changed(false);
    };
  };
  runner_.start(tr("Showing a load increment"), work);
}

void TouchSession::estimateError() {
  if (shown_.solution() == nullptr || !upToDate()) return;
  computed_ = 0;
  const auto work = [this, touch = shown_, revision = revision_](const std::stop_token& stop,
                                                                 JobProgress& progress) -> JobRunner::Taking {
    progress.set(-1, "Solving on a coarser mesh");
    const DiscretisationError error = discretisationError(*touch.problem(), touch.load(), *touch.solution(), stop);
    return [this, error, revision] {
      if (revision == revision_)
        emit errorEstimated(error.relative.value_or(std::nan("")), QString::fromStdString(error.method));
    };
  };
  runner_.start(tr("Estimating the discretisation error"), work);
}

void TouchSession::rest() {
  if (!runner_.running() && shown_.problem() != nullptr) shown_.problem()->releaseFactor();
}

} // namespace palp
