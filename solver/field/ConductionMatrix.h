#pragma once

#include "solver/field/FieldFunctions.h"
#include "solver/field/FieldMesh.h"
#include "solver/linear/SparseCholesky.h"

#include <Eigen/Core>

#include <memory>
#include <mutex>
#include <vector>

namespace palp {

/// Matrix of div(k grad) on the deformed mesh with insulated faces: K_ab = integral k grad N_a . grad N_b for all
/// functions of FieldFunctions. The pattern and the order of elimination are found once, those for a varying k at
/// their first use. Node 0 is fixed at potential 0, since the field determines the potential up to a constant.
class ConductionMatrix {
public:
  explicit ConductionMatrix(const FieldMesh& mesh);

  /// What a state adds: the pattern's values, the integrals of the shape functions.
  struct Values {
    LaneVector matrix;
    Eigen::VectorXd volumes; ///< integral N_a; their sum is the block's volume
  };
  [[nodiscard]] Values at(const Eigen::Matrix3Xd& nodes_mm, const FieldFunctions& functions, int threads) const;
  /// Of Values::matrix.
  [[nodiscard]] const std::shared_ptr<const CholeskyPlan>& plan(const FieldConductivity& conductivity) const;

private:
  struct Numbering {
    int functions = 0; ///< in each element
    int rows = 0;
    std::vector<int> entries{}; ///< [element][pair]: position of each pair of functions in the values; -1: node 0's
    std::shared_ptr<const CholeskyPlan> plan{};
  };
  [[nodiscard]] Numbering numbering(int functions) const;
  [[nodiscard]] const Numbering& numberingOf(const FieldConductivity& conductivity) const;

  const FieldMesh* mesh_;
  Numbering uniform_;
  mutable std::once_flag heterogeneousFound_;
  mutable Numbering heterogeneous_;
};

} // namespace palp
