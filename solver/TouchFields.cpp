#include "solver/TouchFields.h"

#include "model/base/Cancelled.h"
#include "model/base/Parallel.h"
#include "solver/PointProbe.h"
#include "solver/contact/ContactDisc.h"
#include "solver/contact/ContactEstimate.h"
#include "solver/statics/LinearisedBlock.h"
#include "solver/statics/PointMotion.h"

#include <Eigen/SparseCore>

#include <array>

namespace palp {

namespace {

constexpr Eigen::Index sidesATouch = 7;
constexpr int pointsAtOnce = 64;
constexpr double sparseBelow = 0.3; // share of entries below which a sparse product is faster

/// Nodal forces of 1 N along an axis, spread by these shares over the points of a contact. What would reach over the
/// face presses at its edge.
Eigen::VectorXd forceOn(const LinearisedBlock& linearised, const Eigen::Vector2d& place_mm, double radius_mm,
                        const Eigen::VectorXd& shares, Eigen::Index axis) {
  const Eigen::Vector3d& block_mm = linearised.design.block_mm;
  Eigen::Matrix3Xd points(3, contactDiscPoints);
  points.topRows<2>() = ((radius_mm * contactDisc().points).colwise() + place_mm)
                            .cwiseMax(0)
                            .cwiseMin(block_mm.head<2>().replicate(1, contactDiscPoints));
  points.row(2).setConstant(block_mm.z());
  const PointProbe probe(linearised.mesh, points);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * linearised.mesh.nodes_mm.cols());
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    const PointProbe::Host& host = probe.hosts()[static_cast<std::size_t>(p)].front();
    for (Eigen::Index n = 0; n < host.shapes.size(); ++n)
      load(3 * Eigen::Index(linearised.mesh.elements(n, host.element)) + axis) += shares(p) * host.shapes(n);
  }
  return linearised.discretisation->freePart(load);
}

} // namespace

std::optional<TouchFields> TouchFields::find(const HyperelasticProblem& problem, std::span<const Indenter> touches,
                                             int threads, const std::stop_token& stop) {
  const LinearisedBlock& linearised = problem.block();
  const auto rest = linearised.initialTangent(threads, stop);
  if (!rest) return {};
  TouchFields found(problem);
  found.shift_mm_ = placeShiftShare * linearised.design.block_mm.z();
  found.radii_mm_.resize(touches.size());
  found.moved_.resize(3 * linearised.mesh.nodes_mm.cols(), sidesATouch * static_cast<Eigen::Index>(touches.size()));
  const double s = found.shift_mm_;
  const std::array<Eigen::Vector2d, 5> shifts{Eigen::Vector2d(0, 0), Eigen::Vector2d(s, 0), Eigen::Vector2d(-s, 0),
                                              Eigen::Vector2d(0, s), Eigen::Vector2d(0, -s)};
  const ContactDisc& disc = contactDisc();
  inParallel(touches.size(), threads, [&](std::size_t t) {
    const Indenter& touch = touches[t];
    const double radius_mm = found.radii_mm_[t] = contactEstimate(touch, linearised.design).half_mm.x();
    for (Eigen::Index side = 0; side < sidesATouch; ++side) {
      if (stop.stop_requested()) return;
      const bool aside = side < 2;
      const Eigen::Vector2d place_mm =
          touch.place_mm + (aside ? shifts[0] : shifts[static_cast<std::size_t>(side - 2)]);
      Eigen::VectorXd x =
          forceOn(linearised, place_mm, radius_mm, aside || touch.shape == IndenterShape::Flat ? disc.flat : disc.hertz,
                  aside ? side : 2);
      rest->factor.solve(x, stop);
      if (stop.stop_requested()) return;
      found.moved_.col(sidesATouch * static_cast<Eigen::Index>(t) + side) = linearised.discretisation->withZeros(x);
    }
  });
  if (stop.stop_requested()) return {};
  return found;
}

std::vector<TouchInfluence> TouchFields::of(const LinearReadings& readings, int threads,
                                            const std::stop_token& stop) const {
  const LinearisedBlock& linearised = problem_.block();
  const PointProbe probe(linearised.mesh, readings.points_mm);
  const auto rest = linearised.initialTangent(threads, stop);
  if (!rest) throw Cancelled();
  Eigen::MatrixXd points(3 * readings.points_mm.cols(), moved_.cols());
  forChunks(static_cast<int>(readings.points_mm.cols()), pointsAtOnce, threads, [&](int begin, int end) {
    if (stop.stop_requested()) throw Cancelled();
    for (int p = begin; p < end; ++p) {
      const PointProbe::Host& host = probe.hosts()[static_cast<std::size_t>(p)].front();
      const Eigen::Matrix3Xd motion = pointMotion(host, *linearised.discretisation, *rest);
      Eigen::MatrixXd nodes(motion.cols(), moved_.cols());
      for (Eigen::Index n = 0; n < host.shapes.size(); ++n)
        nodes.middleRows<3>(3 * n) = moved_.middleRows<3>(3 * Eigen::Index(linearised.mesh.elements(n, host.element)));
      points.middleRows<3>(3 * Eigen::Index(p)) = motion * nodes;
    }
  });
  // By Eq. (1) a reading depends on few points.
  const Eigen::SparseMatrix<double, Eigen::RowMajor> few = readings.gradient_per_mm.sparseView();
  const bool sparse = double(few.nonZeros()) < sparseBelow * double(readings.gradient_per_mm.size());
  const Eigen::MatrixXd all =
      sparse ? Eigen::MatrixXd(few * points) : Eigen::MatrixXd(readings.gradient_per_mm * points);
  std::vector<TouchInfluence> result(radii_mm_.size());
  for (std::size_t t = 0; t < result.size(); ++t) {
    const auto side = [&](Eigen::Index k) { return all.col(sidesATouch * static_cast<Eigen::Index>(t) + k); };
    TouchInfluence& of = result[t];
    of.radius_mm = radii_mm_[t];
    of.perNewton.resize(all.rows(), 3);
    for (Eigen::Index axis = 0; axis < 3; ++axis) of.perNewton.col(axis) = side(axis);
    of.byPlace_per_Nmm.resize(all.rows(), 2);
    of.byPlace_per_Nmm.col(0) = (side(3) - side(4)) / (2 * shift_mm_);
    of.byPlace_per_Nmm.col(1) = (side(5) - side(6)) / (2 * shift_mm_);
  }
  return result;
}

} // namespace palp
