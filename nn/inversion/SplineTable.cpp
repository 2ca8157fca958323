#include "nn/inversion/SplineTable.h"

#include "nn/linear/Lapack.h"
#include "nn/linear/VectorKernels.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace palp {

namespace {

constexpr int kSplines = 4; // nonzero at a position

std::size_t size(Eigen::Index count) {
  return static_cast<std::size_t>(count);
}

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

template <class Number>
void SplineTable::evaluate(const Number* numbers, double unit, const Eigen::Ref<const Eigen::VectorXd>& input,
                           Eigen::VectorXd& value, Eigen::MatrixXd& slope) const {
  assert(input.size() == inputs() && "one number for each input");
  std::array<SplinesAt, 2> at;
  for (std::size_t axis = 0; axis < 2; ++axis)
    at[axis] = splinesAt(place[axis] < 0 ? low(static_cast<Eigen::Index>(axis)) : input(place[axis]),
                         low(static_cast<Eigen::Index>(axis)), step(static_cast<Eigen::Index>(axis)), nodes[axis]);
  // The splines' sums of the coefficients, outputs x terms: values and derivatives by the coordinates.
  const Eigen::Index block = outputs() * terms();
  Eigen::MatrixX3d atPlace(block, 3);
  Eigen::Matrix<double, kSplines * kSplines, 3> shares;
  std::array<const Number*, kernels::kSplineColumns> columns;
  for (std::size_t iy = 0, i = 0; iy < kSplines; ++iy)
    for (std::size_t ix = 0; ix < kSplines; ++ix, ++i) {
      shares.row(static_cast<Eigen::Index>(i)) << at[0].value[ix] * at[1].value[iy], at[0].slope[ix] * at[1].value[iy],
          at[0].value[ix] * at[1].slope[iy];
      const std::size_t node = size(at[0].first) + ix + size(nodes[0]) * (size(at[1].first) + iy);
      columns[i] = numbers + size(block) * node;
    }
  kernels::threeSums(columns.data(), size(block), shares.data(), atPlace.data());
  const auto termsOf = [&](Eigen::Index column) { return atPlace.col(column).reshaped(outputs(), terms()); };
  const Eigen::MatrixXd factors = unit * monomials(input);
  const Eigen::MatrixXd all = lapack::product(termsOf(0), false, factors, false);
  value = rest + all.col(0);
  slope = all.rightCols(inputs());
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (place[axis] >= 0)
      slope.col(place[axis]) = lapack::product(termsOf(1 + Eigen::Index(axis)), false, factors.col(0), false);
}

void SplineTable::evaluate(const Eigen::Ref<const Eigen::VectorXd>& input, Eigen::VectorXd& value,
                           Eigen::MatrixXd& slope) const {
  evaluate(coefficients.data(), 1, input, value, slope);
}

SplineReader::SplineReader(const SplineTable& table)
    : table_(table), parts_((SplineTable::kParts * table.coefficients).cast<float>()) {}

void SplineReader::evaluate(const Eigen::Ref<const Eigen::VectorXd>& input, Eigen::VectorXd& value,
                            Eigen::MatrixXd& slope) const {
  table_.evaluate(parts_.data(), 1 / SplineTable::kParts, input, value, slope);
}

/// Terms x (1 + inputs): each monomial, and its derivatives by each input.
Eigen::MatrixXd SplineTable::monomials(const Eigen::Ref<const Eigen::VectorXd>& input) const {
  const int most = exponents.size() > 0 ? exponents.maxCoeff() : 0;
  Eigen::MatrixXd powers(most + 1, inputs());
  powers.row(0).setOnes();
  for (int power = 1; power <= most; ++power)
    powers.row(power) = powers.row(power - 1).cwiseProduct((input + shift).transpose());
  Eigen::MatrixXd factors(terms(), 1 + inputs());
  for (Eigen::Index j = 0; j < terms(); ++j) {
    const auto product = [&](Eigen::Index by) {
      double result = 1;
      for (Eigen::Index k = 0; k < inputs(); ++k) result *= powers(exponents(k, j) - (k == by ? 1 : 0), k);
      return result;
    };
    factors(j, 0) = product(-1);
    for (Eigen::Index by = 0; by < inputs(); ++by)
      factors(j, 1 + by) = exponents(by, j) > 0 ? exponents(by, j) * product(by) : 0;
  }
  return factors;
}

void SplineTable::interpolate(Eigen::MatrixXd values) {
  assert(values.cols() == terms() * nodes[0] * nodes[1] && "one column for each term and node");
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
