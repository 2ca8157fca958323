#include "solver/RestModel.h"

#include "solver/Parallel.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int supernodesAChunk = 8;

/// Numbers in lanes [blocks][size][8], element by element.
std::vector<double> byElement(const double* values, int elements, std::size_t size) {
  std::vector<double> out(elements * size);
  for (int e = 0; e < elements; ++e)
    for (std::size_t i = 0; i < size; ++i) out[e * size + i] = values[(e / lanes * size + i) * lanes + e % lanes];
  return out;
}

} // namespace

RestModel::RestModel(const HyperelasticProblem::Parts& parts, const RestTangent& rest, int threads,
                     const std::stop_token& stop)
    : mesh_(*parts.discretisation), rubber_(parts.assembler.rubber()), geometrySize_(mesh_.kernels().geometrySize),
      eliminationSize_(std::size_t(mesh_.unknowns()) * mesh_.elementDofs()),
      inverseSize_(std::size_t(mesh_.unknowns()) * (mesh_.unknowns() + 1) / 2),
      geometry_(byElement(mesh_.geometry(0), mesh_.elements(), geometrySize_)),
      elimination_(byElement(rest.tangents.elimination.data(), mesh_.elements(), eliminationSize_)),
      localInverse_(byElement(rest.tangents.localInverse.data(), mesh_.elements(), inverseSize_)),
      places_(3 * std::size_t(mesh_.nodes()), -1) {
  const std::vector<int>& order = rest.factor.plan().tree().order;
  std::vector<int> placeOfUnknown(order.size());
  for (std::size_t p = 0; p < order.size(); ++p) placeOfUnknown[order[p]] = static_cast<int>(p);
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (const int unknown = mesh_.freeIndex(static_cast<int>(i)); unknown >= 0) places_[i] = placeOfUnknown[unknown];
  const SupernodeTree& tree = rest.factor.plan().tree();
  placeFactor(tree);
  forChunks(tree.count(), supernodesAChunk, threads, [&](int begin, int end) {
    for (int node = begin; node < end && !stop.stop_requested(); ++node) packSupernode(rest.factor, node);
  });
}

void RestModel::placeFactor(const SupernodeTree& tree) {
  constexpr int R = laneFactorRows;
  first_ = tree.first;
  start_ = {0};
  blockStart_ = {0};
  for (int s = 0; s < tree.count(); ++s) {
    const int width = tree.width(s), height = tree.height(s);
    std::size_t numbers = 0;
    for (int r0 = 0; r0 < width; r0 += R) numbers += std::size_t(r0 + R) * R;
    for (int r0 = width; r0 < height; r0 += R) {
      numbers += std::size_t(width) * R;
      for (int r = 0; r < R; ++r) rows_.push_back(r0 + r < height ? tree.rowsOf(s)[r0 + r] : tree.size());
    }
    start_.push_back(start_.back() + numbers);
    blockStart_.push_back(static_cast<int>(rows_.size()) / R);
  }
  values_.resize(start_.back());
}

void RestModel::packSupernode(const SparseCholesky& cholesky, int s) {
  constexpr int R = laneFactorRows;
  const SupernodeTree& tree = cholesky.plan().tree();
  const int width = tree.width(s), height = tree.height(s);
  const double* panel = cholesky.panels().data() + tree.panelStart[s];
  float* out = values_.data() + start_[s];
  for (int r0 = 0; r0 < width; r0 += R)
    for (int k = 0; k < r0 + R; ++k)
      for (int r = 0; r < R; ++r) {
        const bool inside = r0 + r < width && k <= r0 + r && k < width;
        const double value = inside ? panel[std::size_t(k) * height + r0 + r] : 0;
        *out++ = static_cast<float>(inside && k == r0 + r ? 1 / value : value);
      }
  for (int r0 = width; r0 < height; r0 += R)
    for (int k = 0; k < width; ++k)
      for (int r = 0; r < R; ++r)
        *out++ = r0 + r < height ? static_cast<float>(panel[std::size_t(k) * height + r0 + r]) : 0.F;
}

LaneFactor RestModel::factor() const {
  return {static_cast<int>(first_.size()) - 1,
          first_.data(),
          start_.data(),
          blockStart_.data(),
          rows_.data(),
          values_.data()};
}

} // namespace palp
