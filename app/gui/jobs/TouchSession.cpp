#include "app/gui/jobs/TouchSession.h"

#include "app/gui/jobs/TouchResistances.h"
#include "solver/DiscretisationError.h"
#include "solver/MeshCost.h"

#include <algorithm>
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

void TouchSession::setInputs(const SensorDesign& design, const LoadCase& load, const MeshOptions& mesh,
                             const std::vector<LoadCase>& path) {
  if (design == wanted_.design() && load == wanted_.load() && mesh == wanted_.meshOptions() && path == wanted_.path())
    return;
  wanted_.setDesign(design);
  wanted_.setLoad(load, path);
  wanted_.setMeshOptions(mesh);
  ++revision_;
  if (takeShown() || takeLaw()) return;
  if (need_ > Stage::Design) run();
}

bool TouchSession::takeShown() {
  const bool same = wanted_.design() == shown_.design() && wanted_.load() == shown_.load() &&
                    wanted_.meshOptions() == shown_.meshOptions() && wanted_.path() == shown_.path();
  if (!same || shown_.mesh() == nullptr) return false;
  runner_.cancel(); // it follows inputs that came between
  scrubbing_.reset();
  wanted_ = shown_;
  shownRevision_ = revision_;
  emit changed(false);
  if (missing()) run();
  return true;
}

bool TouchSession::takeLaw() {
  if (wanted_.solution() == nullptr || wanted_.solution() != shown_.solution() || !computable()) return false;
  runner_.cancel(); // it follows inputs that came between
  scrubbing_.reset();
  wanted_.advance(target()); // Eq. (1) at most
  shown_ = wanted_;
  shownRevision_ = revision_;
  stages_ = wanted_.stages();
  emit changed(false);
  return true;
}

void TouchSession::need(Stage stage) {
  need_ = stage;
  if (missing() && !computing()) run();
}

void TouchSession::resume() {
  if (missing()) run();
}

Stage TouchSession::target() const {
  return whyNoResistances(wanted_.design()).isEmpty() ? need_ : std::min(need_, Stage::Displacements);
}

bool TouchSession::computing() const {
  return runner_.running() && computed_ == revision_;
}

int TouchSession::lastPlace() const {
  const bool moves = shown_.solution() != nullptr && shown_.solution()->increments.size() > 1;
  return moves ? static_cast<int>(std::lround(100 * shown_.solution()->increments.back().loadFraction)) : 0;
}

double TouchSession::loadFraction() const {
  if (shown_.solution() == nullptr || place_ < 0) return 0;
  return place_ == lastPlace() ? shown_.solution()->increments.back().loadFraction : 0.01 * place_;
}

std::vector<NewtonStep> TouchSession::newton() const {
  if (runner_.running() && trace_ && !trace_->steps().empty()) return trace_->steps();
  return shown_.solution() != nullptr ? shown_.solution()->newton : std::vector<NewtonStep>{};
}

bool TouchSession::computable() const {
  return check(wanted_.design()).empty() &&
         !whyInvalid(wanted_.load(), wanted_.design()); // a path that cannot be followed is none
}

void TouchSession::run() {
  if (!computable()) {
    runner_.cancel(); // the panels say what is wrong; the last good result stays
    return;
  }
  // This replaces it.
  scrubbing_.reset();
  // A new problem needs the memory of the old one's factor.
  if (wanted_.problem() == nullptr) rest();
  trace_ = std::make_shared<NewtonTrace>();
  computed_ = revision_;
  const auto work = [this, touch = wanted_, target = target(), revision = revision_,
                     trace = trace_](const std::stop_token& stop, JobProgress& progress) mutable -> JobRunner::Taking {
    const std::string cost =
        touch.mesh()
            ? ""
            : costInBrief(meshCost(touch.design(), meshFor(touch.design(), touch.load(), touch.meshOptions())));
    progress.set(-1, "Meshing" + cost);
    touch.advance(std::min(target, Stage::Mesh), {}, {.step = {}, .stop = stop});
    if (stop.stop_requested()) return {};
    std::shared_ptr<const NodalFields> fields;
    if (target > Stage::Mesh) {
      progress.set(-1, "Solving" + cost);
      touch.advance(Stage::Solution, {.oneTangent = true},
                    {[&, loads = 1 + static_cast<double>(touch.path().size())](const NewtonStep& step) {
                       trace->add(step);
                       progress.set(step.loadFraction / loads,
                                    "Newton at " + loadPlaceWords(step.loadFraction).toStdString());
                     },
                     stop});
      if (stop.stop_requested()) return {};
      touch.advance(target);
      fields = std::make_shared<const NodalFields>(touch.problem()->fields(touch.solution()->state()));
    }
    return [this, touch, fields, revision] { take(touch, fields, revision); };
  };
  runner_.start(tr("Computing the touch"), work);
}

void TouchSession::take(const Touch& touch, std::shared_ptr<const NodalFields> fields, quint64 revision) {
  if (revision != revision_) return; // changed or requested since: the next run is already started
  const bool meshChanged = touch.mesh() != shown_.mesh();
  wanted_ = touch;
  shown_ = touch;
  shownRevision_ = revision;
  stages_ = touch.stages();
  fields_ = std::move(fields);
  endFields_ = fields_;
  path_.reset();
  place_ = shown_.solution() != nullptr ? lastPlace() : -1;
  electrodes_ = touch.displacements() != nullptr
                    ? std::make_shared<const ElectrodeDisplacements>(*touch.displacements())
                    : nullptr;
  indenters_ = shown_.solution() != nullptr ? shown_.solution()->state().indenters : std::vector<IndenterState>{};
  emit changed(meshChanged);
  emit newtonStepped();
  if (missing()) run();
}

void TouchSession::showPlace(int percent) {
  if (percent < 0 || percent > lastPlace() || percent == scrubbingTo()) return;
  if (runner_.running() && !scrubbing_) return;
  if (path_) {
    showState(percent);
    return;
  }
  const bool asked = scrubbing_.has_value();
  scrubbing_ = percent;
  if (asked) return; // the path is on its way
  computed_ = 0;
  const auto work = [this, touch = shown_, revision = revision_](const std::stop_token& stop,
                                                                 JobProgress&) -> JobRunner::Taking {
    auto path = std::make_shared<const std::vector<LoadPathState>>(loadPathStates(touch, stop));
    if (stop.stop_requested()) return {};
    return [this, path, revision] {
      if (revision != revision_ || !scrubbing_) return;
      path_ = path;
      showState(*scrubbing_);
    };
  };
  runner_.start(tr("Showing the load path"), work);
}

void TouchSession::showState(int percent) {
  scrubbing_.reset();
  place_ = percent;
  LoadPathState state = stateAt(*path_, loadFraction());
  fields_ = std::make_shared<const NodalFields>(std::move(state.fields));
  electrodes_ = std::make_shared<const ElectrodeDisplacements>(std::move(state.electrodes));
  indenters_ = std::move(state.indenters);
  emit changed(false);
}

void TouchSession::estimateError() {
  if (shown_.solution() == nullptr || !upToDate()) return;
  if (!shown_.path().empty()) {
    emit errorEstimated(std::nan(""), tr("not available for a path; clear the path to estimate the error of its load"));
    return;
  }
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
