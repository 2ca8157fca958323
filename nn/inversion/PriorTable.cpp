#include "nn/inversion/PriorTable.h"

#include "model/base/Cancelled.h"
#include "model/base/PositiveSolve.h"
#include "nn/NetworkError.h"
#include "nn/inversion/PlaceKernel.h"

#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr double kSmallRidge = 1e-12; // of the trace: regularises directions lost to rounding

/// Solves a x = b for a symmetric semidefinite a.
Eigen::MatrixXd solveSemidefinite(Eigen::MatrixXd a, const Eigen::MatrixXd& b) {
  a.diagonal().array() += kSmallRidge * a.trace();
  return solvePositive<NetworkError>(a, b,
                                     "prior mean of the touches: the samples do not determine the table of their "
                                     "readings; expected touches of more positions, sizes and forces");
}

std::vector<Eigen::Index> otherInputs(const SplineTable& form) {
  std::vector<Eigen::Index> others;
  for (Eigen::Index k = 0; k < form.inputs(); ++k)
    if (k != form.place[0] && k != form.place[1]) others.push_back(k);
  return others;
}

/// A grid of the parameters other than the position, Chebyshev's points along each, and the matrix that turns values
/// there into coefficients of monomials.
struct OtherParameters {
  Eigen::MatrixXd points;      ///< inputs x points; 0 for the position
  Eigen::MatrixXd toMonomials; ///< points x terms
};

OtherParameters otherParameters(const SplineTable& form, bool amplitudes, const Eigen::MatrixXd& scaled) {
  const std::vector<Eigen::Index> others = otherInputs(form);
  const int levels = others.size() <= 2 ? form.exponents.maxCoeff() + 1 : 3;
  Eigen::Index count = 1;
  for (std::size_t k = 0; k < others.size(); ++k) count *= levels;
  OtherParameters grid{Eigen::MatrixXd::Zero(scaled.rows(), count), {}};
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Index rest = i;
    for (const Eigen::Index k : others) {
      const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * (static_cast<double>(rest % levels) + 0.5) / levels);
      const double low = scaled.row(k).minCoeff(), high = scaled.row(k).maxCoeff();
      grid.points(k, i) = low + share * (high - low);
      rest /= levels;
    }
  }
  const Eigen::MatrixXd terms = monomialsOf(form, grid.points, 1, amplitudes ? 1 : 0);
  grid.toMonomials = terms.transpose() * solveSemidefinite(terms * terms.transpose(),
                                                           Eigen::MatrixXd::Identity(terms.rows(), terms.rows()));
  return grid;
}

/// Fills a table that has its values at rest, one line of nodes at a time.
void fill(SplineTable& table, const OtherParameters& grid, const PriorComponents& of, const std::stop_token& stop) {
  const Eigen::Index count = grid.points.cols();
  Eigen::MatrixXd values(table.outputs(), table.terms() * table.nodes[0] * table.nodes[1]);
  for (int y = 0; y < table.nodes[1]; ++y) {
    throwIfStopped(stop);
    Eigen::MatrixXd at = grid.points.replicate(1, table.nodes[0]);
    for (int x = 0; x < table.nodes[0]; ++x)
      for (std::size_t axis = 0; axis < 2; ++axis)
        if (table.place[axis] >= 0)
          at.row(table.place[axis])
              .segment(count * x, count)
              .setConstant(nodeOf(table, x, y)(static_cast<Eigen::Index>(axis)));
    const Eigen::MatrixXd found = of(at).colwise() - table.rest;
    for (int x = 0; x < table.nodes[0]; ++x)
      values.middleCols(table.terms() * (x + Eigen::Index(table.nodes[0]) * y), table.terms()) =
          found.middleCols(count * x, count) * grid.toMonomials;
  }
  table.interpolate(std::move(values));
}

} // namespace

SplineTable priorTable(const SplineTable& form, const std::vector<int>& amplitudes, const Eigen::MatrixXd& scaled,
                       const PriorComponents& prior, const std::stop_token& stop) {
  SplineTable table = form;
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(form.inputs(), 1);
  for (const int k : amplitudes) rest(k, 0) = -form.shift(k);
  table.rest = prior(rest);
  fill(table, otherParameters(form, !amplitudes.empty(), scaled), prior, stop);
  return table;
}

} // namespace palp
