#include "nn/RbfNetwork.h"

#include "model/base/GotExpected.h"
#include "nn/NetworkError.h"
#include "nn/RbfEvaluator.h"

#include <string>

namespace palp {
namespace {

void requireInputs(Eigen::Index given, Eigen::Index wanted) {
  if (given != wanted)
    throw NetworkError("inputs: " + gotExpected(std::to_string(given), std::to_string(wanted) + ", as in the network"));
}

} // namespace

Eigen::MatrixXd RbfNetwork::predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
  requireInputs(samples.rows(), inputs());
  Eigen::MatrixXd output(outputs(), samples.cols());
  RbfEvaluator(*this).evaluate(samples, output);
  return output;
}

Eigen::MatrixXd RbfNetwork::jacobian(const Eigen::Ref<const Eigen::VectorXd>& sample) const {
  requireInputs(sample.size(), inputs());
  const Eigen::MatrixXd scaled = scaler.apply(sample);
  const double gamma = gaussianRate(spread, convention);
  Eigen::MatrixXd phi = squaredDistances(centers, scaled);
  basisInPlace(phi, gamma);
  if (form == BasisForm::Remainder) phi.array() -= 1;                      // d/dt of exp(-t) - 1 + t is 1 - exp(-t)
  const Eigen::MatrixXd difference = (-centers).colwise() + scaled.col(0); // scaled inputs x centres
  Eigen::MatrixXd slope = weights * (-2 * gamma * phi.col(0)).asDiagonal() * difference.transpose();
  if (tail.size() > 0) slope += tail;
  return slope * scaler.jacobian();
}

} // namespace palp
