#include "nn/baselines/BackPropagation.h"

#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "nn/NetworkError.h"
#include "nn/NoisyCopies.h"
#include "nn/VaryingInputs.h"
#include "nn/linear/Lapack.h"
#include "nn/linear/RandomNumbers.h"
#include "nn/rbf/KMeans.h"
#include "nn/rbf/RbfSystem.h"

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace palp {
namespace {

/// Principal directions below this share of the largest are left out, and more than this many.
constexpr double kLeastDirection = 1e-4;
constexpr Eigen::Index kMostDirections = 30;
/// Steps without a better held-out error after which training stops.
constexpr int kPatience = 150;

/// Where the network's four blocks lie in the optimiser's vector.
struct Layout {
  Eigen::Index inputs, hidden, outputs;
  [[nodiscard]] Eigen::Index size() const { return hidden * (inputs + 1) + outputs * (hidden + 1); }

  using Matrix = Eigen::Map<const Eigen::MatrixXd>;
  [[nodiscard]] Matrix hiddenWeights(const double* p) const { return {p, hidden, inputs}; }
  [[nodiscard]] Matrix hiddenBias(const double* p) const { return {p + hidden * inputs, hidden, 1}; }
  [[nodiscard]] Matrix outputWeights(const double* p) const { return {p + hidden * (inputs + 1), outputs, hidden}; }
  [[nodiscard]] Matrix outputBias(const double* p) const {
    return {p + hidden * (inputs + 1) + outputs * hidden, outputs, 1};
  }
};

struct Training {
  Layout layout;
  Eigen::MatrixXd inputs, targets;
  Eigen::MatrixXd heldInputs, heldTargets;
  std::stop_token stop;
  const std::function<void(double)>* progress = nullptr;
  int mostSteps = 1;

  int steps = 0;
  int lastBetter = 0;
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> bestParameters = {};
  std::vector<double> history = {};
  std::exception_ptr failure = {}; ///< what another than the optimiser threw
};

Eigen::MatrixXd activations(const Layout& layout, const double* p, const Eigen::MatrixXd& inputs) {
  const Eigen::MatrixXd sum = lapack::product(layout.hiddenWeights(p), false, inputs, false);
  return (sum.colwise() + layout.hiddenBias(p).col(0)).array().tanh();
}

Eigen::MatrixXd outputs(const Layout& layout, const double* p, const Eigen::MatrixXd& active) {
  return lapack::product(layout.outputWeights(p), false, active, false).colwise() + layout.outputBias(p).col(0);
}

double meanSquare(const Eigen::MatrixXd& m) {
  return m.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, m.size()));
}

/// Remembers the parameters with the smallest held-out error.
void judge(Training& training, const std::vector<double>& parameters, double trainingError) {
  const double* p = parameters.data();
  const double held =
      training.heldInputs.cols() == 0
          ? trainingError
          : meanSquare(outputs(training.layout, p, activations(training.layout, p, training.heldInputs)) -
                       training.heldTargets);
  training.history.push_back(trainingError);
  ++training.steps;
  if (held < training.best) {
    training.best = held;
    training.bestParameters = parameters;
    training.lastBetter = training.steps;
  }
  if (training.progress && *training.progress)
    (*training.progress)(static_cast<double>(training.steps) / training.mostSteps);
  if (training.stop.stop_requested() || training.steps - training.lastBetter > kPatience) throw nlopt::forced_stop();
}

/// Mean square error and its gradient by back-propagation (Rumelhart, Hinton and Williams 1986).
double errorAndGradient(const std::vector<double>& parameters, std::vector<double>& gradient, void* data) {
  Training& training = *static_cast<Training*>(data);
  const Layout& layout = training.layout;
  const double* p = parameters.data();
  const Eigen::MatrixXd active = activations(layout, p, training.inputs);
  const Eigen::MatrixXd difference = outputs(layout, p, active) - training.targets;
  const double error = meanSquare(difference);
  if (!gradient.empty()) {
    const Eigen::MatrixXd outputDelta = difference * (2.0 / static_cast<double>(difference.size()));
    const Eigen::MatrixXd hiddenDelta =
        (lapack::product(layout.outputWeights(p), true, outputDelta, false).array() * (1 - active.array().square()))
            .matrix();
    Eigen::Map<Eigen::VectorXd> all(gradient.data(), layout.size());
    const Eigen::MatrixXd hiddenSlope = lapack::product(hiddenDelta, false, training.inputs, true);
    const Eigen::MatrixXd outputSlope = lapack::product(outputDelta, false, active, true);
    all << hiddenSlope.reshaped(), hiddenDelta.rowwise().sum(), outputSlope.reshaped(), outputDelta.rowwise().sum();
  }
  judge(training, parameters, error);
  return error;
}

/// The same for NLopt, which would take whatever is thrown for a failure of its own.
double guardedError(const std::vector<double>& parameters, std::vector<double>& gradient, void* data) {
  try {
    return errorAndGradient(parameters, gradient, data);
  } catch (const nlopt::forced_stop&) {
    throw;
  } catch (...) {
    static_cast<Training*>(data)->failure = std::current_exception();
    throw nlopt::forced_stop();
  }
}

/// Principal directions of the scaled inputs, to variance 1: the optimiser then sees all of them alike. Those that
/// drown in noise (of this deviation) are left out, for they would carry nothing but noise blown up to the others'
/// size.
Eigen::MatrixXd principalDirections(const Eigen::MatrixXd& scaled, double noise) {
  const lapack::ThinSvd svd = lapack::thinSvd(scaled);
  const double size = std::sqrt(static_cast<double>(scaled.cols()));
  const double least = std::max(kLeastDirection * svd.values(0), noise * size);
  Eigen::Index kept = 0;
  while (kept < std::min(kMostDirections, svd.values.size()) && svd.values(kept) > least) ++kept;
  if (kept == 0 && svd.values(0) > 0) kept = 1; // nothing exceeds the noise: keep the strongest direction
  return (svd.values.head(kept).cwiseInverse() * size).asDiagonal() * svd.u.leftCols(kept).transpose();
}

std::vector<double> start(const Layout& layout, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<double> parameters(static_cast<std::size_t>(layout.size()), 0.0);
  const double hiddenSize = 1 / std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, layout.inputs)));
  const double outputSize = 1 / std::sqrt(static_cast<double>(layout.hidden));
  const std::size_t hiddenEnd = static_cast<std::size_t>(layout.hidden * (layout.inputs + 1));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    parameters[i] = (i < hiddenEnd ? hiddenSize : outputSize) * random.normal();
  return parameters;
}

void optimise(Training& training, std::uint64_t seed) {
  std::vector<double> parameters = start(training.layout, seed);
  nlopt::opt optimiser(nlopt::LD_LBFGS, static_cast<unsigned>(training.layout.size()));
  optimiser.set_min_objective(guardedError, &training);
  optimiser.set_maxeval(training.mostSteps);
  optimiser.set_vector_storage(30);
  double value = 0;
  try {
    optimiser.optimize(parameters, value);
  } catch (const nlopt::forced_stop&) {
    if (training.failure) std::rethrow_exception(training.failure);
    if (training.stop.stop_requested()) throw Cancelled();
  } catch (const nlopt::roundoff_limited&) { // the best parameters so far are kept
  } catch (const std::runtime_error&) {      // NLopt's plain failure: the line search found nothing better
  }
}

void requireOptions(const BackPropagationOptions& options) {
  if (options.hidden < 1 || options.hidden > 10000)
    throw NetworkError("hidden units: " + gotExpected(std::to_string(options.hidden), "1 to 10000"));
  if (options.iterations < 1)
    throw NetworkError("iterations: " + gotExpected(std::to_string(options.iterations), "1 or more"));
  if (!(options.heldOutShare >= 0 && options.heldOutShare <= 0.5))
    throw NetworkError("held-out share: " + gotExpected(options.heldOutShare, "", "0 to 0.5"));
}

} // namespace

Eigen::MatrixXd BackPropagationNetwork::predict(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
  if (samples.rows() != inputs())
    throw NetworkError("inputs: " + std::to_string(samples.rows()) + "; the network takes " + std::to_string(inputs()));
  const Eigen::MatrixXd reduced = lapack::product(components, false, inputScaler.apply(samples), false);
  const Eigen::MatrixXd active =
      (lapack::product(hiddenWeights, false, reduced, false).colwise() + hiddenBias).array().tanh();
  return outputScaler.invert(lapack::product(outputWeights, false, active, false).colwise() + outputBias);
}

BackPropagationFit trainBackPropagation(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                        const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                        const BackPropagationOptions& options, const std::stop_token& stop,
                                        const std::function<void(double)>& progress) {
  RbfOptions common;
  common.relativeInputNoise = options.relativeInputNoise;
  requireUsable(samples, targets, common);
  requireOptions(options);
  requireVarying(samples);
  BackPropagationFit fit;
  BackPropagationNetwork& network = fit.network;
  network.inputScaler = FeatureScaler::fit(Scaling::Global, samples);
  network.outputScaler = FeatureScaler::fit(Scaling::MinMax, targets);
  const double noise = options.relativeInputNoise * (network.inputScaler.factor.asDiagonal() * samples).norm() /
                       std::sqrt(static_cast<double>(samples.size()));
  network.components = principalDirections(network.inputScaler.apply(samples), noise);
  const Eigen::MatrixXd reduced = lapack::product(
      network.components, false,
      network.inputScaler.apply(noisyCopies(samples, options.relativeInputNoise, 1, options.seed)), false);
  const Eigen::MatrixXd scaledTargets = network.outputScaler.apply(targets);

  const int held = static_cast<int>(options.heldOutShare * static_cast<double>(samples.cols()));
  fit.heldOut = held > 0 ? randomColumns(samples.cols(), held, options.seed) : Eigen::VectorXi();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < samples.cols(); ++i)
    if (!std::binary_search(fit.heldOut.begin(), fit.heldOut.end(), static_cast<int>(i))) kept.push_back(i);
  Training training{{network.components.rows(), options.hidden, targets.rows()},
                    reduced(Eigen::all, kept),
                    scaledTargets(Eigen::all, kept),
                    reduced(Eigen::all, fit.heldOut),
                    scaledTargets(Eigen::all, fit.heldOut),
                    stop,
                    &progress,
                    options.iterations};
  optimise(training, options.seed);
  if (training.bestParameters.empty())
    throw NetworkError("back-propagation: no step had a finite error; the targets vary too little or too much for "
                       "double precision");
  fit.iterations = training.steps;
  fit.trainingError = std::move(training.history);

  const double* best = training.bestParameters.data();
  network.hiddenWeights = training.layout.hiddenWeights(best);
  network.hiddenBias = training.layout.hiddenBias(best).col(0);
  network.outputWeights = training.layout.outputWeights(best);
  network.outputBias = training.layout.outputBias(best).col(0);
  // The residuals must show the noise that was trained with.
  const Eigen::MatrixXd noisyHeld = network.outputScaler.invert(
      outputs(training.layout, best, activations(training.layout, best, training.heldInputs)));
  fit.heldOutResiduals = Eigen::MatrixXd(targets(Eigen::all, fit.heldOut)) - noisyHeld;
  if (held == 0) fit.warnings.push_back("too few samples to hold some out: the network may overfit");
  return fit;
}

} // namespace palp
