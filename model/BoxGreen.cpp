#include "model/BoxGreen.h"

#include "model/field/HeatKernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

namespace palp {

namespace {

constexpr int kPointsAPanel = 14;

/// The distinct coordinates along an axis and which of them each point has: layouts on straight wires have few.
struct AxisPlaces {
  std::vector<double> distinct;
  std::vector<Eigen::Index> of;

  explicit AxisPlaces(const Eigen::RowVectorXd& coordinates)
      : distinct(coordinates.begin(), coordinates.end()), of(static_cast<std::size_t>(coordinates.size())) {
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    std::transform(coordinates.begin(), coordinates.end(), of.begin(),
                   [&](double x) { return std::lower_bound(distinct.begin(), distinct.end(), x) - distinct.begin(); });
  }
};

/// What k(a, b) = theta(a - b) + theta(a + b) and its derivatives are made of, for the distinct coordinates:
/// k' by a is near' + far', by b far' - near'; k'' by a twice near'' + far'', by a and b far'' - near''.
enum Part { Value, NearSlope, FarSlope, NearCurvature, FarCurvature, Parts };

using Tables = std::array<Eigen::MatrixXd, Parts>;

Tables tablesOf(const AxisPlaces& places, double time, double length) {
  const auto count = static_cast<Eigen::Index>(places.distinct.size());
  Tables tables;
  tables.fill(Eigen::MatrixXd(count, count));
  for (Eigen::Index b = 0; b < count; ++b)
    for (Eigen::Index a = 0; a < count; ++a) {
      const double x = places.distinct[static_cast<std::size_t>(a)], y = places.distinct[static_cast<std::size_t>(b)];
      const KernelJet near = circleKernel(x - y, time, length), far = circleKernel(x + y, time, length);
      tables[Value](a, b) = near.value + far.value;
      tables[NearSlope](a, b) = near.slope;
      tables[FarSlope](a, b) = far.slope;
      tables[NearCurvature](a, b) = near.curvature;
      tables[FarCurvature](a, b) = far.curvature;
    }
  return tables;
}

/// A kernel along one axis for all first points p (entries) and one second point q.
struct AxisColumn {
  Eigen::ArrayXd k, a, b, aa, ab; ///< value, derivatives by p, by q, by p twice, by p and q
  double self = 0;                ///< aa + ab at p = q, whose direct parts cancel

  void read(const Tables& tables, const AxisPlaces& places, Eigen::Index q) {
    const auto count = static_cast<Eigen::Index>(places.of.size());
    for (Eigen::ArrayXd* part : {&k, &a, &b, &aa, &ab}) part->resize(count);
    const Eigen::Index column = places.of[static_cast<std::size_t>(q)];
    for (Eigen::Index p = 0; p < count; ++p) {
      const Eigen::Index row = places.of[static_cast<std::size_t>(p)];
      k(p) = tables[Value](row, column);
      a(p) = tables[FarSlope](row, column) + tables[NearSlope](row, column);
      b(p) = tables[FarSlope](row, column) - tables[NearSlope](row, column);
      aa(p) = tables[FarCurvature](row, column) + tables[NearCurvature](row, column);
      ab(p) = tables[FarCurvature](row, column) - tables[NearCurvature](row, column);
    }
    self = 2 * tables[FarCurvature](column, column);
  }
};

using Column = std::array<AxisColumn, 3>;

/// Adds what one time gives to column q of the second derivatives.
void addCurvature(BoxGreen::Curvature& sums, const Column& c, Eigen::Index q, double weight) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
    sums.own[i].col(q).array() += weight * c[i].aa * c[j].k * c[l].k;
    sums.own[3 + i].col(q).array() += weight * c[i].a * c[j].a * c[l].k; // xy, yz, zx
    sums.mixed[4 * i].col(q).array() += weight * c[i].ab * c[j].k * c[l].k;
    sums.mixed[3 * i + j].col(q).array() += weight * c[i].a * c[j].b * c[l].k;
    sums.mixed[3 * j + i].col(q).array() += weight * c[i].b * c[j].a * c[l].k;
  }
}

/// Adds what one time gives to the change of the regular gradient with the point's own place.
void addSelf(Eigen::Matrix3d& sum, const Column& c, Eigen::Index q, double weight) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
    const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
    sum(row, row) += weight * c[i].self * c[j].k(q) * c[l].k(q);
    // d/dx_j of (a_i k_j k_l) at one place, where k_j changes by both of its ends
    const double across = 2 * weight * c[i].a(q) * c[j].a(q) * c[l].k(q);
    sum(row, column) += across;
    sum(column, row) += across;
  }
}

/// The least distance between two points, and between a point and its image in a wall.
double nearest(const Eigen::Vector3d& block, const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  double least = 2 * std::min(points.rowwise().minCoeff().minCoeff(), (block - points.rowwise().maxCoeff()).minCoeff());
  for (Eigen::Index p = 0; p + 1 < points.cols(); ++p)
    least = std::min(
        least,
        std::sqrt(
            (points.rightCols(points.cols() - p - 1).colwise() - points.col(p)).colwise().squaredNorm().minCoeff()));
  return least;
}

/// What one time adds to the sums.
class Sums {
public:
  Sums(const Eigen::Vector3d& block, const Eigen::Ref<const Eigen::Matrix3Xd>& points, bool withCurvature)
      : block_(block), places_{AxisPlaces(points.row(0)), AxisPlaces(points.row(1)), AxisPlaces(points.row(2))},
        self_(withCurvature ? static_cast<std::size_t>(points.cols()) : 0, Eigen::Matrix3d::Zero()) {
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(points.cols(), points.cols());
    green.value = zero;
    green.slope.fill(zero);
    if (!withCurvature) return;
    green.curvature.own.fill(zero);
    green.curvature.mixed.fill(zero);
  }

  void add(double time, double weight) {
    std::array<Tables, 3> tables;
    for (std::size_t axis = 0; axis < 3; ++axis)
      tables[axis] = tablesOf(places_[axis], time, block_(static_cast<Eigen::Index>(axis)));
    const double even = 1 / block_.prod();
    const double free = std::pow(4 * std::numbers::pi * time, -1.5); // the direct kernel at no distance
    Column column;
    for (Eigen::Index q = 0; q < green.value.cols(); ++q) {
      for (std::size_t axis = 0; axis < 3; ++axis) column[axis].read(tables[axis], places_[axis], q);
      const auto& [x, y, z] = column;
      green.value.col(q).array() += weight * (x.k * y.k * z.k - even);
      green.value(q, q) -= weight * free;
      green.slope[0].col(q).array() += weight * x.a * y.k * z.k;
      green.slope[1].col(q).array() += weight * x.k * y.a * z.k;
      green.slope[2].col(q).array() += weight * x.k * y.k * z.a;
      if (self_.empty()) continue;
      addCurvature(green.curvature, column, q, weight);
      addSelf(self_[static_cast<std::size_t>(q)], column, q, weight);
    }
  }

  void finish(const HeatTimes& times) {
    const double even = 1 / block_.prod();
    green.value.array() -= times.first * even; // no kernel has arrived yet, its mean has
    // of the direct kernel what lies beyond the last time
    green.value.diagonal().array() -= 2 * std::pow(4 * std::numbers::pi, -1.5) / std::sqrt(times.last);
    for (std::size_t q = 0; q < self_.size(); ++q) {
      const auto at = static_cast<Eigen::Index>(q);
      for (Eigen::MatrixXd& part : green.curvature.own) part(at, at) = 0;
      for (std::size_t i = 0; i < 9; ++i)
        green.curvature.mixed[i](at, at) = self_[q](static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
    }
  }

  BoxGreen green;

private:
  Eigen::Vector3d block_;
  std::array<AxisPlaces, 3> places_;
  std::vector<Eigen::Matrix3d> self_;
};

} // namespace

BoxGreen boxGreen(const Eigen::Vector3d& block_mm, const Eigen::Ref<const Eigen::Matrix3Xd>& points_mm,
                  bool withCurvature) {
  const double least = nearest(block_mm, points_mm);
  assert(least > 0 && "points lie inside the block, no two at one place");
  const HeatTimes times = heatTimes(least, block_mm.maxCoeff(), kPointsAPanel);
  Sums sums(block_mm, points_mm, withCurvature);
  for (Eigen::Index i = 0; i < times.time.size(); ++i) sums.add(times.time(i), times.weight(i));
  sums.finish(times);
  return std::move(sums.green);
}

} // namespace palp
