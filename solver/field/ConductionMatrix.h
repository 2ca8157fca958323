#pragma once

#include "solver/field/Conductivity.h"
#include "solver/field/FieldMesh.h"
#include "solver/linear/SparseCholesky.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <stop_token>
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

/// Potentials of many right sides (nodes x sides, by rows), each of which sums to 0, for a factorised matrix.
class ConductionSolve {
public:
  /// Outcome other than Done: stopped, or a mesh that is inside out.
  ConductionSolve(std::shared_ptr<const CholeskyPlan> plan, LaneVector matrix, int threads,
                  const std::stop_token& stop);

  [[nodiscard]] SparseCholesky::Outcome outcome() const { return outcome_; }

  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// x = K^-1 b of up to 32 sides, `left` = b - K x. By substitution in single precision, which leaves up to 3e-4 of x,
  /// and once more for what that has left: resistances that differ by 1e-5 under a load must not scatter by its
  /// square.
  void solve(const Eigen::Ref<const Rows>& b, Eigen::Ref<Rows> x, Eigen::Ref<Rows> left,
             const std::stop_token& stop) const;

private:
  void substitute(const Eigen::Ref<const Rows>& b, std::vector<float, CacheLineAllocator<float>>& work,
                  Eigen::Ref<Rows> x, const std::stop_token& stop) const;
  void subtractProduct(const Eigen::Ref<const Rows>& x, Eigen::Ref<Rows> from) const;
  template <int Sides> void subtractProductOf(const Eigen::Ref<const Rows>& x, Eigen::Ref<Rows> from) const;

  std::shared_ptr<const CholeskyPlan> plan_;
  LaneVector matrix_;
  std::vector<int> rowOfUnknown_;
  SparseCholesky factor_;
  SparseCholesky::Outcome outcome_;
};

} // namespace palp
