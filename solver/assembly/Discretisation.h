#pragma once

#include "model/Mesh.h"
#include "solver/element/ElementKernels.h"
#include "solver/element/LaneVector.h"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace palp {

/// Which displacement components of the nodes are prescribed: entry 3 node + direction.
using FixedComponents = std::vector<bool>;

/// All components of the nodes of the bottom face z = 0.
FixedComponents clampedBottom(const Mesh& mesh);

/// A state of the block: displacements of all nodes (3 node + direction) and the elements' own unknowns
/// [blocks][unknowns][8].
struct ElementState {
  Eigen::VectorXd displacements;
  LaneVector unknowns;
};

/// Elements in blocks of 8 lanes with their geometry, and the numbering of the free displacement components. The last
/// block is filled up with copies of the last element, whose results are not read.
class Discretisation {
public:
  /// Throws DesignError where an element is inside out.
  Discretisation(const Mesh& mesh, const FixedComponents& fixed);

  [[nodiscard]] const ElementKernels& kernels() const { return *kernels_; }
  [[nodiscard]] int nodes() const { return nodes_; }
  [[nodiscard]] int elements() const { return elements_; }
  [[nodiscard]] int blocks() const { return (elements_ + lanes - 1) / lanes; }
  [[nodiscard]] int dof() const { return dof_; }
  [[nodiscard]] int elementDofs() const { return 3 * kernels_->nodes; }
  [[nodiscard]] int unknowns() const { return kernels_->unknowns; }
  /// Number among the free components, -1 where prescribed.
  [[nodiscard]] int freeIndex(int component) const { return freeIndex_[component]; }
  [[nodiscard]] const Eigen::Matrix3Xd& positions_mm() const { return positions_mm_; } ///< of the nodes, at rest
  [[nodiscard]] const int* elementNodes(int element) const { return elementNodes_.data() + element * kernels_->nodes; }
  [[nodiscard]] int node(int element, int n) const { return elementNodes(element)[n]; }
  /// [geometrySize][8]
  [[nodiscard]] const double* geometry(int block) const {
    return geometry_.data() + std::size_t(block) * kernels_->geometrySize * lanes;
  }
  [[nodiscard]] int elementInLane(int block, int lane) const { return std::min(block * lanes + lane, elements_ - 1); }

  [[nodiscard]] double volume(int element) const;

  /// Values of all components at the nodes of a block, [3 nodes][8].
  void gather(int block, const Eigen::VectorXd& values, double* out) const;
  [[nodiscard]] ElementState atRest() const;
  /// Adds the values of the free components to those of all components.
  void addFree(const Eigen::VectorXd& free, double factor, Eigen::VectorXd& all) const;
  [[nodiscard]] Eigen::VectorXd freePart(const Eigen::VectorXd& all) const;
  [[nodiscard]] Eigen::VectorXd withZeros(const Eigen::VectorXd& free) const;

private:
  const ElementKernels* kernels_;
  int nodes_ = 0, elements_ = 0, dof_ = 0;
  Eigen::Matrix3Xd positions_mm_;
  std::vector<int> freeIndex_;
  std::vector<int> elementNodes_;
  LaneVector geometry_;
};

} // namespace palp
