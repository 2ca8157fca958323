#pragma once

#include "solver/statics/ProblemParts.h"

namespace palp {

/// The tangent at rest laid out for many loads at once: the numbers of one element stand together, where the assembler
/// has those of eight elements side by side.
class ElementwiseTangent {
public:
  /// Refers to both, which must outlive it.
  ElementwiseTangent(const HyperelasticProblem::Parts& parts, const InitialTangent& rest);

  [[nodiscard]] const Discretisation& mesh() const { return mesh_; }
  [[nodiscard]] const RubberConstants& rubber() const { return rubber_; }
  [[nodiscard]] const double* geometry(int element) const { return item(geometry_, element, geometrySize_); }
  [[nodiscard]] const double* elimination(int element) const { return item(elimination_, element, eliminationSize_); }
  [[nodiscard]] const double* localInverse(int element) const { return item(localInverse_, element, inverseSize_); }
  /// Row of the factor of each component (3 node + direction); the filling row where it is prescribed.
  [[nodiscard]] const std::vector<int>& factorRows() const { return factorRows_; }
  /// Rows that a right side needs: one a free component, and the last that fills up the factor's blocks, of zeros.
  [[nodiscard]] int rightSideRows() const { return mesh_.dof() + 1; }
  [[nodiscard]] int fillingRow() const { return mesh_.dof(); }
  [[nodiscard]] const SupernodeTree& tree() const { return factor_.plan().tree(); }
  [[nodiscard]] BlockedFactor factor() const { return factor_.blocks(); }

private:
  static const double* item(const LaneVector& values, int element, std::size_t size) {
    return values.data() + element * size;
  }

  const Discretisation& mesh_;
  RubberConstants rubber_;
  const SparseCholesky& factor_;
  std::size_t geometrySize_, eliminationSize_, inverseSize_;
  LaneVector geometry_, elimination_, localInverse_; // read from end to end: on huge pages
  std::vector<int> factorRows_;
};

} // namespace palp
