#include "nn/baselines/RecursiveLeastSquares.h"

#include "model/base/GotExpected.h"
#include "nn/NetworkError.h"

#include <string>

namespace palp {
namespace {

void requireForgetting(double forgetting) {
  if (!(forgetting > 0 && forgetting <= 1))
    throw NetworkError("forgetting: " + gotExpected(forgetting, "", "above 0 up to 1"));
}

} // namespace

RecursiveLeastSquares::RecursiveLeastSquares(Eigen::Index unknowns, Eigen::Index outputs, double initialVariance,
                                             double forgetting)
    : RecursiveLeastSquares(Eigen::MatrixXd::Zero(unknowns, outputs), initialVariance, forgetting) {}

RecursiveLeastSquares::RecursiveLeastSquares(Eigen::MatrixXd weights, double initialVariance, double forgetting)
    : weights_(std::move(weights)),
      variance_(initialVariance * Eigen::MatrixXd::Identity(weights_.rows(), weights_.rows())),
      forgetting_(forgetting) {
  requireForgetting(forgetting);
}

void RecursiveLeastSquares::update(const Eigen::Ref<const Eigen::VectorXd>& regressors,
                                   const Eigen::Ref<const Eigen::VectorXd>& targets) {
  const Eigen::VectorXd direction = variance_.selfadjointView<Eigen::Lower>() * regressors;
  const double denominator = forgetting_ + regressors.dot(direction);
  if (!(denominator > 0)) return; // rounding has made P indefinite along this direction: nothing can be learned there
  const Eigen::VectorXd gain = direction / denominator;
  weights_.noalias() += gain * (targets - weights_.transpose() * regressors).transpose();
  variance_.selfadjointView<Eigen::Lower>().rankUpdate(direction, -1 / denominator);
  if (forgetting_ < 1) variance_ /= forgetting_;
}

} // namespace palp
