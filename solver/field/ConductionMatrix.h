#pragma once

#include "solver/field/Conductivity.h"
#include "solver/field/FieldMesh.h"
#include "solver/linear/SparseCholesky.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace palp {

/// Matrix of div(k grad) on the deformed mesh with insulated faces: K_ab = integral k grad N_a . grad N_b. The
/// pattern and the order of elimination are found once. Node 0 is held at potential 0, as the field leaves a constant
/// open.
class ConductionMatrix {
public:
  explicit ConductionMatrix(const FieldMesh& mesh);

  /// What a state adds: the pattern's values, the integrals of the shape functions.
  struct Values {
    LaneVector matrix;
    Eigen::VectorXd volumes; ///< integral N_a; their sum is the block's volume
  };
  [[nodiscard]] Values at(const Eigen::Matrix3Xd& nodes_mm, const Conductivity& conductivity, int threads) const;

  [[nodiscard]] const std::shared_ptr<const CholeskyPlan>& plan() const { return plan_; }

private:
  const FieldMesh* mesh_;
  std::vector<int> entries_; ///< [element][55]: where each pair of nodes stands in the values; -1: node 0's
  std::shared_ptr<const CholeskyPlan> plan_;
};

} // namespace palp
