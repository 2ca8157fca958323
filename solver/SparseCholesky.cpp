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

/// Where the rows below supernode s stand in its parent's panel.
std::vector<int> placesInParent(const SupernodeTree& tree, int s) {
  const int parent = tree.parent[s], below = tree.below(s);
  const int* rows = tree.rowsOf(s) + tree.width(s);
  const int* parentRows = tree.rowsOf(parent);
  std::vector<int> places(below);
  for (int i = 0, p = 0; i < below; ++i) {
    while (parentRows[p] != rows[i]) ++p;
    places[i] = p;
  }
  return places;
}

/// Adds a child's update to its parent's panel and update.
void extendAdd(const SupernodeTree& tree, int child, const UpdateMatrix& from, double* panel, UpdateMatrix& update) {
  const int parent = tree.parent[child], height = tree.height(parent), width = tree.width(parent);
  const std::vector<int> places = placesInParent(tree, child);
  for (int j = 0; j < from.size; ++j) {
    const double* column = from.values.get() + std::size_t(j) * from.size;
    double* out = places[j] < width ? panel + std::size_t(places[j]) * height
                                    : update.values.get() + std::size_t(places[j] - width) * update.size - width;
    for (int i = j; i < from.size; ++i) out[places[i]] += column[i];
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
  Multifrontal(const CholeskyPlan& plan, std::span<const double> values, std::vector<double>& panels)
      : plan_(plan), tree_(plan.tree()), values_(values), panels_(panels), updates_(tree_.count()) {}

  FrontOutcome factorise(int s, const TaskRunner& run) {
    double* panel = panels_.data() + tree_.panelStart[s];
    std::fill(panel, panels_.data() + tree_.panelStart[s + 1], 0.);
    for (const auto& [value, position] : plan_.entries(s)) panel[position] += values_[value];
    UpdateMatrix update{tree_.below(s), nullptr};
    const std::size_t size = std::size_t(update.size) * update.size;
    update.values.reset(new double[size]); // unset: a leaf's product overwrites it
    const bool leaf = plan_.children(s).empty();
    if (!leaf) std::fill(update.values.get(), update.values.get() + size, 0.);
    for (int child : plan_.children(s)) {
      extendAdd(tree_, child, updates_[child], panel, update);
      updates_[child].values.reset();
    }
    const FrontOutcome outcome = factoriseFront(panel, tree_.height(s), tree_.width(s), update, leaf, run);
    updates_[s] = std::move(update);
    return outcome;
  }

private:
  const CholeskyPlan& plan_;
  const SupernodeTree& tree_;
  std::span<const double> values_;
  std::vector<double>& panels_;
  std::vector<UpdateMatrix> updates_;
};

} // namespace

SparseCholesky::Outcome SparseCholesky::factorise(std::span<const double> values, int threads,
                                                  const std::stop_token& stop) {
  useOneBlasThread();
  Multifrontal fronts(*plan_, values, panels_);
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

void SparseCholesky::solve(Eigen::VectorXd& rightSide) const {
  const SupernodeTree& tree = plan_->tree();
  Eigen::VectorXd x(tree.size()), y;
  for (int i = 0; i < tree.size(); ++i) x(i) = rightSide(tree.order[i]);
  for (int s = 0; s < tree.count(); ++s) {
    y.setZero(tree.below(s));
    forwardPanel(panels_.data() + tree.panelStart[s], tree.height(s), tree.width(s), x.data() + tree.first[s],
                 y.data());
    const int* rows = tree.rowsOf(s) + tree.width(s);
    for (Eigen::Index i = 0; i < y.size(); ++i) x(rows[i]) += y(i);
  }
  for (int s = tree.count() - 1; s >= 0; --s) {
    y.resize(tree.below(s));
    const int* rows = tree.rowsOf(s) + tree.width(s);
    for (Eigen::Index i = 0; i < y.size(); ++i) y(i) = x(rows[i]);
    backwardPanel(panels_.data() + tree.panelStart[s], tree.height(s), tree.width(s), x.data() + tree.first[s],
                  y.data());
  }
  for (int i = 0; i < tree.size(); ++i) rightSide(tree.order[i]) = x(i);
}

} // namespace palp
