#include "nn/baselines/PolynomialRidge.h"

#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "nn/NetworkError.h"
#include "nn/NoisyCopies.h"
#include "nn/linear/Lapack.h"
#include "nn/linear/RidgeFit.h"
#include "nn/rbf/RbfSystem.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace palp {
namespace {

/// Directions of the monomials smaller than this against the largest are rounding.
constexpr double kKernelRcond = 1e-14;
/// More samples than this carry the kernel no further and cost the square of their number.
constexpr Eigen::Index kMostCenters = 1000;

/// (1 + a_i.b_j / size)^degree, columns of a x columns of b.
Eigen::MatrixXd kernel(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double size, int degree) {
  const Eigen::ArrayXXd base = 1 + lapack::product(a, true, b, false).array() / size;
  Eigen::ArrayXXd power = base;
  for (int d = 1; d < degree; ++d) power *= base;
  return power;
}

/// Weights of the kernel's directions: K = V diag(l) V^T -> V l^-1/2, for directions above rounding.
Eigen::MatrixXd directions(const Eigen::MatrixXd& kernelOfCenters) {
  const lapack::SymmetricEigen eigen = lapack::symmetricEigen(kernelOfCenters);
  const Eigen::Index all = eigen.values.size();
  Eigen::Index kept = 0;
  while (kept < all && eigen.values(all - 1 - kept) > kKernelRcond * eigen.values(all - 1)) ++kept;
  return eigen.vectors.rightCols(kept) * eigen.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Evenly taken columns, at most mostCenters of them.
Eigen::MatrixXd thinned(const Eigen::MatrixXd& columns) {
  if (columns.cols() <= kMostCenters) return columns;
  Eigen::MatrixXd result(columns.rows(), kMostCenters);
  for (Eigen::Index i = 0; i < kMostCenters; ++i) result.col(i) = columns.col(i * columns.cols() / kMostCenters);
  return result;
}

} // namespace

Eigen::MatrixXd PolynomialRidge::predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
  if (samples.rows() != inputs())
    throw NetworkError("inputs: " + std::to_string(samples.rows()) + "; the polynomial takes " +
                       std::to_string(inputs()));
  const Eigen::MatrixXd scaled = scaler.apply(samples);
  const Eigen::MatrixXd features = degree == 1 ? scaled : kernel(centers, scaled, size, degree);
  return lapack::product(weights, false, features, false).colwise() + bias;
}

Eigen::MatrixXd PolynomialRidge::jacobian(const Eigen::Ref<const Eigen::VectorXd>& sample) const {
  if (degree == 1) return weights * scaler.jacobian();
  const Eigen::MatrixXd scaled = scaler.apply(sample);
  const Eigen::VectorXd slope = kernel(centers, scaled, size, degree - 1).col(0) * (degree / size);
  return weights * slope.asDiagonal() * centers.transpose() * scaler.jacobian();
}

PolynomialFit trainPolynomial(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                              const Eigen::Ref<const Eigen::MatrixXd>& targets, const PolynomialOptions& options,
                              const std::stop_token& stop) {
  RbfOptions common;
  common.relativeInputNoise = options.relativeInputNoise;
  common.noiseCopies = options.noiseCopies;
  common.ridge = options.ridge;
  requireUsable(samples, targets, common);
  if (options.degree < 1 || options.degree > 5)
    throw NetworkError("degree: " + gotExpected(std::to_string(options.degree), "1 to 5"));
  const bool noisy = options.relativeInputNoise > 0;
  const int copies = noisy ? options.noiseCopies : 1;
  PolynomialFit result;
  PolynomialRidge& model = result.model;
  model.degree = options.degree;
  model.scaler = FeatureScaler::fit(Scaling::Global, samples);
  const Eigen::MatrixXd clean = model.scaler.apply(samples);
  const Eigen::MatrixXd rows =
      model.scaler.apply(noisyCopies(samples, options.relativeInputNoise, copies, options.seed, stop));
  const Eigen::MatrixXd right = repeatedColumns(targets, copies).transpose();

  Eigen::MatrixXd toWeights, features;
  if (options.degree == 1)
    features = rows.transpose();
  else {
    model.centers = thinned(clean);
    const double meanSquare = clean.colwise().squaredNorm().mean();
    model.size = meanSquare > 0 ? meanSquare : 1;
    throwIfStopped(stop);
    toWeights = directions(kernel(model.centers, model.centers, model.size, options.degree));
    features.resize(rows.cols(), toWeights.cols());
    for (Eigen::Index first = 0; first < rows.cols(); first += lapack::kRowsAtOnce) {
      throwIfStopped(stop);
      const Eigen::Index count = std::min(lapack::kRowsAtOnce, rows.cols() - first);
      features.middleRows(first, count) = lapack::product(
          kernel(rows.middleCols(first, count), model.centers, model.size, options.degree), false, toWeights, false);
    }
  }
  const std::optional<double> ridge = !options.ridge && options.degree == 1 && !noisy ? 0.0 : options.ridge;
  RidgeFit fit = ridgeFit(features, right, copies, ridge, stop);
  model.weights =
      options.degree == 1 ? Eigen::MatrixXd(fit.x.transpose()) : lapack::product(fit.x, true, toWeights, true);
  model.bias = fit.constant;
  result.ridge = fit.ridge;
  result.condition = fit.condition;
  result.rank = fit.rank;
  result.leaveOneOutResiduals = std::move(fit.residuals);
  if (features.cols() + 1 > samples.cols() * copies)
    result.warnings.push_back("fewer samples (" + std::to_string(samples.cols()) + ") than unknowns (" +
                              std::to_string(features.cols() + 1) + "): the smallest of all solutions is used");
  return result;
}

} // namespace palp
