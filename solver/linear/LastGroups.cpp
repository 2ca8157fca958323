// What a factorisation keeps of the pattern's last groups.

#include "solver/linear/SparseCholesky.h"

#include <Eigen/Dense>

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

Eigen::MatrixXd SparseCholesky::inverseOfLast() const {
  const SparsePattern& pattern = plan_->pattern();
  const Eigen::Index size = lastRows_.rows();
  const Eigen::MatrixXd inverse = lastRows_.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(size, size));
  Eigen::MatrixXd inOrder = Eigen::MatrixXd::Zero(size, size);
  inOrder.selfadjointView<Eigen::Lower>().rankUpdate(inverse.transpose());
  std::vector<int> rowOf(plan_->tree().size());
  for (Eigen::Index i = 0; i < size; ++i) rowOf[plan_->tree().order[rowOf.size() - size + i]] = static_cast<int>(i);
  std::vector<int> rows;
  for (int g : pattern.lastGroups)
    for (int i = pattern.groupStart[g]; i < pattern.groupStart[g + 1]; ++i) rows.push_back(rowOf[i]);
  const Eigen::MatrixXd full = inOrder.selfadjointView<Eigen::Lower>();
  return full(rows, rows);
}

} // namespace palp
