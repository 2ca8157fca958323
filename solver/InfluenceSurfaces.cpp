#include "solver/InfluenceSurfaces.h"

#include "model/base/Cancelled.h"
#include "model/base/Parallel.h"
#include "model/base/ProgressRelay.h"
#include "solver/PointProbe.h"
#include "solver/contact/ContactDisc.h"
#include "solver/contact/ContactEstimate.h"
#include "solver/statics/LinearisedBlock.h"
#include "solver/statics/PointMotion.h"

#include <algorithm>
#include <array>

namespace palp {

namespace {

constexpr int kTouchesAtOnce = 8;

/// A point by its element.
struct HeldPoint {
  int element = 0;
  Eigen::Matrix3Xd motion; ///< pointMotion
};

/// The gradients of some readings as loads on the free displacements, one a lane.
void loadsOf(const LinearReadings& readings, Eigen::Index first, Eigen::Index count,
             const std::vector<HeldPoint>& points, const Discretisation& mesh, LaneSides::Lanes loads) {
  loads.setZero();
  for (std::size_t p = 0; p < points.size(); ++p) {
    const HeldPoint& point = points[p];
    const auto gradients = readings.gradient_per_mm.block(first, 3 * static_cast<Eigen::Index>(p), count, 3);
    if (gradients.isZero(0)) continue;
    const Eigen::MatrixXd shares = point.motion.transpose() * gradients.transpose();
    for (int n = 0; n < shares.rows() / 3; ++n)
      for (int axis = 0; axis < 3; ++axis)
        if (const int row = mesh.freeIndex(3 * mesh.node(point.element, n) + axis); row >= 0)
          loads.row(row).head(count) += shares.row(3 * n + axis);
  }
}

/// The mesh less the elements without any of these nodes (-1: none), in the same order.
Mesh elementsWith(const Mesh& mesh, const std::vector<int>& chosen) {
  std::vector<int> kept;
  for (int e = 0; e < mesh.elementCount(); ++e)
    if ((mesh.elements.col(e).array().unaryExpr([&](int n) { return chosen[static_cast<std::size_t>(n)]; }) >= 0).any())
      kept.push_back(e);
  Mesh part = mesh;
  part.elements = mesh.elements(Eigen::all, kept);
  return part;
}

} // namespace

std::optional<InfluenceSurfaces> InfluenceSurfaces::find(const HyperelasticProblem& problem,
                                                         const LinearReadings& readings, int threads,
                                                         const std::stop_token& stop,
                                                         const std::function<void(std::size_t more)>& progress) {
  const LinearisedBlock& linearised = problem.block();
  const PointProbe probe(linearised.mesh, readings.points_mm);
  const auto rest = linearised.initialTangent(threads, stop);
  if (!rest) return {};
  std::vector<HeldPoint> points;
  for (const auto& hosts : probe.hosts())
    points.push_back({hosts.front().element, pointMotion(hosts.front(), *linearised.discretisation, *rest)});
  InfluenceSurfaces found(problem);
  const double top_mm = linearised.design.block_mm.z();
  std::vector<int> nodes;
  found.topNode_.assign(static_cast<std::size_t>(linearised.mesh.nodes_mm.cols()), -1);
  for (Eigen::Index n = 0; n < linearised.mesh.nodes_mm.cols(); ++n)
    if (linearised.mesh.nodes_mm(2, n) > (1 - 1e-9) * top_mm) {
      found.topNode_[static_cast<std::size_t>(n)] = static_cast<int>(nodes.size());
      nodes.push_back(static_cast<int>(n));
    }
  found.top_ = elementsWith(linearised.mesh, found.topNode_);
  const Eigen::Index count = readings.gradient_per_mm.rows();
  ProgressRelay relay(progress);
  found.surfaces_.setZero(3 * count, static_cast<Eigen::Index>(nodes.size()));
  const Discretisation& mesh = *linearised.discretisation;
  const Eigen::Index batches = (count + batchColumns - 1) / batchColumns;
  forChunks(static_cast<int>(batches), 1, threads, [&](int batch, int) {
    if (stop.stop_requested()) return;
    const Eigen::Index first = Eigen::Index(batch) * batchColumns,
                       some = std::min<Eigen::Index>(batchColumns, count - first);
    LaneSides sides(mesh.dof());
    loadsOf(readings, first, some, points, mesh, sides.lanes(sides.right));
    rest->factor.solve(sides, stop);
    if (stop.stop_requested()) return;
    const LaneSides::Lanes moved = sides.lanes(sides.x);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        if (const int row = mesh.freeIndex(3 * nodes[i] + axis); row >= 0)
          found.surfaces_.col(Eigen::Index(i)).segment(axis * count + first, some) =
              moved.row(row).head(some).transpose();
    relay.add(static_cast<std::size_t>(some));
  });
  if (stop.stop_requested()) return {};
  return found;
}

Eigen::MatrixXd InfluenceSurfaces::influence(const Eigen::Ref<const Eigen::Matrix2Xd>& points_mm,
                                             const Eigen::Ref<const Eigen::MatrixXd>& sums) const {
  const Eigen::Vector3d block_mm = problem_.design().block_mm;
  Eigen::Matrix3Xd places(3, points_mm.cols());
  places.topRows<2>() = points_mm.cwiseMax(0).cwiseMin(block_mm.head<2>().replicate(1, points_mm.cols()));
  places.row(2).setConstant(block_mm.z());
  const PointProbe probe(top_, places);
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(surfaces_.cols(), sums.cols());
  std::vector<char> shared(static_cast<std::size_t>(surfaces_.cols()), 0);
  std::vector<Eigen::Index> own; // sums of a point
  for (Eigen::Index p = 0; p < points_mm.cols(); ++p) {
    own.clear();
    for (Eigen::Index c = 0; c < sums.cols(); ++c)
      if (sums(p, c) != 0) own.push_back(c);
    const PointProbe::Host& host = probe.hosts()[static_cast<std::size_t>(p)].front();
    for (Eigen::Index n = 0; n < host.shapes.size(); ++n) {
      const int top = topNode_[static_cast<std::size_t>(top_.elements(n, host.element))];
      if (top < 0) continue; // its shape function is 0 on the face
      shared[static_cast<std::size_t>(top)] = 1;
      for (const Eigen::Index c : own) shares(top, c) += host.shapes(n) * sums(p, c);
    }
  }
  std::vector<int> used; // few nodes share in a sum: the others cost nothing
  for (std::size_t top = 0; top < shared.size(); ++top)
    if (shared[top]) used.push_back(static_cast<int>(top));
  return surfaces_(Eigen::all, used) * shares(used, Eigen::all);
}

std::vector<Eigen::MatrixX3d> InfluenceSurfaces::at(const Eigen::Ref<const Eigen::Matrix2Xd>& points_mm) const {
  const Eigen::MatrixXd all = influence(points_mm, Eigen::MatrixXd::Identity(points_mm.cols(), points_mm.cols()));
  std::vector<Eigen::MatrixX3d> result;
  for (Eigen::Index p = 0; p < points_mm.cols(); ++p) result.emplace_back(all.col(p).reshaped(all.rows() / 3, 3));
  return result;
}

Eigen::MatrixXd InfluenceSurfaces::under(std::span<const Indenter> touches, int threads,
                                         const std::stop_token& stop) const {
  const ContactDisc& disc = contactDisc();
  const Eigen::Index count = surfaces_.rows() / 3;
  Eigen::MatrixXd result(count, static_cast<Eigen::Index>(touches.size()));
  forChunks(static_cast<int>(touches.size()), kTouchesAtOnce, threads, [&](int begin, int end) {
    if (stop.stop_requested()) throw Cancelled();
    Eigen::Matrix2Xd points(2, contactDiscPoints * (end - begin));
    // Normal: Hertz's pressure or that under a flat end; and tangential.
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(points.cols(), 2 * (end - begin));
    for (int i = begin; i < end; ++i) {
      const Indenter& touch = touches[static_cast<std::size_t>(i)];
      const double radius_mm = contactEstimate(touch, problem_.design()).half_mm.x();
      const Eigen::Index first = contactDiscPoints * (i - begin);
      points.middleCols(first, contactDiscPoints) = (radius_mm * disc.points).colwise() + touch.place_mm;
      sums.col(2 * (i - begin)).segment(first, contactDiscPoints) =
          touch.shape == IndenterShape::Flat ? disc.flat : disc.hertz;
      sums.col(2 * (i - begin) + 1).segment(first, contactDiscPoints) = disc.flat;
    }
    const Eigen::MatrixXd all = influence(points, sums);
    for (int i = begin; i < end; ++i) {
      const Eigen::Vector3d force_N = touches[static_cast<std::size_t>(i)].press()->force_N;
      const auto pressed = all.col(2 * (i - begin)), aside = all.col(2 * (i - begin) + 1);
      result.col(i) = force_N.z() * pressed.tail(count) + force_N.x() * aside.head(count) +
                      force_N.y() * aside.segment(count, count);
    }
  });
  return result;
}

std::vector<TouchInfluence> InfluenceSurfaces::of(std::span<const Indenter> touches, int threads,
                                                  const std::stop_token& stop) const {
  const ContactDisc& disc = contactDisc();
  const double shift_mm = placeShiftShare * problem_.design().block_mm.z();
  const std::array<Eigen::Vector2d, 5> shifts{Eigen::Vector2d::Zero(), Eigen::Vector2d(shift_mm, 0),
                                              Eigen::Vector2d(-shift_mm, 0), Eigen::Vector2d(0, shift_mm),
                                              Eigen::Vector2d(0, -shift_mm)};
  const Eigen::Index count = surfaces_.rows() / 3;
  std::vector<TouchInfluence> result(touches.size());
  forChunks(static_cast<int>(touches.size()), kTouchesAtOnce, threads, [&](int begin, int end) {
    if (stop.stop_requested()) throw Cancelled();
    constexpr Eigen::Index sumsEach = 6; // normal at the five positions, and tangential in the middle
    const Eigen::Index pointsEach = 5 * contactDiscPoints;
    Eigen::Matrix2Xd points(2, pointsEach * (end - begin));
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(points.cols(), sumsEach * (end - begin));
    for (int i = begin; i < end; ++i) {
      const Indenter& touch = touches[static_cast<std::size_t>(i)];
      const double radius_mm = contactEstimate(touch, problem_.design()).half_mm.x();
      result[static_cast<std::size_t>(i)].radius_mm = radius_mm;
      const Eigen::VectorXd& pressure = touch.shape == IndenterShape::Flat ? disc.flat : disc.hertz;
      for (Eigen::Index s = 0; s < 5; ++s) {
        const Eigen::Index first = pointsEach * (i - begin) + s * contactDiscPoints;
        points.middleCols(first, contactDiscPoints) =
            (radius_mm * disc.points).colwise() + (touch.place_mm + shifts[static_cast<std::size_t>(s)]);
        sums.col(sumsEach * (i - begin) + s).segment(first, contactDiscPoints) = pressure;
      }
      sums.col(sumsEach * (i - begin) + 5).segment(pointsEach * (i - begin), contactDiscPoints) = disc.flat;
    }
    const Eigen::MatrixXd all = influence(points, sums);
    for (int i = begin; i < end; ++i) {
      TouchInfluence& of = result[static_cast<std::size_t>(i)];
      const auto pressed = [&](Eigen::Index s) { return all.col(sumsEach * (i - begin) + s).tail(count); };
      of.perNewton.resize(count, 3);
      of.perNewton.leftCols<2>() = all.col(sumsEach * (i - begin) + 5).head(2 * count).reshaped(count, 2);
      of.perNewton.col(2) = pressed(0);
      of.byPlace_per_Nmm.resize(count, 2);
      of.byPlace_per_Nmm.col(0) = (pressed(1) - pressed(2)) / (2 * shift_mm);
      of.byPlace_per_Nmm.col(1) = (pressed(3) - pressed(4)) / (2 * shift_mm);
    }
  });
  return result;
}

} // namespace palp
