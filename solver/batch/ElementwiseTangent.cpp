#include "solver/batch/ElementwiseTangent.h"

#include <algorithm>
#include <numeric>

namespace palp {

namespace {

/// Values stored as [blocks][size][8], element by element in this order.
LaneVector byElement(const double* values, const std::vector<int>& elements, std::size_t size) {
  LaneVector out(elements.size() * size);
  for (std::size_t place = 0; place < elements.size(); ++place)
    for (std::size_t i = 0; i < size; ++i)
      out[place * size + i] = values[laneIndex(std::size_t(elements[place]), size, i)];
  return out;
}

} // namespace

ElementwiseTangent::ElementwiseTangent(const LinearisedBlock& linearised, const InitialTangent& rest, Order order)
    : mesh_(*linearised.discretisation), rubber_(linearised.assembler.rubber()), factor_(rest.factor),
      geometrySize_(mesh_.kernels().geometrySize),
      eliminationSize_(std::size_t(mesh_.unknowns()) * mesh_.elementDofs()),
      inverseSize_(std::size_t(mesh_.unknowns()) * (mesh_.unknowns() + 1) / 2),
      factorRows_(3 * std::size_t(mesh_.nodes()), paddingRow()), places_(std::size_t(mesh_.elements())) {
  const std::vector<int>& unknowns = rest.factor.plan().tree().order;
  std::vector<int> rowOfUnknown(unknowns.size());
  for (std::size_t row = 0; row < unknowns.size(); ++row) rowOfUnknown[unknowns[row]] = static_cast<int>(row);
  for (std::size_t i = 0; i < factorRows_.size(); ++i)
    if (const int unknown = mesh_.freeIndex(static_cast<int>(i)); unknown >= 0) factorRows_[i] = rowOfUnknown[unknown];
  const std::vector<int> elements = elementsIn(order);
  for (std::size_t place = 0; place < elements.size(); ++place) {
    places_[std::size_t(elements[place])] = static_cast<int>(place);
    const int* nodes = mesh_.elementNodes(elements[place]);
    nodes_.insert(nodes_.end(), nodes, nodes + mesh_.kernels().nodes);
  }
  geometry_ = byElement(mesh_.geometry(0), elements, geometrySize_);
  elimination_ = byElement(rest.tangents.elimination.data(), elements, eliminationSize_);
  localInverse_ = byElement(rest.tangents.localInverse.data(), elements, inverseSize_);
}

std::vector<int> ElementwiseTangent::elementsIn(Order order) const {
  std::vector<int> elements(std::size_t(mesh_.elements()));
  std::iota(elements.begin(), elements.end(), 0);
  if (order == Order::OfMesh) return elements;
  std::vector<int> first(elements.size(), paddingRow()); // row of each element
  for (const int e : elements)
    for (int n = 0; n < mesh_.kernels().nodes; ++n)
      first[std::size_t(e)] = std::min(first[std::size_t(e)], factorRows_[3 * std::size_t(mesh_.node(e, n))]);
  std::stable_sort(elements.begin(), elements.end(),
                   [&](int a, int b) { return first[std::size_t(a)] < first[std::size_t(b)]; });
  return elements;
}

} // namespace palp
