#include "solver/SparseCholesky.h"

#include "solver/Front.h"
#include "solver/Parallel.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace palp {

namespace {

constexpr double subtreeShare = 1. / 16; // of all work: a subtree above it is cut further
constexpr double worthAThread = 2e7;     // flops

double work(const SupernodeTree& tree, int s) {
  return double(tree.width(s)) * tree.height(s) * tree.height(s);
}

/// Rows that stand together in a child's update and in its parent's panel.
struct Run {
  int from, to, length;
};

/// Where the rows below supernode s stand in its parent's panel.
std::vector<Run> runsInParent(const SupernodeTree& tree, int s) {
  const int parent = tree.parent[s], below = tree.below(s);
  const int* rows = tree.rowsOf(s) + tree.width(s);
  const int* parentRows = tree.rowsOf(parent);
  std::vector<Run> runs;
  for (int i = 0, p = 0; i < below; ++i, ++p) {
    while (parentRows[p] != rows[i]) ++p;
    const bool goesOn = !runs.empty() && runs.back().to + runs.back().length == p && p != tree.width(parent);
    if (goesOn)
      ++runs.back().length;
    else
      runs.push_back({i, p, 1});
  }
  return runs;
}

/// Adds the columns of some runs of a child's update to a matrix whose first row and column are the parent's number
/// `shift`.
void extendAdd(const UpdateMatrix& child, const std::vector<Run>& runs, std::size_t firstRun, std::size_t lastRun,
               double* target, std::size_t stride, int shift) {
  for (std::size_t r = firstRun; r < lastRun; ++r)
    for (int j = 0; j < runs[r].length; ++j) {
      const double* column = child.values.data() + std::size_t(runs[r].from + j) * child.size;
      double* out = target + std::size_t(runs[r].to + j - shift) * stride;
      for (int i = j; i < runs[r].length; ++i) out[runs[r].to - shift + i] += column[runs[r].from + i];
      for (std::size_t q = r + 1; q < runs.size(); ++q)
        for (int i = 0; i < runs[q].length; ++i) out[runs[q].to - shift + i] += column[runs[q].from + i];
    }
}

} // namespace

CholeskyPlan::CholeskyPlan(const SparsePattern& pattern) : tree_(supernodeTree(pattern)) {
  findEntries(pattern);
  cutTree();
}

/// Sorts the matrix's entries by the supernode whose panel they belong to.
void CholeskyPlan::findEntries(const SparsePattern& pattern) {
  const int n = tree_.size();
  std::vector<int> place(n), supernode(n);
  for (int i = 0; i < n; ++i) place[tree_.order[i]] = i;
  for (int s = 0; s < tree_.count(); ++s)
    std::fill(supernode.begin() + tree_.first[s], supernode.begin() + tree_.first[s + 1], s);
  entryStart_.assign(tree_.count() + 1, 0);
  const auto forEntries = [&](const auto& visit) {
    for (int c = 0; c < n; ++c)
      for (int k = pattern.columns[c]; k < pattern.columns[c + 1]; ++k) {
        const auto [low, high] = std::minmax(place[c], place[pattern.rows[k]]);
        visit(k, low, high);
      }
  };
  forEntries([&](int, int low, int) { ++entryStart_[supernode[low] + 1]; });
  std::partial_sum(entryStart_.begin(), entryStart_.end(), entryStart_.begin());
  std::vector<std::size_t> next(entryStart_.begin(), entryStart_.end() - 1);
  struct Place {
    int low, high;
  };
  std::vector<Place> places(pattern.rows.size());
  entries_.resize(pattern.rows.size());
  forEntries([&](int k, int low, int high) {
    const std::size_t slot = next[supernode[low]]++;
    entries_[slot].value = k;
    places[slot] = {low, high};
  });
  std::vector<int> rowInPanel(n);
  for (int s = 0; s < tree_.count(); ++s) {
    for (int i = 0; i < tree_.height(s); ++i) rowInPanel[tree_.rowsOf(s)[i]] = i;
    for (std::size_t e = entryStart_[s]; e < entryStart_[s + 1]; ++e)
      entries_[e].position = (places[e].low - tree_.first[s]) * tree_.height(s) + rowInPanel[places[e].high];
  }
}

/// Cuts the tree where a subtree has little of the work, the same for any number of threads.
void CholeskyPlan::cutTree() {
  const int count = tree_.count();
  std::vector<double> below(count);
  children_.resize(count);
  for (int s = 0; s < count; ++s) {
    below[s] += work(tree_, s);
    if (const int parent = tree_.parent[s]; parent >= 0) {
      below[parent] += below[s];
      children_[parent].push_back(s);
    }
  }
  double total = 0;
  for (int s = 0; s < count; ++s) total += tree_.parent[s] < 0 ? below[s] : 0;
  std::vector<int> subtree(count, -1), roots;
  for (int s = count - 1; s >= 0; --s) {
    const int parent = tree_.parent[s];
    if (parent >= 0 && subtree[parent] >= 0) {
      subtree[s] = subtree[parent];
    } else if (below[s] <= subtreeShare * total) {
      subtree[s] = static_cast<int>(roots.size());
      roots.push_back(s);
    }
  }
  subtrees_.resize(roots.size());
  for (int s = 0; s < count; ++s) (subtree[s] >= 0 ? subtrees_[subtree[s]] : top_).push_back(s);
  std::sort(subtrees_.begin(), subtrees_.end(),
            [&](const auto& a, const auto& b) { return below[a.back()] > below[b.back()]; });
}

SparseCholesky::SparseCholesky(std::shared_ptr<const CholeskyPlan> plan)
    : plan_(std::move(plan)), panels_(plan_->tree().panelStart.back()) {}

namespace {

/// One factorisation: fronts and what they hand up.
class Multifrontal {
public:
  Multifrontal(const CholeskyPlan& plan, std::span<const double> values, double* panels)
      : plan_(plan), tree_(plan.tree()), values_(values), panels_(panels), updates_(tree_.count()) {}

  FrontOutcome factorise(int s, const TaskRunner& run) {
    const std::vector<int>& children = plan_.children(s);
    const int width = tree_.width(s), height = tree_.height(s);
    double* panel = panels_ + tree_.panelStart[s];
    std::fill(panel, panels_ + tree_.panelStart[s + 1], 0.);
    for (const auto& [value, position] : plan_.entries(s)) panel[position] += values_[value];
    std::vector<std::vector<Run>> runs;
    for (int child : children) {
      runs.push_back(runsInParent(tree_, child));
      extendAdd(updates_[child], runs.back(), 0, runsWithin(runs.back(), width), panel, height, 0);
    }
    UpdateMatrix update{tree_.below(s), UnsetArray(std::size_t(tree_.below(s)) * tree_.below(s))};
    const FrontOutcome outcome = factoriseFront(panel, height, width, update, run);
    for (std::size_t c = 0; c < children.size(); ++c) {
      extendAdd(updates_[children[c]], runs[c], runsWithin(runs[c], width), runs[c].size(), update.values.data(),
                update.size, width);
      updates_[children[c]].values = {};
    }
    updates_[s] = std::move(update);
    return outcome;
  }

private:
  /// Runs whose columns belong to the parent's own.
  static std::size_t runsWithin(const std::vector<Run>& runs, int width) {
    return std::find_if(runs.begin(), runs.end(), [&](const Run& r) { return r.to >= width; }) - runs.begin();
  }

  const CholeskyPlan& plan_;
  const SupernodeTree& tree_;
  std::span<const double> values_;
  double* panels_;
  std::vector<UpdateMatrix> updates_;
};

} // namespace

SparseCholesky::Outcome SparseCholesky::factorise(std::span<const double> values, int threads,
                                                  const std::stop_token& stop) {
  useOneBlasThread();
  Multifrontal fronts(*plan_, values, panels_.data());
  std::atomic<FrontOutcome> worst{FrontOutcome::Done};
  const TaskRunner alone = [&](int count, double, const std::function<void(int)>& task) {
    for (int t = 0; t < count; ++t) task(t);
    return !stop.stop_requested();
  };
  const auto& subtrees = plan_->subtrees();
  forChunks(static_cast<int>(subtrees.size()), 1, threads, [&](int t, int) {
    for (int s : subtrees[t]) {
      if (worst != FrontOutcome::Done) return;
      if (const FrontOutcome outcome = fronts.factorise(s, alone); outcome != FrontOutcome::Done) worst = outcome;
    }
  });
  const TaskRunner together = [&](int count, double flops, const std::function<void(int)>& task) {
    forChunks(count, 1, flops > worthAThread ? threads : 1, [&](int t, int) {
      if (!stop.stop_requested()) task(t);
    });
    return !stop.stop_requested();
  };
  for (int s : plan_->top()) {
    if (worst != FrontOutcome::Done) break;
    worst = fronts.factorise(s, together);
  }
  switch (worst.load()) {
  case FrontOutcome::Done:
    return Outcome::Done;
  case FrontOutcome::NotPositiveDefinite:
    return Outcome::NotPositiveDefinite;
  case FrontOutcome::Stopped:
    break;
  }
  return Outcome::Stopped;
}

void SparseCholesky::solve(Eigen::VectorXd& rightSide, const std::stop_token& stop) const {
  const SupernodeTree& tree = plan_->tree();
  Eigen::VectorXd x(tree.size()), y;
  for (int i = 0; i < tree.size(); ++i) x(i) = rightSide(tree.order[i]);
  for (int s = 0; s < tree.count() && !stop.stop_requested(); ++s) {
    y.setZero(tree.below(s));
    forwardPanel(panels_.data() + tree.panelStart[s], tree.height(s), tree.width(s), x.data() + tree.first[s],
                 y.data());
    const int* rows = tree.rowsOf(s) + tree.width(s);
    for (Eigen::Index i = 0; i < y.size(); ++i) x(rows[i]) += y(i);
  }
  for (int s = tree.count() - 1; s >= 0 && !stop.stop_requested(); --s) {
    y.resize(tree.below(s));
    const int* rows = tree.rowsOf(s) + tree.width(s);
    for (Eigen::Index i = 0; i < y.size(); ++i) y(i) = x(rows[i]);
    backwardPanel(panels_.data() + tree.panelStart[s], tree.height(s), tree.width(s), x.data() + tree.first[s],
                  y.data());
  }
  for (int i = 0; i < tree.size(); ++i) rightSide(tree.order[i]) = x(i);
}

} // namespace palp
