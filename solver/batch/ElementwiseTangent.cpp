#include "solver/batch/ElementwiseTangent.h"

#include <algorithm>

namespace palp {

namespace {

/// Numbers in lanes [blocks][size][8], element by element.
LaneVector byElement(const double* values, int elements, std::size_t size) {
  LaneVector out(elements * size);
  for (int e = 0; e < elements; ++e)
    for (std::size_t i = 0; i < size; ++i) out[e * size + i] = values[laneIndex(e, size, i)];
  return out;
}

} // namespace

ElementwiseTangent::ElementwiseTangent(const HyperelasticProblem::Parts& parts, const InitialTangent& rest)
    : mesh_(*parts.discretisation), rubber_(parts.assembler.rubber()), factor_(rest.factor),
      geometrySize_(mesh_.kernels().geometrySize),
      eliminationSize_(std::size_t(mesh_.unknowns()) * mesh_.elementDofs()),
      inverseSize_(std::size_t(mesh_.unknowns()) * (mesh_.unknowns() + 1) / 2),
      geometry_(byElement(mesh_.geometry(0), mesh_.elements(), geometrySize_)),
      elimination_(byElement(rest.tangents.elimination.data(), mesh_.elements(), eliminationSize_)),
      localInverse_(byElement(rest.tangents.localInverse.data(), mesh_.elements(), inverseSize_)),
      factorRows_(3 * std::size_t(mesh_.nodes()), fillingRow()) {
  const std::vector<int>& order = rest.factor.plan().tree().order;
  std::vector<int> rowOfUnknown(order.size());
  for (std::size_t row = 0; row < order.size(); ++row) rowOfUnknown[order[row]] = static_cast<int>(row);
  for (std::size_t i = 0; i < factorRows_.size(); ++i)
    if (const int unknown = mesh_.freeIndex(static_cast<int>(i)); unknown >= 0) factorRows_[i] = rowOfUnknown[unknown];
}

} // namespace palp
