#pragma once

#include "solver/Discretisation.h"
#include "solver/SparseCholesky.h"

#include <memory>
#include <stop_token>

namespace palp {

/// What the assembly leaves of one state. Forces are condensed with the elimination that stands beside them, so that a
/// modified Newton uses that of the tangent it factorised.
struct ElementArrays {
  LaneVector forces;       ///< [blocks][3 nodes][8]
  LaneVector local;        ///< [blocks][unknowns][8]
  LaneVector stiffness;    ///< [elements][d (d + 1) / 2]
  LaneVector elimination;  ///< [blocks][unknowns d][8]
  LaneVector localInverse; ///< [blocks][unknowns (unknowns + 1) / 2][8]
  double smallestJ = 1, largestJ = 1;
};

/// Sums the elements into global forces and the tangent, whose pattern it finds once. Every sum goes over the elements
/// around a node in their order, so that the bytes do not depend on threads.
class Assembler {
public:
  Assembler(std::shared_ptr<const Discretisation> mesh, const RubberConstants& rubber);

  [[nodiscard]] const Discretisation& discretisation() const { return *mesh_; }
  [[nodiscard]] const RubberConstants& rubber() const { return rubber_; }
  [[nodiscard]] const std::shared_ptr<const SparsePattern>& pattern() const { return pattern_; }

  /// Forces, elimination and element stiffness of the state.
  void tangent(const ElementState& state, ElementArrays& arrays, int threads, std::stop_token stop) const;
  /// Forces alone, condensed with the elimination that the arrays hold.
  void residual(const ElementState& state, ElementArrays& arrays, int threads) const;

  /// Values of the pattern's entries.
  [[nodiscard]] std::vector<double> matrix(const ElementArrays& arrays, int threads) const;
  /// Internal forces on all components; on the prescribed ones they are the reactions.
  [[nodiscard]] Eigen::VectorXd forces(const ElementArrays& arrays, int threads) const;
  /// Element stiffness times a displacement of all components.
  [[nodiscard]] Eigen::VectorXd stiffnessTimes(const ElementArrays& arrays, const Eigen::VectorXd& du) const;
  /// Change of the elements' unknowns that goes with a change of the displacements.
  [[nodiscard]] LaneVector recover(const ElementArrays& arrays, const Eigen::VectorXd& du, int threads) const;

private:
  void findNeighbours();
  void findPattern();
  void resize(ElementArrays& arrays, bool withTangent) const;
  template <class Kernel>
  void overBlocks(ElementArrays& arrays, int threads, std::stop_token stop, Kernel kernel) const;
  void addNodeColumns(const ElementArrays& arrays, int group, std::vector<double>& values) const;

  std::shared_ptr<const Discretisation> mesh_;
  RubberConstants rubber_;
  std::vector<int> groupOfNode_; ///< -1: all components prescribed
  std::vector<int> nodeOfGroup_;
  std::vector<int> aroundStart_; ///< of each node in around_
  std::vector<int> around_;      ///< element * nodes + local node, elements ascending
  std::vector<int> rowOffset_;   ///< [element][nodes][nodes]: where the row group stands in the column of the node
  std::shared_ptr<const SparsePattern> pattern_;
};

} // namespace palp
