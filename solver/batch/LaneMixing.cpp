#include "solver/batch/LaneMixing.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int rowsAtOnce = 128;                   // what a pass leaves in the cache for the next block of lanes
constexpr double independent = 1e-8;              // changes whose directions differ by less are one
using Sums = std::array<double, mixSums * lanes>; // [mixSums][8]

} // namespace

LaneMixing::LaneMixing(std::size_t leading, std::size_t following, int count)
    : count_(count), leading_(leading * batchLanes * leadingPast), following_(following * batchLanes * followingPast) {}

void LaneMixing::begin(int lane, bool mixed) {
  mixed_[lane] = mixed;
  restarts_[lane] = hasLast_[lane] = false;
  known_[lane] = 0;
}

void LaneMixing::copy(int from, int to) {
  mixed_[to] = mixed_[from];
  restarts_[to] = restarts_[from];
  hasLast_[to] = hasLast_[from];
  known_[to] = known_[from];
  copyLane(leading_.data(), leading_.size(), leadingPast, from, to);
  copyLane(following_.data(), following_.size(), count_ * followingPast, from, to);
}

/// Only now: what followed the last directions has been mixed.
void LaneMixing::begin(const std::array<double, batchLanes>& scale) {
  for (int lane = 0; lane < batchLanes; ++lane) {
    const bool moves = scale[lane] > 0;
    LaneMix& mix = mixes_[lane / lanes];
    const int l = lane % lanes;
    mix.moves[l] = moves ? -1 : 0;
    mix.scale[l] = scale[lane];
    if (restarts_[lane] || (mixed_[lane] && !moves)) known_[lane] = 0;
    const bool pair = mixed_[lane] && moves && hasLast_[lane] && !restarts_[lane];
    if (pair) known_[lane] = std::min(known_[lane] + 1, mixingDepth);
    mix.pair[l] = pair ? -1 : 0;
    for (int j = 0; j < mixingDepth; ++j) {
      mix.known[j][l] = mixed_[lane] && moves && j < known_[lane] ? -1 : 0;
      mix.gamma[j][l] = 0;
    }
    hasLast_[lane] = mixed_[lane] && moves;
    restarts_[lane] = false;
  }
}

/// Normal equations of the least squares, by L D L^T with the newest change first, as far as the changes are
/// independent.
void LaneMixing::findGamma(int lane, const double* sums) {
  LaneMix& mix = mixes_[lane / lanes];
  const int l = lane % lanes;
  std::array<std::array<double, mixingDepth>, mixingDepth> L{};
  std::array<double, mixingDepth> D{}, x{};
  int count = 0;
  for (const double* row = sums + l; count < known_[lane]; row += (count + 2) * lanes, ++count) {
    const int j = count;
    for (int k = 0; k < j; ++k) {
      L[j][k] = row[k * lanes];
      for (int m = 0; m < k; ++m) L[j][k] -= L[j][m] * D[m] * L[k][m];
      L[j][k] /= D[k];
    }
    D[j] = row[j * lanes];
    x[j] = row[(j + 1) * lanes];
    for (int k = 0; k < j; ++k) {
      D[j] -= L[j][k] * L[j][k] * D[k];
      x[j] -= L[j][k] * x[k];
    }
    if (!(D[j] > independent * row[j * lanes])) break;
  }
  for (int j = count - 1; j >= 0; --j) {
    x[j] /= D[j];
    for (int k = j + 1; k < count; ++k) x[j] -= L[k][j] * x[k];
    mix.gamma[j][l] = x[j];
  }
}

void LaneMixing::moveLeading(std::span<const int> rows, const float* directions,
                             const std::array<double, batchLanes>& scale, double* u) {
  begin(scale);
  std::array<Sums, blocks> sums{};
  const auto overRows = [&](const auto& take) {
    for (std::size_t first = 0; first < rows.size(); first += rowsAtOnce) {
      const int count = static_cast<int>(std::min<std::size_t>(rowsAtOnce, rows.size() - first));
      for (int b = 0; b < blocks; ++b) {
        const int* moves = mixes_[b].moves;
        if (std::none_of(moves, moves + lanes, [](int m) { return m != 0; })) continue;
        float* past = leading_.data() + (first * blocks + std::size_t(b)) * leadingPast * lanes;
        take(b, MixedRows{directions + b * lanes, rows.data() + first, count, past, blocks * leadingPast * lanes},
             first);
      }
    }
  };
  overRows([&](int b, const MixedRows& some, std::size_t) { laneKernels().sumMixed(some, mixes_[b], sums[b].data()); });
  for (int lane = 0; lane < batchLanes; ++lane)
    if (known_[lane] > 0 && mixes_[lane / lanes].moves[lane % lanes]) findGamma(lane, sums[lane / lanes].data());
  overRows([&](int b, const MixedRows& some, std::size_t first) {
    laneKernels().stepMixed(some, mixes_[b], u + first * batchLanes + b * lanes);
  });
}

} // namespace palp
