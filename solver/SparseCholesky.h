#pragma once

#include "solver/LaneVector.h"
#include "solver/SupernodeTree.h"

#include <Eigen/Core>

#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace palp {

/// What a factorisation needs to know of a pattern, found once: where the entries go and how the work is cut into
/// tasks. The cut does not depend on the number of threads.
class CholeskyPlan {
public:
  explicit CholeskyPlan(const SparsePattern& pattern);

  struct Entry {
    int value;    ///< in the pattern's values
    int position; ///< in the supernode's panel
  };
  [[nodiscard]] const SupernodeTree& tree() const { return tree_; }
  /// What the matrix adds to a supernode's panel.
  [[nodiscard]] std::span<const Entry> entries(int s) const {
    return {entries_.data() + entryStart_[s], entries_.data() + entryStart_[s + 1]};
  }
  [[nodiscard]] const std::vector<int>& children(int s) const { return children_[s]; }
  /// Supernodes of each subtree, the largest first.
  [[nodiscard]] const std::vector<std::vector<int>>& subtrees() const { return subtrees_; }
  /// Supernodes above the subtrees.
  [[nodiscard]] const std::vector<int>& top() const { return top_; }

private:
  void findEntries(const SparsePattern& pattern);
  void cutTree();

  SupernodeTree tree_;
  std::vector<std::size_t> entryStart_; ///< of each supernode in entries_
  std::vector<Entry> entries_;
  std::vector<std::vector<int>> children_;
  std::vector<std::vector<int>> subtrees_;
  std::vector<int> top_;
};

/// Multifrontal Cholesky factorisation on OpenBLAS (Duff and Reid 1983): subtrees in parallel, then the large fronts
/// at the top tile by tile. The bytes do not depend on the number of threads; a stop request is honoured between tasks.
class SparseCholesky {
public:
  explicit SparseCholesky(std::shared_ptr<const CholeskyPlan> plan);

  enum class Outcome { Done, NotPositiveDefinite, Stopped };
  [[nodiscard]] Outcome factorise(std::span<const double> values, int threads, const std::stop_token& stop);
  /// Solves in place. Stopped, it leaves no solution.
  void solve(Eigen::VectorXd& rightSide, const std::stop_token& stop = {}) const;

  [[nodiscard]] const CholeskyPlan& plan() const { return *plan_; }
  /// The factor's panels, as the tree says.
  [[nodiscard]] const UnsetArray& panels() const { return panels_; }

private:
  std::shared_ptr<const CholeskyPlan> plan_;
  UnsetArray panels_;
};

} // namespace palp
