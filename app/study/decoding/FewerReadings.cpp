#include "app/study/decoding/FewerReadings.h"

#include "io/Decoder.h"
#include "model/base/PositiveSolve.h"
#include "nn/NetworkError.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

namespace {

constexpr double kRangePrecision = 3;    // 1 / variance of a cause that is uniform over [-1, 1]
constexpr double kLeastKnown = 1e-9;     // of a component that no present reading depends on
constexpr double kLeastVariance = 1e-12; // of a component, where there is no noise
constexpr int kRefinements = 3;

Eigen::LLT<Eigen::MatrixXd> factorOf(const Eigen::MatrixXd& matrix) {
  auto factor = positiveFactor(matrix);
  if (!factor) throw NetworkError("the readings that are left do not determine the force with this network");
  return std::move(*factor);
}

} // namespace

std::string whyNotFewer(const Decoder& decoder) {
  if (decoder.areas || std::holds_alternative<ForwardModel>(decoder.model) ||
      std::holds_alternative<KernelForwardModel>(decoder.model))
    return {};
  return "this network (" + name(decoder.kind) +
         ") has no model of its readings, so it needs all of them; an ml or touch network has one";
}

ForwardModel ofMeasurements(const ForwardModel& model, const std::vector<Eigen::Index>& kept) {
  ForwardModel fewer = model;
  fewer.deviation = model.deviation(kept).eval();
  for (std::size_t c = 0; c < fewer.coefficients.size(); ++c)
    fewer.coefficients[c] = model.coefficients[c](kept, Eigen::all).eval();
  return fewer;
}

ImputedReadings imputed(const ForwardModel& model, const LikelihoodEstimate& touch, const PresentReadings& readings) {
  Eigen::MatrixXd slope;
  const Eigen::VectorXd all =
      model.measurementsOf(static_cast<std::size_t>(touch.classIndex), touch.parameters, &slope);
  const Eigen::MatrixXd weighted =
      model.deviation(readings.present).cwiseInverse().asDiagonal() * slope(readings.present, Eigen::all);
  Eigen::MatrixXd information = weighted.transpose() * weighted;
  information.diagonal() += kRangePrecision * model.parameterFactor.cwiseAbs2().cwiseMax(1e-300);
  const Eigen::LLT<Eigen::MatrixXd> factor = factorOf(information);
  const auto missing = static_cast<Eigen::Index>(readings.missing.size());
  const Eigen::Index parameters = slope.cols();
  // L^-T is a root of the causes' covariance.
  const Eigen::MatrixXd root = factor.matrixU().solve(Eigen::MatrixXd::Identity(parameters, parameters));
  ImputedReadings result{all(readings.missing), Eigen::MatrixXd::Zero(missing, parameters + missing)};
  result.scatter.leftCols(parameters) = slope(readings.missing, Eigen::all) * root;
  result.scatter.rightCols(missing).diagonal() = model.deviation(readings.missing);
  return result;
}

/// The components follow from all readings as c = P (x - offset), the readings from them as S^2 P' c: rows of P are
/// orthonormal in the readings' noise S. From the present ones c = (P S^2 P')^-1 P (x - offset), P and S of these.
FewerTouchReadings::FewerTouchReadings(const KernelForwardModel& model, double noise, double counted,
                                       const PresentReadings& readings)
    : model_(model), present_(readings.present), missing_(readings.missing), varied_(model.varied()) {
  const Eigen::VectorXd square = (counted * model.measurementOffset).cwiseAbs2();
  const Eigen::MatrixXd seen = model.projection(Eigen::all, present_);
  Eigen::MatrixXd known = seen * square(present_).asDiagonal() * seen.transpose();
  known.diagonal().array() += kLeastKnown;
  const Eigen::Index count = model.components();
  const Eigen::MatrixXd inverse = factorOf(known).solve(Eigen::MatrixXd::Identity(count, count));
  toComponents_ = inverse * seen;
  toMissing_ = square(missing_).asDiagonal() * model.projection(Eigen::all, missing_).transpose();
  Eigen::MatrixXd covariance = noise * inverse;
  covariance.diagonal() += (model.deviation.array().square() - noise).cwiseMax(kLeastVariance).matrix();
  covariance_ = factorOf(covariance);
  precision_ = (model.parameterFactor.array() * model.parameterDeviation.array())(varied_).square().inverse();
}

struct FewerTouchReadings::Fit {
  Eigen::VectorXd left; ///< components
  Eigen::MatrixXd slope;
  Eigen::VectorXd uphill;
  Eigen::MatrixXd information;
  double chiSquare = 0, cost = 0;
};

FewerTouchReadings::Fit FewerTouchReadings::fitAt(const Eigen::VectorXd& scaled,
                                                  const Eigen::VectorXd& components) const {
  Fit fit;
  Eigen::VectorXd value;
  if (model_.table.inputs() > 0) {
    model_.table.evaluate(scaled, value, fit.slope);
  } else {
    value = model_.network.predict(scaled);
    fit.slope = model_.network.jacobian(scaled);
  }
  fit.left = components - value;
  const Eigen::VectorXd weighted = covariance_.solve(fit.left);
  fit.uphill = fit.slope.transpose() * weighted - precision_.cwiseProduct(scaled);
  fit.information = fit.slope.transpose() * covariance_.solve(fit.slope);
  fit.information.diagonal() += precision_;
  fit.chiSquare = fit.left.dot(weighted) / static_cast<double>(components.size());
  fit.cost = fit.left.dot(weighted) + precision_.dot(scaled.cwiseAbs2());
  return fit;
}

KernelEstimate FewerTouchReadings::estimate(const KernelInversion& inversion,
                                            const Eigen::Ref<const Eigen::VectorXd>& readings_ohm) const {
  const Eigen::VectorXd components = toComponents_ * (readings_ohm - model_.measurementOffset)(present_);
  Eigen::VectorXd filled = readings_ohm;
  filled(missing_) = model_.measurementOffset(missing_) + toMissing_ * components;
  KernelEstimate result = inversion.estimate(filled);
  Eigen::VectorXd scaled = (result.parameters - model_.parameterOffset).cwiseProduct(model_.parameterFactor)(varied_);
  Fit fit = fitAt(scaled, components);
  for (int step = 0; step < kRefinements; ++step) {
    const Eigen::VectorXd next = scaled + factorOf(fit.information).solve(fit.uphill);
    Fit there = fitAt(next, components);
    if (!(there.cost < fit.cost)) break;
    scaled = next;
    fit = std::move(there);
  }
  const Eigen::Index count = scaled.size();
  const Eigen::MatrixXd covariance = factorOf(fit.information).solve(Eigen::MatrixXd::Identity(count, count));
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index parameter = varied_[static_cast<std::size_t>(k)];
    const double factor = model_.parameterFactor(parameter);
    result.parameters(parameter) = model_.parameterOffset(parameter) + scaled(k) / factor;
    result.standardDeviation(parameter) = model_.inflation(parameter) * std::sqrt(covariance(k, k)) / factor;
  }
  result.chiSquare = fit.chiSquare;
  return result;
}

} // namespace palp
