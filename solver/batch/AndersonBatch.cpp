#include "solver/batch/AndersonBatch.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int rowsAtOnce = 128;                   // rows of a pass, which stay in the cache for the next block
constexpr double independent = 1e-8;              // smallest relative difference between independent changes
using Sums = std::array<double, mixSums * lanes>; // [mixSums][8]

} // namespace

AndersonBatch::AndersonBatch(std::size_t leading, std::size_t following, int count)
    : count_(count), leading_(leading * batchColumns * leadingPast),
      following_(following * batchColumns * followingPast) {}

void AndersonBatch::begin(int column, bool mixed) {
  mixed_[column] = mixed;
  restarts_[column] = hasLast_[column] = false;
  motions_[column] = 0;
}

void AndersonBatch::copy(int from, int to) {
  mixed_[to] = mixed_[from];
  restarts_[to] = restarts_[from];
  hasLast_[to] = hasLast_[from];
  motions_[to] = motions_[from];
  copyColumn(leading_.data(), leading_.size(), leadingPast, from, to);
  copyColumn(following_.data(), following_.size(), count_ * followingPast, from, to);
}

/// Starts an iteration: the following unknowns of the last one have been mixed.
void AndersonBatch::begin(const std::array<double, batchColumns>& scale) {
  for (int column = 0; column < batchColumns; ++column) {
    const bool moves = scale[column] > 0;
    LaneMix& mix = mixes_[column / lanes];
    const int l = column % lanes;
    mix.moves[l] = moves ? -1 : 0;
    mix.scale[l] = scale[column];
    if (restarts_[column] || (mixed_[column] && !moves)) motions_[column] = 0;
    const bool pair = mixed_[column] && moves && hasLast_[column] && !restarts_[column];
    if (pair) motions_[column] = std::min(motions_[column] + 1, mixingDepth);
    mix.pair[l] = pair ? -1 : 0;
    for (int j = 0; j < mixingDepth; ++j) {
      mix.hasMotion[j][l] = mixed_[column] && moves && j < motions_[column] ? -1 : 0;
      mix.gamma[j][l] = 0;
    }
    hasLast_[column] = mixed_[column] && moves;
    restarts_[column] = false;
  }
}

/// Normal equations of the least squares, by L D L^T with the newest change first, as far as the changes are
/// independent.
void AndersonBatch::findGamma(int column, const double* sums) {
  LaneMix& mix = mixes_[column / lanes];
  const int l = column % lanes;
  std::array<std::array<double, mixingDepth>, mixingDepth> L{};
  std::array<double, mixingDepth> D{}, x{};
  int count = 0;
  for (const double* row = sums + l; count < motions_[column]; row += (count + 2) * lanes, ++count) {
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

void AndersonBatch::moveLeading(std::span<const int> rows, const float* directions,
                                const std::array<double, batchColumns>& scale, double* u) {
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
  for (int column = 0; column < batchColumns; ++column)
    if (motions_[column] > 0 && mixes_[column / lanes].moves[column % lanes])
      findGamma(column, sums[column / lanes].data());
  overRows([&](int b, const MixedRows& some, std::size_t first) {
    laneKernels().stepMixed(some, mixes_[b], u + first * batchColumns + b * lanes);
  });
}

} // namespace palp
