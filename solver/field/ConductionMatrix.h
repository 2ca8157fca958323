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

/// Potentials of many right sides, each of which sums to 0, for a factorised matrix.
class ConductionSolve {
public:
  /// Outcome other than Done: stopped, or a mesh that is inside out.
  ConductionSolve(std::shared_ptr<const CholeskyPlan> plan, LaneVector matrix, int threads,
                  const std::stop_token& stop);

  [[nodiscard]] SparseCholesky::Outcome outcome() const { return outcome_; }

  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Of 32 sides, [nodes][batchLanes] each.
  struct Sides {
    explicit Sides(int nodes);
    UnsetArray<double> right, first, x;
  };
  /// Of `right` b: first = K^-1 b by substitution in single precision, which leaves up to 3e-4 of it; `right` becomes
  /// b - K first; and x is `first` with what a second substitution makes of that, 1e-7 off. Resistances that differ by
  /// 1e-5 under a load must not scatter by the first's.
  void solve(Sides& sides, const std::stop_token& stop) const;

private:
  /// out = K^-1 b but for node 0, where it is 0.
  void substitute(const UnsetArray<double>& b, UnsetArray<float>& work, UnsetArray<double>& out,
                  const std::stop_token& stop) const;

  std::shared_ptr<const CholeskyPlan> plan_;
  LaneVector matrix_;
  std::vector<int> rowOfUnknown_;
  SparseCholesky factor_;
  SparseCholesky::Outcome outcome_;
};

} // namespace palp
