#pragma once

#include "solver/statics/LinearisedBlock.h"

namespace palp {

/// The tangent at rest laid out for many loads: the data of one element are contiguous, whereas the assembler
/// interleaves those of eight elements.
class ElementwiseTangent {
public:
  /// Order of the elements: the mesh's, or that of their first rows in the factor, in which successive elements are
  /// neighbours in the block, so that their nodes' values are still in the cache.
  enum class Order { OfMesh, OfFactor };

  /// Refers to both, which must outlive it.
  ElementwiseTangent(const LinearisedBlock& linearised, const InitialTangent& rest, Order order = Order::OfMesh);

  [[nodiscard]] const Discretisation& mesh() const { return mesh_; }
  [[nodiscard]] const RubberConstants& rubber() const { return rubber_; }
  /// Place of an element of the mesh in that order.
  [[nodiscard]] int placeOf(int element) const { return places_[std::size_t(element)]; }
  /// Data of the element at a place.
  [[nodiscard]] const int* nodes(int place) const { return nodes_.data() + std::size_t(place) * mesh_.kernels().nodes; }
  [[nodiscard]] const double* geometry(int place) const { return item(geometry_, place, geometrySize_); }
  [[nodiscard]] const double* elimination(int place) const { return item(elimination_, place, eliminationSize_); }
  [[nodiscard]] const double* localInverse(int place) const { return item(localInverse_, place, inverseSize_); }
  /// Row of the factor of each component (3 node + direction); the padding row where it is prescribed.
  [[nodiscard]] const std::vector<int>& factorRows() const { return factorRows_; }
  /// Rows of a right-hand side: one per free component, and the padding row of zeros at the end.
  [[nodiscard]] int rightSideRows() const { return mesh_.dof() + 1; }
  [[nodiscard]] int paddingRow() const { return mesh_.dof(); }
  [[nodiscard]] const SupernodeTree& tree() const { return factor_.plan().tree(); }
  [[nodiscard]] BlockedFactor factor() const { return factor_.blocks(); }

private:
  static const double* item(const LaneVector& values, int place, std::size_t size) {
    return values.data() + place * size;
  }
  [[nodiscard]] std::vector<int> elementsIn(Order order) const;

  const Discretisation& mesh_;
  RubberConstants rubber_;
  const SparseCholesky& factor_;
  std::size_t geometrySize_, eliminationSize_, inverseSize_;
  std::vector<int> factorRows_;
  std::vector<int> places_, nodes_;
  LaneVector geometry_, elimination_, localInverse_; // read sequentially: on huge pages
};

} // namespace palp
