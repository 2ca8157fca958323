// SparseCholesky::solve for 32 right-hand sides together.

#include "solver/element/ElementKernels.h"
#include "solver/linear/SparseCholesky.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace palp {

namespace {

constexpr int laneSupernodesACall = 16; // between looks at a stop request

} // namespace

LaneSides::LaneSides(int unknownCount, int heldCount)
    : unknowns(unknownCount), held(heldCount), right(std::size_t(unknownCount + heldCount) * batchColumns),
      first(right.size()), x(right.size()) {}

/// x = K^-1 b, both [unknowns][batchColumns]; each right side goes through the factor relative to its norm.
void SparseCholesky::substitute(const double* b, UnsetArray<float>& work, double* x,
                                const std::stop_token& stop) const {
  const LaneKernels& kernels = laneKernels();
  const int* rowOf = plan_->rowOf().data();
  const int unknowns = plan_->tree().size();
  std::array<double, batchColumns> norm{}, inverse{};
  kernels.addSquares(b, unknowns, norm.data());
  unsigned live = 0;
  for (std::size_t k = 0; k < batchColumns; ++k) {
    norm[k] = std::sqrt(norm[k]);
    if (norm[k] > 0) inverse[k] = 1 / norm[k];
    if (norm[k] > 0) live |= 1U << static_cast<unsigned>(k / lanes);
  }
  kernels.narrow(b, inverse.data(), rowOf, unknowns, work.data());
  std::fill_n(work.data() + std::size_t(unknowns) * batchColumns, batchColumns, 0.F);
  const BlockedFactor factor = blocks();
  for (int first = 0; first < factor.count && !stop.stop_requested(); first += laneSupernodesACall)
    kernels.forward(factor, first, std::min(factor.count, first + laneSupernodesACall), live, work.data());
  for (int last = factor.count; last > 0 && !stop.stop_requested(); last -= laneSupernodesACall)
    kernels.backward(factor, std::max(0, last - laneSupernodesACall), last, live, work.data());
  kernels.widen(work.data(), norm.data(), rowOf, unknowns, x);
}

void SparseCholesky::solve(LaneSides& sides, const std::stop_token& stop) const {
  assert(sides.unknowns == plan_->tree().size() && "one row for each unknown");
  const std::size_t held = std::size_t(sides.held) * batchColumns;
  for (UnsetArray<double>* each : {&sides.right, &sides.first, &sides.x}) std::fill_n(each->data(), held, 0.);
  double *right = sides.right.data() + held, *first = sides.first.data() + held;
  UnsetArray<float> work(std::size_t(plan_->tree().size() + 1) * batchColumns);
  substitute(right, work, first, stop);
  const SparsePattern& pattern = plan_->pattern();
  laneKernels().subtractProduct({pattern.size(), pattern.columns.data(), pattern.rows.data(), matrix_.data()}, first,
                                right);
  substitute(right, work, sides.x.data() + held, stop);
  for (std::size_t i = 0; i < sides.x.size(); ++i) sides.x.data()[i] += sides.first.data()[i];
}

} // namespace palp
