#include "app/gui/jobs/ReferenceTouch.h"

#include "app/gui/jobs/MatchedLoad.h"
#include "model/TouchRange.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "solver/PointProbe.h"

#include <algorithm>

namespace palp {

namespace {

constexpr Eigen::Index kPointsAtOnce = 1000; ///< a stop is looked at between them

/// Means of nodal values: where a point is found in a mesh.
struct FoundPoint {
  Eigen::VectorXi nodes;
  Eigen::VectorXd weights;
};

std::vector<FoundPoint> found(const Mesh& mesh, const Eigen::Matrix3Xd& points_mm, const std::stop_token& stop) {
  std::vector<FoundPoint> all;
  all.reserve(static_cast<std::size_t>(points_mm.cols()));
  for (Eigen::Index first = 0; first < points_mm.cols(); first += kPointsAtOnce) {
    throwIfStopped(stop);
    const PointProbe probe(mesh, points_mm.middleCols(first, std::min(kPointsAtOnce, points_mm.cols() - first)));
    for (const std::vector<PointProbe::Host>& hosts : probe.hosts())
      all.push_back({mesh.elements.col(hosts.front().element), hosts.front().shapes});
  }
  return all;
}

/// One column a node of the mesh; one column a point.
template <class Columns> Columns readAt(const std::vector<FoundPoint>& points, const Columns& nodal) {
  Columns read = Columns::Zero(nodal.rows(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    for (Eigen::Index n = 0; n < points[k].nodes.size(); ++n)
      read.col(static_cast<Eigen::Index>(k)) += points[k].weights[n] * nodal.col(points[k].nodes[n]);
  return read;
}

Eigen::VectorXd readAt(const std::vector<FoundPoint>& points, const Eigen::VectorXd& nodal) {
  return readAt<Eigen::RowVectorXd>(points, nodal.transpose()).transpose();
}

NodalFields readAt(const std::vector<FoundPoint>& points, const NodalFields& fields) {
  return {readAt(points, fields.displacement_mm),
          readAt(points, fields.cauchy_MPa),
          readAt(points, fields.pressure_MPa),
          readAt(points, fields.vonMises_MPa),
          readAt(points, fields.volumeRatio),
          readAt(points, fields.principalStretches),
          fields.contactTraction_MPa.cols() > 0 ? readAt(points, fields.contactTraction_MPa) : Eigen::Matrix3Xd()};
}

/// Load fractions of a touch, and the shares of its indenters' force that they have.
std::vector<std::array<double, 2>> forceShares(const Touch& shown) {
  const auto force_N = [](const LoadIncrement& state) {
    double down = 0;
    for (const IndenterState& its : state.indenters) down -= its.force_N.z();
    return down;
  };
  const double whole = force_N(shown.solution()->state());
  std::vector<std::array<double, 2>> shares;
  if (!(whole > 0)) return shares;
  for (const LoadIncrement& state : shown.solution()->increments)
    shares.push_back({state.loadFraction, force_N(state) / whole});
  return shares;
}

LoadCase loadOn(const SensorDesign& kept, const Touch& shown, bool uniform) {
  if (uniform) return uniformLoad(shown);
  try {
    return matchedLoad(shown.load(), shown.design(), kept);
  } catch (const Error& error) {
    throw Error(std::string("the reference design: ") + error.what());
  }
}

} // namespace

double ReferencePath::fractionAt(double shown) const {
  if (asLarge.empty()) return shown;
  for (std::size_t k = 1; k < asLarge.size(); ++k) {
    const auto& [from, fromShare] = asLarge[k - 1];
    const auto& [to, toShare] = asLarge[k];
    if (shown <= to) return fromShare + (toShare - fromShare) * (shown - from) / (to - from);
  }
  return asLarge.back()[1];
}

LoadCase uniformLoad(const Touch& touch) {
  if (!touch.path().empty()) throw Error("the same force, uniform, cannot follow a path: clear the path to compare");
  LoadCase load = touch.load();
  load.indenters.clear();
  const std::vector<IndenterState>& now = touch.solution()->state().indenters;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const Eigen::Vector2d place = touch.load().indenters[k].place_mm + now[k].translation_mm.head<2>();
    const int area = areaUnder(touch.design(), place.cwiseMax(0).cwiseMin(touch.design().block_mm.head<2>()));
    const auto its = std::find_if(load.areas.begin(), load.areas.end(), [&](const auto& a) { return a.area == area; });
    if (its != load.areas.end())
      its->force_N += now[k].force_N;
    else
      load.areas.push_back({area, now[k].force_N});
  }
  return load;
}

ReferencePath referencePath(const SensorDesign& kept, const Touch& shown, const std::stop_token& stop, bool uniform) {
  const LoadCase load = loadOn(kept, shown, uniform);
  Touch touch(kept, load, shown.meshOptions());
  if (!uniform) {
    std::vector<LoadCase> steps;
    for (const LoadCase& step : shown.path()) steps.push_back(matchedLoad(step, shown.design(), kept));
    touch.setLoad(load, steps);
  }
  const std::string whose = uniform ? "the block" : "the reference design";
  const bool good = touch.advance(Stage::Displacements, {.oneTangent = true}, {.step = {}, .stop = stop});
  throwIfStopped(stop);
  if (!good)
    throw Error(whose + " cannot carry the load" + (uniform ? " uniform: " : ": ") + touch.solution()->stopReason);
  touch.problem()->releaseFactor();
  ReferencePath path{kept, load, loadPathStates(touch, stop), {}};
  if (uniform) path.asLarge = forceShares(shown);
  if (kept.field() != nullptr) path.touch = touch;
  throwIfStopped(stop);
  const Eigen::Vector3d shares = kept.block_mm.cwiseQuotient(shown.design().block_mm);
  const Eigen::Matrix3Xd places = (shares.asDiagonal() * shown.mesh()->nodes_mm)
                                      .cwiseMin(kept.block_mm.replicate(1, shown.mesh()->nodes_mm.cols())); // rounding
  const std::vector<FoundPoint> points = found(*touch.mesh(), places, stop);
  for (LoadPathState& state : path.states) {
    throwIfStopped(stop);
    state.fields = readAt(points, state.fields);
  }
  return path;
}

ReferenceTouch::ReferenceTouch(QObject* parent) : QObject(parent) {
  connect(&runner_, &JobRunner::failed, this, [this](const QString& sentence) {
    problem_ = sentence;
    emit changed();
  });
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled || path_) return;
    problem_ = tr("cancelled; press F5 to compute it");
    emit changed();
  });
}

bool ReferenceTouch::wanted(const SensorDesign& kept, const Touch& shown, bool uniform) const {
  return wanted_ && wanted_->uniform == uniform && wanted_->kept == kept && wanted_->shown.path() == shown.path() &&
         sameButForLaw(wanted_->shown.design(), shown.design()) && wanted_->shown.load() == shown.load() &&
         wanted_->shown.meshOptions() == shown.meshOptions();
}

void ReferenceTouch::want(const SensorDesign& kept, const Touch& shown, bool uniform) {
  if (shown.solution() == nullptr || wanted(kept, shown, uniform)) return;
  wanted_ = Inputs{kept, shown, uniform};
  run();
}

std::shared_ptr<const ReferencePath> ReferenceTouch::pathFor(const SensorDesign& kept, const Touch& shown,
                                                             bool uniform) const {
  return wanted(kept, shown, uniform) ? path_ : nullptr;
}

void ReferenceTouch::resume() {
  if (!wanted_ || path_ || runner_.running()) return;
  wanted_.reset();
  problem_.clear();
  emit changed(); // the scene that shows it requests it again
}

void ReferenceTouch::run() {
  path_.reset();
  problem_.clear();
  const bool uniform = wanted_->uniform;
  const QString what = uniform ? tr("Computing the uniform load") : tr("Computing the reference design");
  runner_.start(what,
                [this, what, uniform, kept = wanted_->kept,
                 shown = wanted_->shown](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
                  progress.set(-1, what.toStdString());
                  auto path = std::make_shared<const ReferencePath>(referencePath(kept, shown, stop, uniform));
                  return [this, path] {
                    path_ = path;
                    emit changed();
                  };
                });
  // What it is known by; the results are the job's and the session's.
  Touch known(wanted_->shown.design(), wanted_->shown.load(), wanted_->shown.meshOptions());
  known.setLoad(wanted_->shown.load(), wanted_->shown.path());
  wanted_->shown = known;
}

void ReferenceTouch::forget() {
  runner_.cancel();
  wanted_.reset();
  path_.reset();
  problem_.clear();
}

} // namespace palp
