#include "solver/linear/SparseCholesky.h"

#include "model/base/Parallel.h"
#include "solver/linear/Front.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <numeric>

namespace palp {

namespace {

constexpr double subtreeShare = 1. / 16; // of all work: a subtree above it is cut further
constexpr double worthAThread = 2e7;     // flops: fewer are done before another thread has started
constexpr int blocksATask = 16;
constexpr int supernodesACall = 64; // between looks at a stop request

/// About 1 flop a number of the front for each column that is eliminated.
double work(const SupernodeTree& tree, int s) {
  return double(tree.width(s)) * tree.height(s) * tree.height(s);
}

// A child's rows below are a subset of its parent's rows. Both are ascending, so the subset consists of runs that are
// contiguous in both, and a run is added without looking at row numbers:
//
//   row of the factor   40 41 42 43 44 45 46 | 60 70 90 91     the parent's own | below
//   parent's rows        0  1  2  3  4  5  6 |  7  8  9 10
//   child's rows below   0  1  2        3  4 |        5  6
//   runs {from, to, length}:  {0, 0, 3}, {3, 5, 2}, {5, 9, 2}
//
// No run crosses from the parent's own rows (its panel) to those below (its update).
struct Run {
  int from, to, length;
};

/// Positions of the rows below supernode s among its parent's rows.
std::vector<Run> runsInParent(const SupernodeTree& tree, int s) {
  const int parent = tree.parent[s], below = tree.below(s);
  const int* rows = tree.rowsOf(s) + tree.width(s);
  const int* parentRows = tree.rowsOf(parent);
  std::vector<Run> runs;
  for (int i = 0, p = 0; i < below; ++i, ++p) {
    while (parentRows[p] != rows[i]) ++p;
    const bool continues = !runs.empty() && runs.back().to + runs.back().length == p && p != tree.width(parent);
    if (continues)
      ++runs.back().length;
    else
      runs.push_back({i, p, 1});
  }
  return runs;
}

/// Extend-add of the multifrontal method: out(to(i), to(j)) += U(i, j), i >= j, for the columns j of the runs firstRun
/// .. lastRun - 1 of a child's update U and all its rows i. The matrix added to begins at the parent's row and column
/// number `shift`; `columnOf` gives its columns, indexed by its own rows.
template <class ColumnOf>
void extendAdd(const UpdateMatrix& child, const std::vector<Run>& runs, std::size_t firstRun, std::size_t lastRun,
               const ColumnOf& columnOf, int shift) {
  for (std::size_t r = firstRun; r < lastRun; ++r)
    for (int j = 0; j < runs[r].length; ++j) {
      const double* column = child.column(runs[r].from + j);
      double* out = columnOf(runs[r].to + j - shift);
      for (int i = j; i < runs[r].length; ++i) out[runs[r].to - shift + i] += column[runs[r].from + i];
      for (std::size_t q = r + 1; q < runs.size(); ++q)
        for (int i = 0; i < runs[q].length; ++i) out[runs[q].to - shift + i] += column[runs[q].from + i];
    }
}

/// Numbers of the blocks of a supernode's own rows above row r0.
std::size_t ownBlockStart(int r0) {
  const std::size_t blocks = (r0 + factorBlockRows - 1) / factorBlockRows;
  return blocks * (blocks + 1) / 2 * factorBlockRows * factorBlockRows;
}

/// A block of the supernode's own rows; its diagonal is inverted.
void packOwnBlock(const double* panel, int height, int width, int r0, float* out) {
  constexpr int R = factorBlockRows;
  for (int k = 0; k < r0 + R; ++k)
    for (int r = 0; r < R; ++r) {
      const bool inside = r0 + r < width && k <= r0 + r && k < width;
      const double value = inside ? panel[std::size_t(k) * height + r0 + r] : 0;
      *out++ = static_cast<float>(inside && k == r0 + r ? 1 / value : value);
    }
}

/// A block of the rows below.
void packBlockBelow(const double* panel, int height, int width, int r0, float* out) {
  constexpr int R = factorBlockRows;
  const int rows = std::min(R, height - r0);
  for (int k = 0; k < width; ++k, out += R) {
    for (int r = 0; r < rows; ++r) out[r] = static_cast<float>(panel[std::size_t(k) * height + r0 + r]);
    std::fill(out + rows, out + R, 0.F);
  }
}

/// A factorised panel as blocks; false: stopped.
bool packPanel(const double* panel, int height, int width, float* out, const TaskRunner& run) {
  constexpr int R = factorBlockRows;
  const int own = (width + R - 1) / R, blocks = own + (height - width + R - 1) / R;
  return run((blocks + blocksATask - 1) / blocksATask, double(height) * width, [&](int t) {
    for (int b = t * blocksATask; b < std::min(blocks, (t + 1) * blocksATask); ++b)
      if (b < own)
        packOwnBlock(panel, height, width, b * R, out + ownBlockStart(b * R));
      else
        packBlockBelow(panel, height, width, width + (b - own) * R,
                       out + ownBlockStart(width) + std::size_t(b - own) * width * R);
  });
}

} // namespace

CholeskyPlan::CholeskyPlan(std::shared_ptr<const SparsePattern> pattern)
    : pattern_(std::move(pattern)), tree_(supernodeTree(*pattern_)), rowOf_(tree_.order.size()) {
  for (int row = 0; row < tree_.size(); ++row) rowOf_[tree_.order[row]] = row;
  placeBlocks();
  findEntries();
  cutTree();
  findLast();
}

void CholeskyPlan::placeBlocks() {
  constexpr int R = factorBlockRows;
  blocksStart_ = {0};
  blockBelow_ = {0};
  for (int s = 0; s < tree_.count(); ++s) {
    const int width = tree_.width(s), height = tree_.height(s);
    std::size_t numbers = ownBlockStart(width);
    for (int r0 = width; r0 < height; r0 += R) {
      numbers += std::size_t(width) * R;
      for (int r = 0; r < R; ++r) blockRows_.push_back(r0 + r < height ? tree_.rowsOf(s)[r0 + r] : tree_.size());
    }
    blocksStart_.push_back(blocksStart_.back() + numbers);
    blockBelow_.push_back(static_cast<int>(blockRows_.size()) / R);
  }
}

BlockedFactor CholeskyPlan::blocks(const float* values) const {
  return {tree_.count(), tree_.first.data(), blocksStart_.data(), blockBelow_.data(), blockRows_.data(), values};
}

/// Sorts the matrix's blocks of entries by the supernode whose panel they belong to: that of the group that comes first
/// in the factor.
void CholeskyPlan::findEntries() {
  const SparsePattern& pattern = *pattern_;
  std::vector<int> supernode(tree_.size());
  for (int s = 0; s < tree_.count(); ++s)
    std::fill(supernode.begin() + tree_.first[s], supernode.begin() + tree_.first[s + 1], s);
  const auto groups = static_cast<int>(pattern.groupStart.size()) - 1;
  const auto firstRow = [&](int group) { return rowOf_[pattern.groupStart[group]]; };
  const auto supernodeOf = [&](int g, int h) { return supernode[std::min(firstRow(g), firstRow(h))]; };
  entryStart_.assign(tree_.count() + 1, 0);
  for (int g = 0; g < groups; ++g)
    for (int k = pattern.groupColumns[g]; k < pattern.groupColumns[g + 1]; ++k)
      ++entryStart_[supernodeOf(g, pattern.groupRows[k]) + 1];
  std::partial_sum(entryStart_.begin(), entryStart_.end(), entryStart_.begin());
  std::vector<std::size_t> next(entryStart_.begin(), entryStart_.end() - 1);
  entries_.resize(pattern.groupRows.size());
  for (int g = 0; g < groups; ++g) {
    int value = pattern.columns[pattern.groupStart[g]];
    for (int k = pattern.groupColumns[g]; k < pattern.groupColumns[g + 1]; ++k) {
      const int h = pattern.groupRows[k];
      entries_[next[supernodeOf(g, h)]++] = {g, h, value, 0, firstRow(h) < firstRow(g)};
      value += pattern.groupStart[h + 1] - pattern.groupStart[h];
    }
  }
  std::vector<int> rowInPanel(tree_.size());
  for (int s = 0; s < tree_.count(); ++s) {
    for (int i = 0; i < tree_.height(s); ++i) rowInPanel[tree_.rowsOf(s)[i]] = i;
    for (std::size_t e = entryStart_[s]; e < entryStart_[s + 1]; ++e) {
      const int a = firstRow(entries_[e].columns), b = firstRow(entries_[e].rows);
      const int low = std::min(a, b), high = std::max(a, b);
      entries_[e].position = (low - tree_.first[s]) * tree_.height(s) + rowInPanel[high];
    }
  }
}

void CholeskyPlan::addMatrix(int s, std::span<const double> values, double* panel) const {
  const SparsePattern& pattern = *pattern_;
  const int height = tree_.height(s);
  for (std::size_t e = entryStart_[s]; e < entryStart_[s + 1]; ++e) {
    const EntryBlock& block = entries_[e];
    const int* columns = pattern.columns.data() + pattern.groupStart[block.columns];
    const int width = pattern.groupStart[block.columns + 1] - pattern.groupStart[block.columns];
    const int rows = pattern.groupStart[block.rows + 1] - pattern.groupStart[block.rows];
    for (int c = 0; c < width; ++c) {
      // Column c of a group begins at its diagonal, c rows below the first column's.
      const double* value = values.data() + block.value + (columns[c] - columns[0]) - c;
      for (int r = block.columns == block.rows ? c : 0; r < rows; ++r)
        panel[block.position + (block.transposed ? r * height + c : c * height + r)] += value[r];
    }
  }
}

// Cuts the tree into subtrees, each of which one thread works through alone, and the top above them, whose few large
// fronts all threads work on together. From the root down, a supernode whose subtree (summed up in `below`) has more
// than a sixteenth of all work belongs to the top; the first on each way down that has no more is a subtree's root:
//
//                root
//          .------+------.
//          x             y              root, x, y, z: the top
//       .--+--.       .--+--.
//      (2)   (4)     (1)    z           (1) .. (5): subtrees, the most work first
//                        .--+--.
//                       (3)   (5)
//
// The cut does not depend on the number of threads, and so neither does any sum.
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
    : plan_(std::move(plan)), factor_(plan_->factorSize()) {}

namespace {

/// One factorisation: fronts and what they hand up.
class Multifrontal {
public:
  Multifrontal(const CholeskyPlan& plan, std::span<const double> values, float* factor, Eigen::MatrixXd& lastRows,
               UpdatePrecision products)
      : plan_(plan), tree_(plan.tree()), values_(values), factor_(factor), lastRows_(lastRows), products_(products),
        updates_(tree_.count()) {}

  /// Room for the panel of any of the supernodes.
  [[nodiscard]] UnsetArray<double> panelFor(const std::vector<int>& supernodes) const {
    std::size_t most = 0;
    for (int s : supernodes) most = std::max(most, std::size_t(tree_.height(s)) * tree_.width(s));
    return UnsetArray<double>(most);
  }

  FrontOutcome factorise(int s, double* panel, const TaskRunner& run) {
    const std::vector<int>& children = plan_.children(s);
    const int width = tree_.width(s), height = tree_.height(s);
    std::fill_n(panel, std::size_t(height) * width, 0.);
    plan_.addMatrix(s, values_, panel);
    std::vector<std::vector<Run>> runs;
    for (int child : children) {
      runs.push_back(runsInParent(tree_, child));
      const std::size_t within = runsWithin(runs.back(), width);
      extendAdd(
          updates_[child], runs.back(), 0, within, [&](int c) { return panel + std::size_t(c) * height; }, 0);
      updates_[child].forgetBefore(within < runs.back().size() ? runs.back()[within].from : updates_[child].size());
    }
    UpdateMatrix update(tree_.below(s));
    FrontOutcome outcome = factoriseFront(panel, height, width, update, products_, run);
    if (outcome == FrontOutcome::Done &&
        !packPanel(panel, height, width, factor_ + plan_.blocks(factor_).start[s], run))
      outcome = FrontOutcome::Stopped;
    keepLastRows(s, panel);
    for (std::size_t c = 0; c < children.size(); ++c) {
      extendAdd(
          updates_[children[c]], runs[c], runsWithin(runs[c], width), runs[c].size(),
          [&](int k) { return update.column(k); }, width);
      updates_[children[c]] = {};
    }
    updates_[s] = std::move(update);
    return outcome;
  }

private:
  /// Runs whose columns belong to the parent's own.
  static std::size_t runsWithin(const std::vector<Run>& runs, int width) {
    return std::find_if(runs.begin(), runs.end(), [&](const Run& r) { return r.to >= width; }) - runs.begin();
  }

  /// Keeps the last groups' columns of a factorised panel.
  void keepLastRows(int s, const double* panel) {
    const int start = tree_.size() - plan_.lastUnknowns(), height = tree_.height(s);
    for (int c = std::max(0, start - tree_.first[s]); c < tree_.width(s); ++c)
      for (int r = c; r < height; ++r)
        lastRows_(tree_.rowsOf(s)[r] - start, tree_.first[s] + c - start) = panel[std::size_t(c) * height + r];
  }

  const CholeskyPlan& plan_;
  const SupernodeTree& tree_;
  std::span<const double> values_;
  float* factor_;
  Eigen::MatrixXd& lastRows_;
  UpdatePrecision products_;
  std::vector<UpdateMatrix> updates_;
};

} // namespace

SparseCholesky::Outcome SparseCholesky::factorise(LaneVector values, int threads, const std::stop_token& stop,
                                                  UpdatePrecision products) {
  assert(values.size() == plan_->pattern().rows.size() && "one value for each entry of the pattern");
  useOneBlasThread();
  matrix_ = std::move(values);
  lastRows_.setZero(plan_->lastUnknowns(), plan_->lastUnknowns());
  Multifrontal fronts(*plan_, matrix_, factor_.data(), lastRows_, products);
  std::atomic<FrontOutcome> worst{FrontOutcome::Done};
  const TaskRunner alone = [&](int count, double, const std::function<void(int)>& task) {
    for (int t = 0; t < count; ++t) task(t);
    return !stop.stop_requested();
  };
  const auto& subtrees = plan_->subtrees();
  forChunks(static_cast<int>(subtrees.size()), 1, threads, [&](int t, int) {
    UnsetArray<double> panel = fronts.panelFor(subtrees[t]);
    for (int s : subtrees[t]) {
      if (worst != FrontOutcome::Done) return;
      if (const FrontOutcome outcome = fronts.factorise(s, panel.data(), alone); outcome != FrontOutcome::Done)
        worst = outcome;
    }
  });
  const TaskRunner together = [&](int count, double flops, const std::function<void(int)>& task) {
    forChunks(count, 1, flops > worthAThread ? threads : 1, [&](int t, int) {
      if (!stop.stop_requested()) task(t);
    });
    return !stop.stop_requested();
  };
  UnsetArray<double> panel = fronts.panelFor(plan_->top());
  for (int s : plan_->top()) {
    if (worst != FrontOutcome::Done) break;
    worst = fronts.factorise(s, panel.data(), together);
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
  assert(rightSide.size() == plan_->tree().size() && "one number for each unknown");
  Eigen::VectorXd x = rightSide;
  substitute(x, stop);
  rightSide -= times(x);
  substitute(rightSide, stop);
  rightSide += x;
}

/// `onLast` may change the last groups' rows between the forward and the backward sweep.
void SparseCholesky::substitute(Eigen::VectorXd& x, const std::stop_token& stop,
                                const std::function<void(Eigen::Ref<Eigen::VectorXd>)>& onLast) const {
  const SupernodeTree& tree = plan_->tree();
  const BlockedFactor factor = blocks();
  Eigen::VectorXd inOrder(tree.size() + 1);
  for (int i = 0; i < tree.size(); ++i) inOrder(i) = x(tree.order[i]);
  inOrder(tree.size()) = 0;
  for (int first = 0; first < factor.count && !stop.stop_requested(); first += supernodesACall)
    laneKernels().forwardOne(factor, first, std::min(factor.count, first + supernodesACall), inOrder.data());
  if (onLast && !stop.stop_requested())
    onLast(inOrder.segment(tree.size() - plan_->lastUnknowns(), plan_->lastUnknowns()));
  for (int last = factor.count; last > 0 && !stop.stop_requested(); last -= supernodesACall)
    laneKernels().backwardOne(factor, std::max(0, last - supernodesACall), last, inOrder.data());
  for (int i = 0; i < tree.size(); ++i) x(tree.order[i]) = inOrder(i);
}

/// The matrix times x.
Eigen::VectorXd SparseCholesky::times(const Eigen::VectorXd& x) const {
  const SparsePattern& pattern = plan_->pattern();
  Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
  for (int j = 0; j < pattern.size(); ++j) {
    const int diagonal = pattern.columns[j];
    double sum = matrix_[diagonal] * x(j);
    for (int k = diagonal + 1; k < pattern.columns[j + 1]; ++k) {
      product(pattern.rows[k]) += matrix_[k] * x(j);
      sum += matrix_[k] * x(pattern.rows[k]);
    }
    product(j) += sum;
  }
  return product;
}

} // namespace palp
