#include "nn/baselines/ForwardModel.h"

#include "model/base/GotExpected.h"
#include "model/base/Monomials.h"
#include "model/base/PositiveSolve.h"
#include "nn/NetworkError.h"
#include "nn/linear/RidgeFit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace palp {

Eigen::Index monomialCount(Eigen::Index parameters, int degree) {
  double count = 1;
  for (int d = 1; d <= degree; ++d) count = count * static_cast<double>(parameters + d) / d;
  return static_cast<Eigen::Index>(std::llround(std::min(count, 1e15)));
}

namespace {

/// The monomials at y, and on request their derivatives (monomials x parameters).
Eigen::VectorXd monomials(const Eigen::MatrixXi& exponent, const Eigen::VectorXd& y, Eigen::MatrixXd* slope) {
  const Eigen::Index parameters = y.size();
  const int degree = exponent.maxCoeff();
  Eigen::MatrixXd power = Eigen::MatrixXd::Ones(parameters, degree + 1);
  for (int d = 1; d <= degree; ++d) power.col(d) = power.col(d - 1).cwiseProduct(y);
  Eigen::VectorXd value = Eigen::VectorXd::Ones(exponent.cols());
  if (slope) *slope = Eigen::MatrixXd::Zero(exponent.cols(), parameters);
  for (Eigen::Index m = 0; m < exponent.cols(); ++m) {
    for (Eigen::Index v = 0; v < parameters; ++v) value(m) *= power(v, exponent(v, m));
    if (!slope) continue;
    for (Eigen::Index v = 0; v < parameters; ++v) {
      if (exponent(v, m) == 0) continue;
      double product = exponent(v, m) * power(v, exponent(v, m) - 1);
      for (Eigen::Index w = 0; w < parameters; ++w)
        if (w != v) product *= power(w, exponent(w, m));
      (*slope)(m, v) = product;
    }
  }
  return value;
}

/// The highest degree whose monomials are at most half as many as the samples of every class.
int affordableDegree(int wanted, Eigen::Index parameters, Eigen::Index fewestSamples) {
  int degree = wanted;
  while (degree > 0 && 2 * monomialCount(parameters, degree) > fewestSamples) --degree;
  return degree;
}

/// 1 / variance of a scaled parameter that is uniform over [-1, 1].
constexpr double kPriorPrecision = 3;
constexpr int kMostIterations = 30;
constexpr double kEnough = 1e-10;
constexpr double kRounding = 1e-12; ///< of the cost: a smaller rise is rounding

void requireSizes(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                  const Eigen::Ref<const Eigen::MatrixXd>& parameters, const Eigen::VectorXi& classes,
                  const ForwardModelOptions& options) {
  if (measurements.cols() == 0) throw NetworkError("samples: " + gotExpected("0", "1 or more"));
  if (parameters.cols() != measurements.cols() || classes.size() != measurements.cols())
    throw NetworkError("a forward model needs one set of parameters and one class per sample");
  if (!measurements.allFinite() || !parameters.allFinite())
    throw NetworkError("samples contain values that are not finite");
  if (classes.minCoeff() < 0)
    throw NetworkError("classes: " + gotExpected(std::to_string(classes.minCoeff()), "0 or above"));
  if (options.degree < 0 || options.degree > 6)
    throw NetworkError("degree: " + gotExpected(std::to_string(options.degree), "0 to 6"));
}

std::vector<std::vector<Eigen::Index>> membersOf(const Eigen::VectorXi& classes) {
  std::vector<std::vector<Eigen::Index>> members(static_cast<std::size_t>(classes.maxCoeff()) + 1);
  for (Eigen::Index i = 0; i < classes.size(); ++i) members[static_cast<std::size_t>(classes(i))].push_back(i);
  for (std::size_t c = 0; c < members.size(); ++c)
    if (members[c].empty())
      throw NetworkError("samples of class " + std::to_string(c) + ": " + gotExpected("0", "1 or more"));
  return members;
}

} // namespace

Eigen::VectorXd ForwardModel::measurementsOf(std::size_t c, const Eigen::Ref<const Eigen::VectorXd>& y,
                                             Eigen::MatrixXd* jacobian) const {
  assert(c < classes() && y.size() == parameters() && "a class of the model and all its parameters");
  const Eigen::VectorXd scaled = (y - parameterOffset).cwiseProduct(parameterFactor);
  Eigen::MatrixXd slope;
  const Eigen::VectorXd value =
      monomials(monomialExponents(parameters(), 0, degree), scaled, jacobian ? &slope : nullptr);
  if (jacobian) *jacobian = coefficients[c] * slope * parameterFactor.asDiagonal();
  return coefficients[c] * value;
}

ForwardModel fitForwardModel(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                             const Eigen::Ref<const Eigen::MatrixXd>& parameters, const Eigen::VectorXi& classes,
                             const ForwardModelOptions& options, std::vector<std::string>* warnings) {
  requireSizes(measurements, parameters, classes, options);
  const std::vector<std::vector<Eigen::Index>> members = membersOf(classes);
  std::size_t fewest = members.front().size();
  for (const auto& list : members) fewest = std::min(fewest, list.size());
  ForwardModel model;
  model.degree = affordableDegree(options.degree, parameters.rows(), static_cast<Eigen::Index>(fewest));
  if (model.degree < options.degree && warnings)
    warnings->push_back("the polynomial that detects the loaded area has degree " + std::to_string(model.degree) +
                        " in the force instead of " + std::to_string(options.degree) + ": an area has only " +
                        std::to_string(fewest) + " samples");
  const Eigen::VectorXd low = parameters.rowwise().minCoeff(), high = parameters.rowwise().maxCoeff();
  model.parameterOffset = (low + high) / 2;
  model.parameterFactor = (high - low).unaryExpr([](double range) { return range > 0 ? 2 / range : 0; });

  const Eigen::MatrixXi exponent = monomialExponents(parameters.rows(), 0, model.degree);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(measurements.rows());
  for (const auto& list : members) {
    Eigen::MatrixXd features(static_cast<Eigen::Index>(list.size()), exponent.cols());
    Eigen::MatrixXd values(features.rows(), measurements.rows());
    for (Eigen::Index k = 0; k < features.rows(); ++k) {
      const Eigen::Index i = list[static_cast<std::size_t>(k)];
      const Eigen::VectorXd scaled = (parameters.col(i) - model.parameterOffset).cwiseProduct(model.parameterFactor);
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

/// One class at its most likely parameters.
struct LikelihoodInversion::Posterior {
  Eigen::VectorXd y; ///< scaled
  Eigen::MatrixXd covariance;
  double logEvidence = 0;
  double chiSquare = 0;
};

LikelihoodInversion::LikelihoodInversion(const ForwardModel& model)
    : parameterOffset_(model.parameterOffset),
      parameterWidth_(model.parameterFactor.unaryExpr([](double f) { return f > 0 ? 1 / f : 0; })),
      measurements_(model.measurements()), exponent_(monomialExponents(model.parameters(), 0, model.degree)) {
  const Eigen::VectorXd weight = model.deviation.cwiseInverse();
  for (const Eigen::MatrixXd& coefficients : model.coefficients) {
    Class c;
    c.constant = coefficients.col(0);
    c.weight = weight;
    c.polynomial = weight.asDiagonal() * coefficients.rightCols(coefficients.cols() - 1);
    c.gram = c.polynomial.transpose() * c.polynomial;
    classes_.push_back(std::move(c));
  }
}

/// Damped Gauss-Newton on |(x - f(y)) / deviation|^2 + 3 |y|^2 from the middle of the range. With f = c + P m(y) the
/// sum of squares is |r|^2 - 2 m' P'r + m' P'P m, r = x - c.
LikelihoodInversion::Posterior LikelihoodInversion::posterior(const Class& c,
                                                              const Eigen::VectorXd& measurement) const {
  const Eigen::VectorXd remainder = c.weight.cwiseProduct(measurement - c.constant);
  const Eigen::VectorXd projected = c.polynomial.transpose() * remainder;
  const double square = remainder.squaredNorm();
  Posterior result;
  result.y = Eigen::VectorXd::Zero(parameterOffset_.size());
  const Eigen::Index count = projected.size();
  Eigen::MatrixXd allSlopes, slope;
  Eigen::VectorXd gradient; // of the monomials: P'(r - P m)
  const auto cost = [&](const Eigen::VectorXd& y, bool withSlope) {
    const Eigen::VectorXd m = monomials(exponent_, y, withSlope ? &allSlopes : nullptr).tail(count);
    const Eigen::VectorXd product = c.gram * m;
    if (withSlope) {
      slope = allSlopes.bottomRows(count);
      gradient = projected - product;
    }
    result.chiSquare = std::max(0.0, square - 2 * m.dot(projected) + m.dot(product));
    return result.chiSquare + kPriorPrecision * y.squaredNorm();
  };
  const auto precision = [&] {
    Eigen::MatrixXd information = slope.transpose() * c.gram * slope;
    information.diagonal().array() += kPriorPrecision;
    return information;
  };
  double before = cost(result.y, true);
  for (int i = 0; i < kMostIterations; ++i) {
    const auto normal = semidefiniteFactor(precision());
    if (!normal) break;
    const Eigen::VectorXd step = normal->solve(slope.transpose() * gradient - kPriorPrecision * result.y);
    const double most = before + kRounding * (square + before);
    double length = 1;
    Eigen::VectorXd next = result.y + step;
    while (!(cost(next, false) <= most) && length > 1e-4) {
      length /= 2;
      next = result.y + length * step;
    }
    if (!(cost(next, false) <= most)) break;
    result.y = next;
    before = cost(result.y, true);
    if (length * step.norm() < kEnough) break;
  }
  const double least = cost(result.y, true);
  const auto normal = semidefiniteFactor(precision());
  if (!normal) { // readings that are not finite: nor is the estimate
    result.y.setConstant(NAN);
    result.covariance = Eigen::MatrixXd::Constant(result.y.size(), result.y.size(), NAN);
    return result;
  }
  result.covariance = normal->solve(Eigen::MatrixXd::Identity(result.y.size(), result.y.size()));
  result.logEvidence = -0.5 * least - 0.5 * normal->vectorD().array().abs().log().sum();
  return result;
}

LikelihoodEstimate LikelihoodInversion::estimate(const Eigen::Ref<const Eigen::VectorXd>& measurement) const {
  if (measurement.size() != measurements_)
    throw NetworkError("measurements: " + std::to_string(measurement.size()) + "; the forward model takes " +
                       std::to_string(measurements_));
  std::vector<Posterior> posteriors;
  for (const Class& c : classes_) posteriors.push_back(posterior(c, measurement));
  std::size_t best = 0;
  for (std::size_t c = 1; c < posteriors.size(); ++c)
    if (posteriors[c].logEvidence > posteriors[best].logEvidence) best = c;
  double total = 0;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(parameterOffset_.size());
  for (const Posterior& p : posteriors) {
    const double share = std::exp(p.logEvidence - posteriors[best].logEvidence);
    total += share;
    mean += share * p.y;
  }
  mean /= total;
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(parameterOffset_.size());
  for (const Posterior& p : posteriors) {
    const double share = std::exp(p.logEvidence - posteriors[best].logEvidence) / total;
    variance += share * (p.covariance.diagonal() + (p.y - mean).cwiseAbs2());
  }
  LikelihoodEstimate estimate;
  estimate.classIndex = static_cast<int>(best);
  estimate.confidence = 1 / total;
  estimate.parameters = parameterOffset_ + mean.cwiseProduct(parameterWidth_);
  estimate.standardDeviation = variance.cwiseSqrt().cwiseProduct(parameterWidth_);
  estimate.chiSquare = posteriors[best].chiSquare / static_cast<double>(measurements_);
  return estimate;
}

LikelihoodEstimate maximumLikelihood(const ForwardModel& model, const Eigen::Ref<const Eigen::VectorXd>& measurement) {
  return LikelihoodInversion(model).estimate(measurement);
}

} // namespace palp
