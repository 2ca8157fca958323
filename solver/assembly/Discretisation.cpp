#include "solver/assembly/Discretisation.h"

#include "solver/element/ElementGeometry.h"

namespace palp {

FixedComponents clampedBottom(const Mesh& mesh) {
  FixedComponents fixed;
  for (const bool clamped : clampedNodes(mesh)) fixed.insert(fixed.end(), 3, clamped);
  return fixed;
}

Discretisation::Discretisation(const Mesh& mesh, const FixedComponents& fixed)
    : kernels_(&elementKernels(mesh.shape)), nodes_(mesh.nodeCount()), elements_(mesh.elementCount()),
      positions_mm_(mesh.nodes_mm), freeIndex_(fixed.size(), -1),
      elementNodes_(mesh.elements.data(), mesh.elements.data() + mesh.elements.size()),
      geometry_(std::size_t(blocks()) * kernels_->geometrySize * lanes) {
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (!fixed[i]) freeIndex_[i] = dof_++;
  for (int b = 0; b < blocks(); ++b)
    for (int lane = 0; lane < lanes; ++lane)
      elementGeometry(mesh, elementInLane(b, lane),
                      geometry_.data() + std::size_t(b) * kernels_->geometrySize * lanes + lane, lanes);
}

double Discretisation::volume(int element) const {
  const auto number = [&](int item) { return geometry_[laneIndex(element, kernels_->geometrySize, item)]; };
  if (kernels_->nodes == TetLayout::nodes) return number(TetLayout::volume);
  double sum = 0;
  for (int q = 0; q < HexLayout::points; ++q) sum += number(HexLayout::pointSize * q + HexLayout::weight);
  return sum;
}

void Discretisation::gather(int block, const Eigen::VectorXd& values, double* out) const {
  for (int lane = 0; lane < lanes; ++lane) {
    const int element = elementInLane(block, lane);
    for (int n = 0; n < kernels_->nodes; ++n) {
      const double* v = values.data() + 3 * std::size_t(node(element, n));
      for (int d = 0; d < 3; ++d) out[lanes * (3 * n + d) + lane] = v[d];
    }
  }
}

ElementState Discretisation::atRest() const {
  return {Eigen::VectorXd::Zero(3 * Eigen::Index(nodes_)), LaneVector(std::size_t(blocks()) * unknowns() * lanes)};
}

void Discretisation::addFree(const Eigen::VectorXd& free, double factor, Eigen::VectorXd& all) const {
  for (Eigen::Index i = 0; i < all.size(); ++i)
    if (freeIndex_[i] >= 0) all(i) += factor * free(freeIndex_[i]);
}

Eigen::VectorXd Discretisation::freePart(const Eigen::VectorXd& all) const {
  Eigen::VectorXd free(dof_);
  for (Eigen::Index i = 0; i < all.size(); ++i)
    if (freeIndex_[i] >= 0) free(freeIndex_[i]) = all(i);
  return free;
}

Eigen::VectorXd Discretisation::withZeros(const Eigen::VectorXd& free) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * Eigen::Index(nodes_));
  addFree(free, 1, all);
  return all;
}

} // namespace palp
