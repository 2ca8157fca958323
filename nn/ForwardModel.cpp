#include "nn/ForwardModel.h"

#include "nn/NetworkError.h"
#include "nn/RidgeFit.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <string>

namespace palp {

Eigen::Index monomialCount(Eigen::Index causes, int degree) {
  double count = 1;
  for (int d = 1; d <= degree; ++d) count = count * static_cast<double>(causes + d) / d;
  return static_cast<Eigen::Index>(std::llround(std::min(count, 1e15)));
}

namespace {

/// Exponents of all monomials of `causes` variables up to `degree`, one column each, the constant first.
Eigen::MatrixXi exponents(Eigen::Index causes, int degree) {
  std::vector<Eigen::VectorXi> all{Eigen::VectorXi::Zero(causes)};
  std::size_t first = 0;
  for (int d = 1; d <= degree; ++d) {
    const std::size_t last = all.size();
    for (std::size_t i = first; i < last; ++i) {
      // Raise only variables from the last one in use on: each monomial comes up once.
      Eigen::Index from = causes - 1;
      while (from > 0 && all[i](from) == 0) --from;
      for (Eigen::Index v = from; v < causes; ++v) {
        all.push_back(all[i]);
        ++all.back()(v);
      }
    }
    first = last;
  }
  Eigen::MatrixXi result(causes, static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = all[i];
  return result;
}

/// The monomials at y, and on request their derivatives (monomials x causes).
Eigen::VectorXd monomials(const Eigen::MatrixXi& exponent, const Eigen::VectorXd& y, Eigen::MatrixXd* slope) {
  const Eigen::Index causes = y.size();
  const int degree = exponent.maxCoeff();
  Eigen::MatrixXd power = Eigen::MatrixXd::Ones(causes, degree + 1);
  for (int d = 1; d <= degree; ++d) power.col(d) = power.col(d - 1).cwiseProduct(y);
  Eigen::VectorXd value = Eigen::VectorXd::Ones(exponent.cols());
  if (slope) *slope = Eigen::MatrixXd::Zero(exponent.cols(), causes);
  for (Eigen::Index m = 0; m < exponent.cols(); ++m) {
    for (Eigen::Index v = 0; v < causes; ++v) value(m) *= power(v, exponent(v, m));
    if (!slope) continue;
    for (Eigen::Index v = 0; v < causes; ++v) {
      if (exponent(v, m) == 0) continue;
      double product = exponent(v, m) * power(v, exponent(v, m) - 1);
      for (Eigen::Index w = 0; w < causes; ++w)
        if (w != v) product *= power(w, exponent(w, m));
      (*slope)(m, v) = product;
    }
  }
  return value;
}

/// The highest degree whose monomials are at most half as many as the samples of every class.
int affordableDegree(int wanted, Eigen::Index causes, Eigen::Index fewestSamples) {
  int degree = wanted;
  while (degree > 0 && 2 * monomialCount(causes, degree) > fewestSamples) --degree;
  return degree;
}

/// One class at its most likely causes.
struct Posterior {
  Eigen::VectorXd y; ///< scaled
  Eigen::MatrixXd covariance;
  double logEvidence = 0;
  double chiSquare = 0;
};

/// 1 / variance of a scaled cause that is uniform over [-1, 1].
constexpr double priorPrecision = 3;
constexpr int mostIterations = 30;
constexpr double enough = 1e-10;

class Inversion {
public:
  Inversion(const ForwardModel& model, const Eigen::Ref<const Eigen::VectorXd>& measurement)
      : model_(model), measurement_(measurement), exponent_(exponents(model.causes(), model.degree)) {}

  /// Damped Gauss-Newton on |(x - f(y)) / deviation|^2 + 3 |y|^2 from the middle of the range.
  [[nodiscard]] Posterior of(std::size_t c) const {
    Posterior result;
    result.y = Eigen::VectorXd::Zero(model_.causes());
    Eigen::MatrixXd slope;
    Eigen::VectorXd rest = remainder(c, result.y, &slope);
    for (int i = 0; i < mostIterations; ++i) {
      const Eigen::LDLT<Eigen::MatrixXd> normal(precision(slope));
      const Eigen::VectorXd step = normal.solve(slope.transpose() * rest - priorPrecision * result.y);
      const double before = cost(rest, result.y);
      double length = 1;
      Eigen::VectorXd next = result.y + step, nextRest = remainder(c, next, nullptr);
      while (!(cost(nextRest, next) <= before) && length > 1e-4) {
        length /= 2;
        next = result.y + length * step;
        nextRest = remainder(c, next, nullptr);
      }
      if (!(cost(nextRest, next) <= before)) break;
      result.y = next;
      rest = remainder(c, result.y, &slope);
      if (length * step.norm() < enough) break;
    }
    const Eigen::MatrixXd information = precision(slope);
    const Eigen::LDLT<Eigen::MatrixXd> normal(information);
    result.covariance = normal.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
    result.chiSquare = rest.squaredNorm();
    result.logEvidence = -0.5 * cost(rest, result.y) - 0.5 * normal.vectorD().array().abs().log().sum();
    return result;
  }

private:
  /// (x - f(y)) / deviation; its negative derivative in `slope`.
  Eigen::VectorXd remainder(std::size_t c, const Eigen::VectorXd& y, Eigen::MatrixXd* slope) const {
    Eigen::MatrixXd monomialSlope;
    const Eigen::VectorXd value = monomials(exponent_, y, slope ? &monomialSlope : nullptr);
    const Eigen::VectorXd weight = model_.deviation.cwiseInverse();
    if (slope) *slope = weight.asDiagonal() * (model_.coefficients[c] * monomialSlope);
    return weight.cwiseProduct(measurement_ - model_.coefficients[c] * value);
  }
  static double cost(const Eigen::VectorXd& rest, const Eigen::VectorXd& y) {
    return rest.squaredNorm() + priorPrecision * y.squaredNorm();
  }
  static Eigen::MatrixXd precision(const Eigen::MatrixXd& slope) {
    Eigen::MatrixXd result = slope.transpose() * slope;
    result.diagonal().array() += priorPrecision;
    return result;
  }

  const ForwardModel& model_;
  const Eigen::Ref<const Eigen::VectorXd>& measurement_;
  Eigen::MatrixXi exponent_;
};

void requireSizes(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                  const Eigen::Ref<const Eigen::MatrixXd>& causes, const Eigen::VectorXi& classes,
                  const ForwardModelOptions& options) {
  if (measurements.cols() == 0) throw NetworkError("samples: 0; allowed is 1 or more");
  if (causes.cols() != measurements.cols() || classes.size() != measurements.cols())
    throw NetworkError("a forward model wants one set of causes and one class a sample");
  if (!measurements.allFinite() || !causes.allFinite()) throw NetworkError("samples hold values that are no numbers");
  if (classes.minCoeff() < 0) throw NetworkError("classes: a negative one; allowed is 0 and above");
  if (options.degree < 0 || options.degree > 6)
    throw NetworkError("degree: " + std::to_string(options.degree) + "; allowed is 0 to 6");
}

std::vector<std::vector<Eigen::Index>> membersOf(const Eigen::VectorXi& classes) {
  std::vector<std::vector<Eigen::Index>> members(static_cast<std::size_t>(classes.maxCoeff()) + 1);
  for (Eigen::Index i = 0; i < classes.size(); ++i) members[static_cast<std::size_t>(classes(i))].push_back(i);
  for (std::size_t c = 0; c < members.size(); ++c)
    if (members[c].empty()) throw NetworkError("class " + std::to_string(c) + " has no sample; allowed is 1 or more");
  return members;
}

} // namespace

Eigen::VectorXd ForwardModel::measurementsOf(std::size_t c, const Eigen::Ref<const Eigen::VectorXd>& y,
                                             Eigen::MatrixXd* jacobian) const {
  const Eigen::VectorXd scaled = (y - causeOffset).cwiseProduct(causeFactor);
  Eigen::MatrixXd slope;
  const Eigen::VectorXd value = monomials(exponents(causes(), degree), scaled, jacobian ? &slope : nullptr);
  if (jacobian) *jacobian = coefficients[c] * slope * causeFactor.asDiagonal();
  return coefficients[c] * value;
}

ForwardModel fitForwardModel(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                             const Eigen::Ref<const Eigen::MatrixXd>& causes, const Eigen::VectorXi& classes,
                             const ForwardModelOptions& options, std::vector<std::string>* warnings) {
  requireSizes(measurements, causes, classes, options);
  const std::vector<std::vector<Eigen::Index>> members = membersOf(classes);
  std::size_t fewest = members.front().size();
  for (const auto& list : members) fewest = std::min(fewest, list.size());
  ForwardModel model;
  model.degree = affordableDegree(options.degree, causes.rows(), static_cast<Eigen::Index>(fewest));
  if (model.degree < options.degree && warnings)
    warnings->push_back("the forward model has degree " + std::to_string(model.degree) + " instead of " +
                        std::to_string(options.degree) + ": a class has only " + std::to_string(fewest) + " samples");
  const Eigen::VectorXd low = causes.rowwise().minCoeff(), high = causes.rowwise().maxCoeff();
  model.causeOffset = (low + high) / 2;
  model.causeFactor = (high - low).unaryExpr([](double range) { return range > 0 ? 2 / range : 0; });

  const Eigen::MatrixXi exponent = exponents(causes.rows(), model.degree);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(measurements.rows());
  for (const auto& list : members) {
    Eigen::MatrixXd features(static_cast<Eigen::Index>(list.size()), exponent.cols());
    Eigen::MatrixXd values(features.rows(), measurements.rows());
    for (Eigen::Index k = 0; k < features.rows(); ++k) {
      const Eigen::Index i = list[static_cast<std::size_t>(k)];
      const Eigen::VectorXd scaled = (causes.col(i) - model.causeOffset).cwiseProduct(model.causeFactor);
      features.row(k) = monomials(exponent, scaled, nullptr).transpose();
      values.row(k) = measurements.col(i).transpose();
    }
    const RidgeFit fit = ridgeFit(features.rightCols(features.cols() - 1), values, 1, 0.0);
    Eigen::MatrixXd coefficients(measurements.rows(), exponent.cols());
    coefficients.col(0) = fit.constant;
    coefficients.rightCols(exponent.cols() - 1) = fit.x.transpose();
    model.coefficients.push_back(std::move(coefficients));
    square += fit.residuals.cwiseAbs2().rowwise().sum();
  }
  const double samples = static_cast<double>(measurements.cols());
  const Eigen::ArrayXd size = measurements.cwiseAbs2().rowwise().mean().cwiseSqrt();
  model.deviation = (square.array() / samples + (options.relativeNoise * size).square()).sqrt();
  // Never less than rounding, so that a measurement without any error does not get infinite weight.
  const double largest = size.maxCoeff();
  model.deviation = model.deviation.cwiseMax((1e-14 * size).max(1e-15 * largest).max(1e-300).matrix());
  return model;
}

LikelihoodEstimate maximumLikelihood(const ForwardModel& model, const Eigen::Ref<const Eigen::VectorXd>& measurement) {
  if (measurement.size() != model.measurements())
    throw NetworkError("measurements: " + std::to_string(measurement.size()) + "; the forward model takes " +
                       std::to_string(model.measurements()));
  const Inversion inversion(model, measurement);
  std::vector<Posterior> posteriors;
  for (std::size_t c = 0; c < model.classes(); ++c) posteriors.push_back(inversion.of(c));
  std::size_t best = 0;
  for (std::size_t c = 1; c < posteriors.size(); ++c)
    if (posteriors[c].logEvidence > posteriors[best].logEvidence) best = c;
  double total = 0;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(model.causes());
  for (const Posterior& p : posteriors) {
    const double share = std::exp(p.logEvidence - posteriors[best].logEvidence);
    total += share;
    mean += share * p.y;
  }
  mean /= total;
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(model.causes());
  for (const Posterior& p : posteriors) {
    const double share = std::exp(p.logEvidence - posteriors[best].logEvidence) / total;
    variance += share * (p.covariance.diagonal() + (p.y - mean).cwiseAbs2());
  }
  const Eigen::VectorXd width = model.causeFactor.unaryExpr([](double f) { return f > 0 ? 1 / f : 0; });
  LikelihoodEstimate estimate;
  estimate.classIndex = static_cast<int>(best);
  estimate.confidence = 1 / total;
  estimate.causes = model.causeOffset + mean.cwiseProduct(width);
  estimate.standardDeviation = variance.cwiseSqrt().cwiseProduct(width);
  estimate.chiSquare = posteriors[best].chiSquare / static_cast<double>(model.measurements());
  return estimate;
}

} // namespace palp
