#pragma once

#include "solver/element/LaneKernels.h"
#include "solver/element/LaneVector.h"
#include "solver/linear/Front.h"
#include "solver/linear/SupernodeTree.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace palp {

/// The symbolic factorisation of a pattern, computed once: positions of the entries in the panels, and the tasks. The
/// tasks do not depend on the number of threads.
class CholeskyPlan {
public:
  explicit CholeskyPlan(std::shared_ptr<const SparsePattern> pattern);

  [[nodiscard]] const SparsePattern& pattern() const { return *pattern_; }
  [[nodiscard]] const SupernodeTree& tree() const { return tree_; }
  /// Adds the matrix, given by the values of the pattern's entries, to a supernode's panel.
  void addMatrix(int s, std::span<const double> values, double* panel) const;
  [[nodiscard]] const std::vector<int>& children(int s) const { return children_[s]; }
  /// Supernodes of each subtree, the largest first.
  [[nodiscard]] const std::vector<std::vector<int>>& subtrees() const { return subtrees_; }
  /// Supernodes above the subtrees.
  [[nodiscard]] const std::vector<int>& top() const { return top_; }
  /// Where the factor's numbers go, and how many they are.
  [[nodiscard]] BlockedFactor blocks(const float* values) const;
  [[nodiscard]] std::size_t factorSize() const { return blocksStart_.back(); }
  /// The factor's row of each unknown.
  [[nodiscard]] const std::vector<int>& rowOf() const { return rowOf_; }
  /// Unknowns of the pattern's last groups: the last rows of the factor.
  [[nodiscard]] int lastUnknowns() const { return lastUnknowns_; }

private:
  /// The entries of one group of the pattern's rows in one group of its columns: up to 3 x 3 numbers, found as one.
  struct EntryBlock {
    int columns, rows; ///< groups
    int value;         ///< of the first column and row, in the pattern's values
    int position;      ///< of the same in the supernode's panel
    bool transposed;   ///< the rows' unknowns come first in the factor
  };
  void placeBlocks();
  void findEntries();
  void cutTree();
  void findLast();

  std::shared_ptr<const SparsePattern> pattern_;
  SupernodeTree tree_;
  std::vector<int> rowOf_;
  std::vector<std::size_t> entryStart_; ///< of each supernode in entries_
  std::vector<EntryBlock> entries_;
  std::vector<std::vector<int>> children_;
  std::vector<std::vector<int>> subtrees_;
  std::vector<int> top_;
  std::vector<std::size_t> blocksStart_; ///< of each supernode in the factor's numbers, and their count
  int lastUnknowns_ = 0;
  std::vector<int> blockBelow_; ///< first block of the rows below each supernode
  std::vector<int> blockRows_;  ///< rows of the factor in those blocks
};

/// Right-hand sides that are solved together, one per column: [held + unknowns][batchColumns] each, of which the first
/// `held` rows are fixed at 0 and have no unknown.
struct LaneSides {
  explicit LaneSides(int unknowns, int held = 0);
  using Lanes = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, batchColumns, Eigen::RowMajor>>;
  [[nodiscard]] Lanes lanes(UnsetArray<double>& of) const { return {of.data(), held + unknowns, batchColumns}; }

  int unknowns, held;
  UnsetArray<double> right, first, x;
};

/// Multifrontal Cholesky factorisation on OpenBLAS (Duff and Reid 1983): subtrees in parallel, then the large fronts
/// at the top tile by tile. Fronts are factorised in double precision (except for the products of large ones, if single
/// is requested) and stored in single, in half the memory. The bytes do not depend on the number of threads; a stop
/// request is honoured between tasks.
///
/// Why not CHOLMOD, whose symbolic analysis it uses (SupernodeTree.cpp): half the memory, the same bytes on any number
/// of threads, stop requests, the exact Schur complement of the last groups (contact), and a single-precision factor
/// through which 32 right-hand sides pass together (LaneSolve.h). Order of work: CholeskyPlan (once per pattern),
/// factorise (per matrix), solve. Where to read more: resources/docs/numerics/factorisation.md.
class SparseCholesky {
public:
  explicit SparseCholesky(std::shared_ptr<const CholeskyPlan> plan);

  enum class Outcome { Done, NotPositiveDefinite, Stopped };
  /// `values` are those of the pattern's entries. UpdatePrecision::Single is for factors that only precondition an
  /// iteration.
  [[nodiscard]] Outcome factorise(LaneVector values, int threads, const std::stop_token& stop,
                                  UpdatePrecision products = UpdatePrecision::Double);
  /// Solves in place with one step of iterative refinement: the factor alone leaves a residual of 1e-3 of the
  /// right-hand side, at nu = 0.5 of a tenth; refinement removes almost all of it. If cancelled, there is no solution.
  void solve(Eigen::VectorXd& rightSide, const std::stop_token& stop = {}) const;
  /// With `right` b: first = K^-1 b by substitution in single precision, with a residual of up to 3e-4 of b; `right`
  /// becomes that residual b - K first; x is `first` plus the substitution of it, with a residual of 1e-6 of b at
  /// nu = 0.5, less otherwise. If cancelled, there is no solution.
  void solve(LaneSides& sides, const std::stop_token& stop) const;
  /// Returns the forces on the unknowns of the pattern's last groups, in the groups' order, at their motion under the
  /// right-hand side alone.
  using Answer = std::function<Eigen::VectorXd(const Eigen::VectorXd& motion)>;
  /// Solves in place with such forces, added between the forward and the backward sweep: all other unknowns are
  /// eliminated first, so that they cost no further substitution.
  void solve(Eigen::VectorXd& rightSide, const Answer& answer, const std::stop_token& stop = {}) const;

  /// The inverse matrix between the unknowns of the pattern's last groups, in the groups' order, in double precision:
  /// of the factor's last rows L, all other unknowns being eliminated, (L L^T)^-1. Empty if cancelled.
  [[nodiscard]] Eigen::MatrixXd inverseOfLast(const std::stop_token& stop = {}) const;

  /// Releases the matrix and the last rows in double precision: the factor still substitutes (blocks), but `solve`
  /// fails.
  void keepFactorAlone() {
    matrix_ = {};
    lastRows_ = {};
  }

  [[nodiscard]] const CholeskyPlan& plan() const { return *plan_; }
  [[nodiscard]] std::size_t bytes() const { return factor_.size() * sizeof(float); } ///< of the factor's numbers
  [[nodiscard]] BlockedFactor blocks() const { return plan_->blocks(factor_.data()); }

private:
  void substitute(const double* b, UnsetArray<float>& work, double* x, const std::stop_token& stop) const;
  void substitute(Eigen::VectorXd& x, const std::stop_token& stop,
                  const std::function<void(Eigen::Ref<Eigen::VectorXd>)>& onLast = {}) const;
  /// Which of the factor's last rows each unknown of the last groups has, in the groups' order.
  [[nodiscard]] std::vector<int> rowsOfLast() const;
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& x) const;

  std::shared_ptr<const CholeskyPlan> plan_;
  LaneVector matrix_;
  UnsetArray<float> factor_;
  Eigen::MatrixXd lastRows_; ///< of the factor: unknowns of the last groups, lower triangle
};

} // namespace palp
