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

/// What a factorisation needs to know of a pattern, found once: where the entries go and how the work is cut into
/// tasks. The cut does not depend on the number of threads.
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

/// Right sides that are solved together, one a lane: [held + unknowns][batchLanes] each, of which the first rows are
/// held at 0 and have no unknown.
struct LaneSides {
  explicit LaneSides(int unknowns, int held = 0);
  using Lanes = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, batchLanes, Eigen::RowMajor>>;
  [[nodiscard]] Lanes lanes(UnsetArray<double>& of) const { return {of.data(), held + unknowns, batchLanes}; }

  int unknowns, held;
  UnsetArray<double> right, first, x;
};

/// Multifrontal Cholesky factorisation on OpenBLAS (Duff and Reid 1983): subtrees in parallel, then the large fronts
/// at the top tile by tile. Fronts are factorised in double precision (but for the products of large ones, where single
/// is asked for) and kept in single, in half the memory. The bytes do not depend on the number of threads; a stop
/// request is honoured between tasks.
class SparseCholesky {
public:
  explicit SparseCholesky(std::shared_ptr<const CholeskyPlan> plan);

  enum class Outcome { Done, NotPositiveDefinite, Stopped };
  /// `values` are those of the pattern's entries. Products::Single is for factors that lead an iteration alone.
  [[nodiscard]] Outcome factorise(LaneVector values, int threads, const std::stop_token& stop,
                                  Products products = Products::Double);
  /// Solves in place, refined once: the factor alone leaves 1e-3 of the right side, at nu = 0.5 a tenth, but next to
  /// nothing of what it has left. Stopped, it leaves no solution.
  void solve(Eigen::VectorXd& rightSide, const std::stop_token& stop = {}) const;
  /// Of `right` b: first = K^-1 b by substitution in single precision, which leaves up to 3e-4 of it; `right` becomes
  /// b - K first; and x is `first` with what a second substitution makes of that: 1e-6 of b is left at nu = 0.5, less
  /// else. Stopped, it leaves no solution.
  void solve(LaneSides& sides, const std::stop_token& stop) const;
  /// Forces on the unknowns of the pattern's last groups, in the groups' order, by how these move under the right side
  /// alone.
  using Answer = std::function<Eigen::VectorXd(const Eigen::VectorXd& motion)>;
  /// Adds such forces to the right side on the way and solves in place: all other unknowns are eliminated first, so
  /// that the answer costs nothing but itself.
  void solve(Eigen::VectorXd& rightSide, const Answer& answer, const std::stop_token& stop = {}) const;

  /// The inverse matrix between the unknowns of the pattern's last groups, in the groups' order, in double precision:
  /// of the factor's last rows L, all other unknowns being eliminated, (L L^T)^-1. Empty: stopped.
  [[nodiscard]] Eigen::MatrixXd inverseOfLast(const std::stop_token& stop = {}) const;

  /// Gives back the matrix and the last rows in double precision: what is left substitutes (blocks) and does not solve.
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
