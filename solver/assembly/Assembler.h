#pragma once

#include "model/Material.h"
#include "solver/assembly/Discretisation.h"
#include "solver/linear/SparseCholesky.h"

#include <memory>
#include <stop_token>

namespace palp {

/// The kernels' constants. At nu = 0.5 the constant pressure of an element has no stiffness of its own; the tangent,
/// and only it, then takes kappa = 1e6 mu, which costs Newton's method a millionth of its convergence.
RubberConstants rubberConstants(const Material& material);

/// Forces and local residuals of one state, condensed with some elimination.
struct ElementForces {
  LaneVector forces; ///< [blocks][3 nodes][8]
  LaneVector local;  ///< [blocks][unknowns][8]
  LaneVector raw;    ///< the forces before condensation
  double smallestJ = 1, largestJ = 1;
};

/// The elements' tangents with their own unknowns eliminated. A modified Newton iteration condenses later residuals
/// with the elimination of the tangent that was factorised.
struct ElementTangents {
  UnsetArray<double> stiffness;    ///< [elements][d (d + 1) / 2]
  UnsetArray<double> elimination;  ///< [blocks][unknowns d][8]
  UnsetArray<double> localInverse; ///< [blocks][unknowns (unknowns + 1) / 2][8]
};

/// Sums the elements into global forces and the tangent, whose pattern it finds once. Every sum goes over the elements
/// around a node in their order, so that the bytes do not depend on threads.
class Assembler {
public:
  Assembler(std::shared_ptr<const Discretisation> mesh, const RubberConstants& rubber);

  [[nodiscard]] const Discretisation& discretisation() const { return *mesh_; }
  [[nodiscard]] const RubberConstants& rubber() const { return rubber_; }
  [[nodiscard]] const std::shared_ptr<const SparsePattern>& pattern() const { return pattern_; }
  /// The pattern's group of a node; -1: all its components are prescribed.
  [[nodiscard]] int group(int node) const { return groupOfNode_[node]; }

  /// Tangents of the state, and its forces condensed with them.
  void tangent(const ElementState& state, ElementTangents& tangents, ElementForces& forces, int threads,
               const std::stop_token& stop) const;
  /// Forces of the state, condensed with the elimination given.
  void residual(const ElementState& state, const ElementTangents& tangents, ElementForces& forces, int threads) const;

  /// Values of the pattern's entries.
  [[nodiscard]] LaneVector matrix(const ElementTangents& tangents, int threads) const;
  /// Condensed or raw internal forces on all components; on the prescribed ones they are the reactions.
  [[nodiscard]] Eigen::VectorXd sum(const LaneVector& forces, int threads) const;
  /// Norm of the elements' own residuals as forces: the bubbles', and mu / h times the volumes'.
  [[nodiscard]] double localNorm(const ElementForces& forces) const;
  /// Element stiffness times a displacement of all components.
  [[nodiscard]] Eigen::VectorXd stiffnessTimes(const ElementTangents& tangents, const Eigen::VectorXd& du) const;
  /// Change of the elements' unknowns that goes with a change of the displacements.
  [[nodiscard]] LaneVector recover(const ElementTangents& tangents, const ElementForces& forces,
                                   const Eigen::VectorXd& du, int threads) const;

private:
  void findNeighbours();
  void findPattern();
  template <class Kernel>
  void overBlocks(ElementForces& forces, int threads, const std::stop_token& stop, Kernel kernel) const;
  void addNodeColumns(const ElementTangents& tangents, int group, LaneVector& values) const;

  std::shared_ptr<const Discretisation> mesh_;
  RubberConstants rubber_;
  std::vector<double> volumeForce_; ///< mu / h of each element [N / mm3]
  std::vector<int> groupOfNode_;    ///< -1: all components prescribed
  std::vector<int> nodeOfGroup_;
  std::vector<int> aroundStart_; ///< of each node in around_
  std::vector<int> around_;      ///< element * nodes + local node, elements ascending
  std::vector<int> rowOffset_;   ///< [element][nodes][nodes]: position of the row group in the column of the node
  std::shared_ptr<const SparsePattern> pattern_;
};

} // namespace palp
