#include "model/BoxGreen.h"

#include "model/base/Parallel.h"
#include "model/field/HeatKernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

namespace palp {

namespace {

constexpr double kDigits = 16;
/// The direct kernel at no distance, times t^1.5.
const double kFree = std::pow(4 * std::numbers::pi, -1.5);

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
  assert(least > 0 && "points lie inside the block, no two at one place");
  return least;
}

/// The sums over time, column by column.
class Sums {
public:
  Sums(const Eigen::Vector3d& block, const Eigen::Ref<const Eigen::Matrix3Xd>& points, bool withCurvature)
      : withCurvature_(withCurvature), even_(1 / block.prod()),
        times_(heatTimes(nearest(block, points), block.maxCoeff(), kDigits)), places_{AxisPlaces(points.row(0)),
                                                                                      AxisPlaces(points.row(1)),
                                                                                      AxisPlaces(points.row(2))},
        tables_(static_cast<std::size_t>(times_.time.size())) {
    for (std::size_t t = 0; t < tables_.size(); ++t)
      for (std::size_t axis = 0; axis < 3; ++axis)
        tables_[t][axis] =
            tablesOf(places_[axis], times_.time(static_cast<Eigen::Index>(t)), block(static_cast<Eigen::Index>(axis)));
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(points.cols(), points.cols());
    green.value = zero;
    green.slope.fill(zero);
    if (!withCurvature) return;
    green.curvature.own.fill(zero);
    green.curvature.mixed.fill(zero);
  }

  void addColumn(Eigen::Index q) {
    Column column;
    Eigen::Matrix3d self = Eigen::Matrix3d::Zero();
    for (std::size_t t = 0; t < tables_.size(); ++t) {
      const double time = times_.time(static_cast<Eigen::Index>(t)),
                   weight = times_.weight(static_cast<Eigen::Index>(t));
      for (std::size_t axis = 0; axis < 3; ++axis) column[axis].read(tables_[t][axis], places_[axis], q);
      const auto& [x, y, z] = column;
      green.value.col(q).array() += weight * (x.k * y.k * z.k - even_);
      green.value(q, q) -= weight * kFree * std::pow(time, -1.5);
      green.slope[0].col(q).array() += weight * x.a * y.k * z.k;
      green.slope[1].col(q).array() += weight * x.k * y.a * z.k;
      green.slope[2].col(q).array() += weight * x.k * y.k * z.a;
      if (!withCurvature_) continue;
      addCurvature(green.curvature, column, q, weight);
      addSelf(self, column, q, weight);
    }
    green.value.col(q).array() -= times_.before * even_; // no kernel has arrived yet, its mean has
    green.value(q, q) -= times_.after * kFree;
    if (!withCurvature_) return;
    for (Eigen::MatrixXd& part : green.curvature.own) part(q, q) = 0;
    for (std::size_t i = 0; i < 9; ++i)
      green.curvature.mixed[i](q, q) = self(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
  }

  BoxGreen green;

private:
  bool withCurvature_;
  double even_; ///< what all comes to, 1 / V
  HeatTimes times_;
  std::array<AxisPlaces, 3> places_;
  std::vector<std::array<Tables, 3>> tables_; ///< at each time
};

} // namespace

BoxGreen boxGreen(const Eigen::Vector3d& block_mm, const Eigen::Ref<const Eigen::Matrix3Xd>& points_mm,
                  bool withCurvature, int threads) {
  Sums sums(block_mm, points_mm, withCurvature);
  inParallel(static_cast<std::size_t>(points_mm.cols()), threads,
             [&](std::size_t q) { sums.addColumn(static_cast<Eigen::Index>(q)); });
  return std::move(sums.green);
}

} // namespace palp
