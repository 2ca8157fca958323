#include "solver/statics/StepMixing.h"

#include "model/base/PositiveSolve.h"

namespace palp {

namespace {

constexpr double leastIndependent =
    1e-10; // of the squared changes: keeps the coefficients finite where directions are dependent

} // namespace

/// gamma for the changes so far. They are scaled, as they fall by orders of magnitude from one iteration to the next.
Eigen::VectorXd StepMixing::shares(const Eigen::VectorXd& direction) const {
  const auto count = static_cast<Eigen::Index>(past_.size());
  const auto change = [&](Eigen::Index i) -> const Eigen::VectorXd& {
    return past_[static_cast<std::size_t>(i)].change;
  };
  Eigen::MatrixXd products(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    right(i) = change(i).dot(direction);
    for (Eigen::Index j = 0; j <= i; ++j) products(i, j) = products(j, i) = change(i).dot(change(j));
  }
  const Eigen::VectorXd scale = products.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * products * scale.asDiagonal();
  const Eigen::MatrixXd definite = scaled + leastIndependent * Eigen::MatrixXd::Identity(count, count);
  const auto factor = semidefiniteFactor(definite);
  if (!factor) return Eigen::VectorXd::Zero(count); // the step itself, unmixed
  return scale.cwiseProduct(factor->solve(scale.cwiseProduct(right)));
}

void StepMixing::mix(Eigen::VectorXd& displacements, LaneVector& unknowns) {
  Eigen::Map<Eigen::VectorXd> x(unknowns.data(), static_cast<Eigen::Index>(unknowns.size()));
  const Part direction{displacements, x};
  if (!past_.empty()) {
    Past& last = past_.back();
    last.change = direction.displacements - last.direction.displacements;
    last.motion = {last.step.displacements + last.change,
                   last.step.unknowns + direction.unknowns - last.direction.unknowns};
    if (past_.size() > depth) past_.pop_front();
    const Eigen::VectorXd gamma = shares(direction.displacements);
    for (std::size_t j = 0; j < past_.size(); ++j) {
      displacements -= gamma(static_cast<Eigen::Index>(j)) * past_[j].motion.displacements;
      x -= gamma(static_cast<Eigen::Index>(j)) * past_[j].motion.unknowns;
    }
  }
  past_.push_back({direction, {displacements, x}, {}, {}});
}

} // namespace palp
