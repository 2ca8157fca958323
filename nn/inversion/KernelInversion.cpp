#include "nn/inversion/KernelInversion.h"

#include "model/base/PositiveSolve.h"
#include "nn/linear/Lapack.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace palp {

namespace {

constexpr int kInitialGuesses = 6;
constexpr int kNearest =
    2; // of them, wherever they are: with few samples neighbours lead elsewhere; the others are apart
constexpr double kExplained =
    2; // deviations of chi-square above its mean: an estimate with a smaller residual is accepted
constexpr double kWild = 1e100; // largest measurement: its square is still finite
constexpr int kMostSteps = 20;
constexpr double kSmallStep = 0.01;                           // of a posterior deviation of the parameters
constexpr double kBeyond = 0.1;                               // share of its range by which a parameter may exceed it
constexpr double kLeastAmplitude = 0.02, kMostAmplitude = 50; // times that of the sample an inversion starts from

} // namespace

std::vector<Eigen::Index> KernelForwardModel::varied() const {
  std::vector<Eigen::Index> inputs;
  for (Eigen::Index k = 0; k < parameters(); ++k)
    if (parameterFactor(k) != 0) inputs.push_back(k);
  return inputs;
}

Eigen::MatrixXd KernelForwardModel::slopes(const Eigen::Ref<const Eigen::VectorXd>& parameters) const {
  assert(parameters.size() == this->parameters() && "all parameters, the constant ones too");
  const std::vector<Eigen::Index> inputs = varied();
  const Eigen::VectorXd scaled = (parameters - parameterOffset).cwiseProduct(parameterFactor)(inputs);
  Eigen::VectorXd value;
  Eigen::MatrixXd slope, all = Eigen::MatrixXd::Zero(components(), this->parameters());
  if (table.inputs() > 0)
    table.evaluate(scaled, value, slope);
  else
    slope = network.jacobian(scaled);
  all(Eigen::all, inputs) = slope * parameterFactor(inputs).asDiagonal();
  return all;
}

void KernelInversion::evaluate(const Eigen::Ref<const Eigen::VectorXd>& scaled, Eigen::VectorXd& value,
                               Eigen::MatrixXd& slope) const {
  if (model_.table.inputs() > 0) return table_.evaluate(scaled, value, slope);
  value = model_.network.predict(scaled);
  slope = model_.network.jacobian(scaled);
}

struct KernelInversion::Trial {
  Eigen::VectorXd scaled;
  Eigen::VectorXd residual; ///< weighted
  Eigen::MatrixXd slope;    ///< weighted
  double cost = INFINITY;
  Eigen::MatrixXd information;
};

KernelInversion::KernelInversion(const KernelForwardModel& model)
    : model_(model), table_(model.table), varied_(model.varied()), weight_(model.deviation.cwiseInverse()),
      weighted_(weight_.asDiagonal() * model.projection) {
  precision_ = (model.parameterFactor.array() * model.parameterDeviation.array())(varied_).square().inverse();
  const bool table = model.table.inputs() > 0;
  initialGuesses_ = table ? model.initialGuesses : model.network.centers;
  rest_ = table ? Eigen::VectorXd(weight_.cwiseProduct(model.table.rest))
                : Eigen::VectorXd(Eigen::VectorXd::Zero(weight_.size()));
  expected_.resize(weight_.size(), initialGuesses_.cols());
  if (table) {
    Eigen::VectorXd value;
    Eigen::MatrixXd slope;
    for (Eigen::Index i = 0; i < initialGuesses_.cols(); ++i) {
      evaluate(initialGuesses_.col(i), value, slope);
      expected_.col(i) = weight_.cwiseProduct(value) - rest_;
    }
  } else {
    expected_ = weight_.asDiagonal() * model.network.predict(initialGuesses_);
  }
  expectedSquare_ = expected_.colwise().squaredNorm();
  double area = 1;
  int places = 0;
  for (const int place : model.table.place)
    if (table && place >= 0) {
      area *= initialGuesses_.row(place).maxCoeff() - initialGuesses_.row(place).minCoeff();
      ++places;
    }
  if (places > 0) spacing_ = std::pow(area / static_cast<double>(initialGuesses_.cols()), 1. / places);
}

double KernelInversion::squareApart(Eigen::Index start, Eigen::Index other) const {
  double square = 0;
  for (const int place : model_.table.place)
    if (place >= 0) square += std::pow(initialGuesses_(place, start) - initialGuesses_(place, other), 2);
  return square;
}

KernelInversion::Trial KernelInversion::trialAt(Eigen::VectorXd scaled, const Eigen::VectorXd& wanted) const {
  Trial trial;
  trial.scaled = std::move(scaled);
  evaluate(trial.scaled, trial.residual, trial.slope);
  trial.residual = wanted - weight_.cwiseProduct(trial.residual);
  trial.slope = weight_.asDiagonal() * trial.slope;
  trial.cost = trial.residual.squaredNorm() + precision_.dot(trial.scaled.cwiseAbs2());
  trial.information = lapack::product(trial.slope, true, trial.slope, false);
  trial.information.diagonal() += precision_;
  return trial;
}

KernelInversion::Trial KernelInversion::descend(const Eigen::VectorXd& start, const Eigen::VectorXd& wanted) const {
  const Eigen::VectorXd most = (1 + 2 * kBeyond) * std::sqrt(12.) / 2 * precision_.cwiseInverse().cwiseSqrt();
  Trial now = trialAt(start.cwiseMin(most).cwiseMax(-most), wanted);
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::VectorXd uphill = now.slope.transpose() * now.residual - precision_.cwiseProduct(now.scaled);
    // Parameters at their bound that would leave it are kept while the others move.
    const Eigen::ArrayXd moves =
        (now.scaled.cwiseAbs().array() < most.array() || uphill.cwiseProduct(now.scaled).array() < 0).cast<double>();
    uphill.array() *= moves;
    bool better = false;
    double moved = 0;
    for (int tries = 0; tries < 6 && !better; ++tries) {
      Eigen::MatrixXd damped = moves.matrix().asDiagonal() * now.information * moves.matrix().asDiagonal();
      damped.diagonal() = (1 + damping) * now.information.diagonal();
      const auto factor = positiveFactor(damped);
      if (!factor) {
        damping *= 10;
        continue;
      }
      Eigen::VectorXd change = factor->solve(uphill);
      change = ((now.scaled + change).cwiseMin(most).cwiseMax(-most) - now.scaled).eval();
      moved = std::sqrt(std::max(0.0, change.dot(now.information * change)));
      if (moved < kSmallStep) break; // in deviations
      Trial next = trialAt(now.scaled + change, wanted);
      better = next.cost < now.cost;
      damping = better ? damping / 8 : 10 * damping;
      if (better) now = std::move(next);
    }
    if (!better) break;
  }
  return now;
}

/// The samples whose components are nearest to these, the nearest first; from the second on each excludes its
/// neighbours. With a table the amplitudes are scaled to the best fit.
std::vector<Eigen::VectorXd> KernelInversion::initialGuessesFor(const Eigen::VectorXd& wanted) const {
  const Eigen::VectorXd off = wanted - rest_;
  const Eigen::VectorXd along = lapack::product(expected_, true, off, false);
  Eigen::VectorXd amplitude = Eigen::VectorXd::Ones(along.size());
  if (!model_.amplitudes.empty())
    amplitude = along.cwiseQuotient(expectedSquare_.cwiseMax(1e-12)).cwiseMax(kLeastAmplitude).cwiseMin(kMostAmplitude);
  Eigen::VectorXd far = amplitude.cwiseProduct(amplitude.cwiseProduct(expectedSquare_) - 2 * along);
  std::vector<Eigen::VectorXd> result;
  for (int i = 0; i < kInitialGuesses; ++i) {
    Eigen::Index k = 0;
    if (!(far.minCoeff(&k) < INFINITY)) break;
    Eigen::VectorXd start = initialGuesses_.col(k);
    for (const int parameter : model_.amplitudes)
      start(parameter) =
          amplitude(k) * (start(parameter) + model_.table.shift(parameter)) - model_.table.shift(parameter);
    result.push_back(std::move(start));
    far(k) = INFINITY;
    for (Eigen::Index other = 0; i + 1 >= kNearest && other < far.size(); ++other)
      if (squareApart(k, other) < spacing_ * spacing_) far(other) = INFINITY;
  }
  return result;
}

KernelEstimate KernelInversion::estimate(const Eigen::Ref<const Eigen::VectorXd>& measurement) const {
  assert(measurement.size() == model_.measurements() && "one reading for each measurement");
  const Eigen::VectorXd change = (measurement - model_.measurementOffset).cwiseMax(-kWild).cwiseMin(kWild);
  const Eigen::VectorXd wanted = lapack::product(weighted_, false, change, false);
  Trial best;
  for (Eigen::VectorXd& start : initialGuessesFor(wanted)) {
    Trial trial = descend(start, wanted);
    if (trial.cost < best.cost) best = std::move(trial);
    const auto count = static_cast<double>(best.residual.size());
    if (best.residual.squaredNorm() < count + kExplained * std::sqrt(2 * count)) break; // explained: no other is needed
  }
  KernelEstimate estimate;
  estimate.parameters = model_.parameterOffset;
  estimate.standardDeviation = Eigen::VectorXd::Zero(model_.parameters());
  const Eigen::Index unknowns = best.information.rows();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(unknowns, unknowns, INFINITY); // where nothing is determined
  if (const auto factor = positiveFactor(best.information))
    covariance = factor->solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  for (std::size_t k = 0; k < varied_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double factor = model_.parameterFactor(varied_[k]);
    estimate.parameters(varied_[k]) += best.scaled(i) / factor;
    estimate.standardDeviation(varied_[k]) = model_.inflation(varied_[k]) * std::sqrt(covariance(i, i)) / factor;
  }
  estimate.chiSquare = best.residual.squaredNorm() / static_cast<double>(best.residual.size());
  if (model_.table.inputs() > 0)
    estimate.change = (wanted - rest_).cwiseQuotient(weight_).squaredNorm() / static_cast<double>(wanted.size());
  return estimate;
}

} // namespace palp
