#pragma once

#include "solver/statics/ProblemParts.h"

namespace palp {

/// The tangent at rest laid out for many loads at once: the numbers of one element stand together, where the assembler
/// has those of eight elements side by side.
class ElementwiseTangent {
public:
  /// The order in which the elements stand: the mesh's, or that of their first rows in the factor, whose neighbours are
  /// neighbours in the block, so that their nodes' numbers are still in the cache.
  enum class Order { OfMesh, OfFactor };

  /// Refers to both, which must outlive it.
  ElementwiseTangent(const HyperelasticProblem::Parts& parts, const InitialTangent& rest, Order order = Order::OfMesh);

  [[nodiscard]] const Discretisation& mesh() const { return mesh_; }
  [[nodiscard]] const RubberConstants& rubber() const { return rubber_; }
  /// Where an element of the mesh stands in that order.
  [[nodiscard]] int placeOf(int element) const { return places_[std::size_t(element)]; }
  /// Of the element at a place.
  [[nodiscard]] const int* nodes(int place) const { return nodes_.data() + std::size_t(place) * mesh_.kernels().nodes; }
  [[nodiscard]] const double* geometry(int place) const { return item(geometry_, place, geometrySize_); }
  [[nodiscard]] const double* elimination(int place) const { return item(elimination_, place, eliminationSize_); }
  [[nodiscard]] const double* localInverse(int place) const { return item(localInverse_, place, inverseSize_); }
  /// Row of the factor of each component (3 node + direction); the filling row where it is prescribed.
  [[nodiscard]] const std::vector<int>& factorRows() const { return factorRows_; }
  /// Rows that a right side needs: one a free component, and the last that fills up the factor's blocks, of zeros.
  [[nodiscard]] int rightSideRows() const { return mesh_.dof() + 1; }
  [[nodiscard]] int fillingRow() const { return mesh_.dof(); }
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
  LaneVector geometry_, elimination_, localInverse_; // read from end to end: on huge pages
};

} // namespace palp
