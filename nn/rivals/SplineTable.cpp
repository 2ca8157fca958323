#include "nn/rivals/SplineTable.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kSplines = 4; // that are not 0 at a place

struct SplinesAt {
  int first = 0;
  std::array<double, kSplines> value{}, slope{};
};

SplinesAt splinesAt(double place, double low, double step, int nodes) {
  // Spline i has its middle at low + i step.
  const double t = std::clamp((place - low) / step - 1, 0.0, static_cast<double>(nodes - 3));
  const int first = std::min(static_cast<int>(t), nodes - kSplines);
  const double s = t - first, r = 1 - s;
  SplinesAt at;
  at.first = first;
  at.value = {r * r * r / 6, (4 - 6 * s * s + 3 * s * s * s) / 6, (4 - 6 * r * r + 3 * r * r * r) / 6, s * s * s / 6};
  at.slope = {-r * r / 2 / step, (-4 * s + 3 * s * s) / 2 / step, (4 * r - 3 * r * r) / 2 / step, s * s / 2 / step};
  return at;
}

/// Along one line of nodes: coefficients c with (c_(i-1) + 4 c_i + c_(i+1)) / 6 = value_i for the inner nodes i; at the
/// ends fourth differences are 0 ("not a knot": cubics are exact), on few nodes second ones.
Eigen::MatrixXd collocation(int nodes) {
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(nodes, nodes);
  for (int i = 1; i < nodes - 1; ++i) system.row(i).segment<3>(i - 1) << 1. / 6, 4. / 6, 1. / 6;
  if (nodes < 6) {
    system.row(0).head<3>() << 1, -2, 1;
    system.row(nodes - 1).tail<3>() << 1, -2, 1;
  } else {
    system.row(0).head<5>() << 1, -4, 6, -4, 1;
    system.row(nodes - 1).tail<5>() << 1, -4, 6, -4, 1;
  }
  return system;
}

} // namespace

void SplineTable::evaluate(const Eigen::Ref<const Eigen::VectorXd>& input, Eigen::VectorXd& value,
                           Eigen::MatrixXd& slope) const {
  std::array<SplinesAt, 2> at;
  for (std::size_t axis = 0; axis < 2; ++axis)
    at[axis] = splinesAt(place[axis] < 0 ? low(static_cast<Eigen::Index>(axis)) : input(place[axis]),
                         low(static_cast<Eigen::Index>(axis)), step(static_cast<Eigen::Index>(axis)), nodes[axis]);
  // Monomials, and their derivatives by each input.
  const Eigen::Index count = terms();
  Eigen::MatrixXd factors = Eigen::MatrixXd::Zero(count, 1 + inputs());
  for (Eigen::Index j = 0; j < count; ++j) {
    factors(j, 0) = 1;
    for (Eigen::Index k = 0; k < inputs(); ++k) {
      const int power = exponents(k, j);
      if (power > 0) factors(j, 0) *= std::pow(input(k) + shift(k), power);
    }
    for (Eigen::Index by = 0; by < inputs(); ++by) {
      if (exponents(by, j) == 0) continue;
      double derivative = exponents(by, j);
      for (Eigen::Index k = 0; k < inputs(); ++k)
        derivative *= std::pow(input(k) + shift(k), exponents(k, j) - (k == by ? 1 : 0));
      factors(j, 1 + by) = derivative;
    }
  }
  // Over the splines first: value and both slopes of each term's coefficient.
  value = rest;
  slope.setZero(outputs(), inputs());
  Eigen::MatrixXd inRow(outputs(), count), acrossRow(outputs(), count);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(outputs(), count);
  for (int iy = 0; iy < kSplines; ++iy) {
    const double v = at[1].value[static_cast<std::size_t>(iy)], dv = at[1].slope[static_cast<std::size_t>(iy)];
    inRow.setZero();
    acrossRow.setZero();
    for (int ix = 0; ix < kSplines; ++ix) {
      const Eigen::Index node = at[0].first + ix + Eigen::Index(nodes[0]) * (at[1].first + iy);
      const auto here = coefficients.middleCols(count * node, count);
      inRow += at[0].value[static_cast<std::size_t>(ix)] * here;
      if (place[0] >= 0) acrossRow += at[0].slope[static_cast<std::size_t>(ix)] * here;
    }
    all += v * inRow;
    if (place[0] >= 0) slope.col(place[0]).noalias() += v * (acrossRow * factors.col(0));
    if (place[1] >= 0) slope.col(place[1]).noalias() += dv * (inRow * factors.col(0));
  }
  value.noalias() += all * factors.col(0);
  for (Eigen::Index k = 0; k < inputs(); ++k)
    if (k != place[0] && k != place[1]) slope.col(k).noalias() = all * factors.col(1 + k);
}

void SplineTable::interpolate(Eigen::MatrixXd values) {
  const Eigen::Index block = outputs() * terms();
  for (int axis = 0; axis < 2; ++axis) {
    const int along = nodes[static_cast<std::size_t>(axis)], lines = nodes[static_cast<std::size_t>(1 - axis)];
    const Eigen::Index between = axis == 0 ? 1 : nodes[0], next = axis == 0 ? nodes[0] : 1;
    const Eigen::PartialPivLU<Eigen::MatrixXd> solver(collocation(along));
    Eigen::MatrixXd line(along, block);
    for (int l = 0; l < lines; ++l) {
      if (axis == 0 && (l == 0 || l == lines - 1)) continue; // no values there yet
      const auto node = [&](int i) { return values.data() + block * (l * next + i * between); };
      line.row(0).setZero();
      line.row(along - 1).setZero();
      for (int i = 1; i < along - 1; ++i) line.row(i) = Eigen::Map<const Eigen::RowVectorXd>(node(i), block);
      line = solver.solve(line).eval();
      for (int i = 0; i < along; ++i) Eigen::Map<Eigen::RowVectorXd>(node(i), block) = line.row(i);
    }
  }
  coefficients = std::move(values);
}

} // namespace palp
