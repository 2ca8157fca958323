// What a factorisation keeps of the pattern's last groups.

#include "solver/linear/DenseSystems.h"
#include "solver/linear/SparseCholesky.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace palp {

void CholeskyPlan::findLast() {
  std::vector<bool> isLast(tree_.size());
  for (int g : pattern_->lastGroups)
    for (int i = pattern_->groupStart[g]; i < pattern_->groupStart[g + 1]; ++i) {
      isLast[i] = true;
      ++lastUnknowns_;
    }
  for (int i = tree_.size() - lastUnknowns_; i < tree_.size(); ++i)
    if (!isLast[tree_.order[i]]) throw std::logic_error("the last groups are not the last of the factor");
}

std::vector<int> SparseCholesky::rowsOfLast() const {
  const SparsePattern& pattern = plan_->pattern();
  const SupernodeTree& tree = plan_->tree();
  const int start = tree.size() - plan_->lastUnknowns();
  std::vector<int> rows;
  for (int g : pattern.lastGroups)
    for (int i = pattern.groupStart[g]; i < pattern.groupStart[g + 1]; ++i) rows.push_back(plan_->rowOf()[i] - start);
  return rows;
}

Eigen::MatrixXd SparseCholesky::inverseOfLast(const std::stop_token& stop) const {
  Eigen::MatrixXd inOrder = lastRows_;
  if (!invertFromCholesky(inOrder, stop)) return {};
  const std::vector<int> rows = rowsOfLast();
  const auto size = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd inverse(size, size);
  for (Eigen::Index j = 0; j < size; ++j)
    for (Eigen::Index i = 0; i <= j; ++i)
      inverse(i, j) = inverse(j, i) = inOrder(std::max(rows[i], rows[j]), std::min(rows[i], rows[j]));
  return inverse;
}

// With L the factor's last rows and y the right-hand side's part there after the forward sweep, the unknowns' motion is
// L^-T y; forces f on them add L^-1 f to y.
void SparseCholesky::solve(Eigen::VectorXd& rightSide, const Answer& answer, const std::stop_token& stop) const {
  assert(rightSide.size() == plan_->tree().size() && "one number for each unknown");
  const std::vector<int> rows = rowsOfLast();
  const auto lower = lastRows_.triangularView<Eigen::Lower>();
  const int start = plan_->tree().size() - plan_->lastUnknowns();
  Eigen::VectorXd x = rightSide;
  substitute(x, stop, [&](Eigen::Ref<Eigen::VectorXd> y) {
    const Eigen::VectorXd moved = lower.transpose().solve(y), forces = answer(moved(rows));
    Eigen::VectorXd added(y.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      added(rows[i]) = forces(static_cast<Eigen::Index>(i));
      rightSide(plan_->tree().order[start + rows[i]]) += forces(static_cast<Eigen::Index>(i));
    }
    y += lower.solve(added);
  });
  rightSide -= times(x);
  substitute(rightSide, stop);
  rightSide += x;
}

} // namespace palp
