#include "app/gui/jobs/KeptTouch.h"

#include "app/gui/jobs/MatchedLoad.h"
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
    stopIfAsked(stop);
    const PointProbe probe(mesh, points_mm.middleCols(first, std::min(kPointsAtOnce, points_mm.cols() - first)));
    for (const std::vector<PointProbe::Holder>& holders : probe.holders())
      all.push_back({mesh.elements.col(holders.front().element), holders.front().shapes});
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

} // namespace

KeptPath keptPath(const SensorDesign& kept, const Touch& shown, const std::stop_token& stop) {
  const LoadCase load = [&] {
    try {
      return matchedLoad(shown.load(), shown.design(), kept);
    } catch (const Error& error) {
      throw Error(std::string("the kept design: ") + error.what());
    }
  }();
  Touch touch(kept, load, shown.meshOptions());
  const bool good = touch.advance(Stage::Displacements, {.oneTangent = true}, {.step = {}, .stop = stop});
  stopIfAsked(stop);
  if (!good) throw Error("the kept design cannot bear the load: " + touch.solution()->stopReason);
  touch.problem()->releaseFactor();
  KeptPath path{kept, load, loadPathStates(touch, stop), {}};
  if (kept.field() != nullptr) path.touch = touch;
  stopIfAsked(stop);
  const Eigen::Vector3d shares = kept.block_mm.cwiseQuotient(shown.design().block_mm);
  const Eigen::Matrix3Xd places = (shares.asDiagonal() * shown.mesh()->nodes_mm)
                                      .cwiseMin(kept.block_mm.replicate(1, shown.mesh()->nodes_mm.cols())); // rounding
  const std::vector<FoundPoint> points = found(*touch.mesh(), places, stop);
  for (LoadPathState& state : path.states) {
    stopIfAsked(stop);
    state.fields = readAt(points, state.fields);
  }
  return path;
}

KeptTouch::KeptTouch(QObject* parent) : QObject(parent) {
  connect(&runner_, &JobRunner::failed, this, [this](const QString& sentence) {
    problem_ = sentence;
    emit changed();
  });
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled || path_) return;
    problem_ = tr("cancelled; F5 computes it");
    emit changed();
  });
}

bool KeptTouch::wanted(const SensorDesign& kept, const Touch& shown) const {
  return wanted_ && wanted_->kept == kept && sameButForLaw(wanted_->shown.design(), shown.design()) &&
         wanted_->shown.load() == shown.load() && wanted_->shown.meshOptions() == shown.meshOptions();
}

void KeptTouch::want(const SensorDesign& kept, const Touch& shown) {
  if (shown.solution() == nullptr || wanted(kept, shown)) return;
  wanted_ = Inputs{kept, shown};
  run();
}

std::shared_ptr<const KeptPath> KeptTouch::pathFor(const SensorDesign& kept, const Touch& shown) const {
  return wanted(kept, shown) ? path_ : nullptr;
}

void KeptTouch::resume() {
  if (!wanted_ || path_ || runner_.running()) return;
  wanted_.reset();
  problem_.clear();
  emit changed(); // the scene that shows it wants it again
}

void KeptTouch::run() {
  path_.reset();
  problem_.clear();
  runner_.start(tr("Computing the kept design"),
                [this, kept = wanted_->kept, shown = wanted_->shown](const std::stop_token& stop,
                                                                     JobProgress& progress) -> JobRunner::Taking {
                  progress.set(-1, "Computing the kept design");
                  auto path = std::make_shared<const KeptPath>(keptPath(kept, shown, stop));
                  return [this, path] {
                    path_ = path;
                    emit changed();
                  };
                });
  // What it is known by; the results are the job's and the session's.
  wanted_->shown = Touch(wanted_->shown.design(), wanted_->shown.load(), wanted_->shown.meshOptions());
}

void KeptTouch::forget() {
  runner_.cancel();
  wanted_.reset();
  path_.reset();
  problem_.clear();
}

} // namespace palp
