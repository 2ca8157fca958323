#include "nn/baselines/GaussianProcess.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/NoisyCopies.h"
#include "nn/linear/Lapack.h"
#include "nn/rbf/RbfSystem.h"

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palp {
namespace {

constexpr int kMostEvaluations = 120;

/// Logarithms of what the likelihood decides.
struct Scales {
  double spread, linear, noise;
  explicit Scales(const std::vector<double>& logs)
      : spread(std::exp(logs[0])), linear(std::exp(logs[1])), noise(std::exp(logs[2])) {}
};

/// The kernel's Cholesky factor at some scales, and what follows from it.
struct Factored {
  Eigen::MatrixXd factor;
  Eigen::MatrixXd half;           ///< factor^-1 targets
  Eigen::VectorXd outputVariance; ///< the most likely one, in closed form
  double logLikelihood = -std::numeric_limits<double>::infinity();
};

class Likelihood {
public:
  Likelihood(Eigen::MatrixXd scaled, const Eigen::MatrixXd& targets)
      : scaled_(std::move(scaled)), shift_(targets.rowwise().mean()), right_((targets.colwise() - shift_).transpose()),
        distances_(squaredDistances(scaled_)), products_(lapack::gram(scaled_)) {
    products_.array() += 1;
  }

  [[nodiscard]] Factored at(const Scales& scales) const {
    Factored result;
    result.factor = distances_;
    basisInPlace(result.factor, gaussianRate(scales.spread, SpreadConvention::Sigma));
    result.factor += scales.linear * products_;
    result.factor.diagonal().array() += scales.noise;
    if (!lapack::choleskyInPlace(result.factor)) return result;
    const double samples = static_cast<double>(right_.rows());
    result.half = lapack::solveLower(result.factor, right_, false);
    // An output that does not vary has no scale of its own; it must not make the likelihood infinite.
    result.outputVariance = (result.half.colwise().squaredNorm().transpose() / samples).cwiseMax(1e-300);
    result.logLikelihood =
        -0.5 * samples * result.outputVariance.array().log().sum() -
        static_cast<double>(right_.cols()) * result.factor.diagonal().array().log().sum() -
        0.5 * samples * static_cast<double>(right_.cols()) * std::log(2 * std::numbers::pi * std::numbers::e);
    return result;
  }

  [[nodiscard]] const Eigen::MatrixXd& scaled() const { return scaled_; }
  [[nodiscard]] const Eigen::VectorXd& shift() const { return shift_; }
  [[nodiscard]] double extent() const { return std::sqrt(std::max(distances_.maxCoeff(), 1e-12)); }
  [[nodiscard]] double size() const { return std::max(1.0, products_.diagonal().maxCoeff()); }

private:
  Eigen::MatrixXd scaled_;
  Eigen::VectorXd shift_;
  Eigen::MatrixXd right_;
  Eigen::MatrixXd distances_;
  Eigen::MatrixXd products_;
};

struct Search {
  const Likelihood* likelihood;
  std::stop_token stop;
  int evaluations = 0;
};

double negativeLogLikelihood(const std::vector<double>& logs, std::vector<double>&, void* data) {
  Search& search = *static_cast<Search*>(data);
  if (search.stop.stop_requested()) throw nlopt::forced_stop();
  ++search.evaluations;
  const double value = search.likelihood->at(Scales(logs)).logLikelihood;
  return std::isfinite(value) ? -value : 1e300;
}

/// Most likely scales, by BOBYQA (Powell 2009) in NLopt.
std::vector<double> mostLikely(Search& search) {
  const double extent = search.likelihood->extent(), size = search.likelihood->size();
  const std::vector<double> low{std::log(0.02 * extent), std::log(1e-6), std::log(1e-12 * size)};
  const std::vector<double> high{std::log(100 * extent), std::log(1e6), std::log(1e2 * size)};
  std::vector<double> best{std::log(extent), std::log(10.0), std::log(std::sqrt(1e-7) * size)};
  nlopt::opt optimiser(nlopt::LN_BOBYQA, 3);
  optimiser.set_lower_bounds(low);
  optimiser.set_upper_bounds(high);
  optimiser.set_initial_step(std::vector<double>{1, 2, 4});
  optimiser.set_min_objective(negativeLogLikelihood, &search);
  optimiser.set_xtol_rel(1e-3);
  optimiser.set_maxeval(kMostEvaluations);
  double value = 0;
  try {
    optimiser.optimize(best, value);
  } catch (const nlopt::roundoff_limited&) { // `best` is the best point so far, which is what is wanted
  } catch (const nlopt::forced_stop&) {
    throw Cancelled();
  }
  return best;
}

Eigen::VectorXi evenly(Eigen::Index samples, int most) {
  const Eigen::Index count = std::min<Eigen::Index>(samples, std::max(1, most));
  Eigen::VectorXi result(count);
  for (Eigen::Index i = 0; i < count; ++i) result(i) = static_cast<int>(i * samples / count);
  return result;
}

} // namespace

Eigen::MatrixXd GaussianProcess::standardDeviation(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
  const Eigen::MatrixXd scaled = mean.scaler.apply(samples);
  Eigen::MatrixXd cross = squaredDistances(mean.centers, scaled);
  basisInPlace(cross, gaussianRate(mean.spread, mean.convention));
  cross.array() += linearVariance * (1 + lapack::product(mean.centers, true, scaled, false).array());
  const Eigen::RowVectorXd own =
      (1 + linearVariance * (1 + scaled.colwise().squaredNorm().array()) + noiseVariance).matrix();
  const Eigen::RowVectorXd explained = lapack::solveLower(factor, cross, false).colwise().squaredNorm();
  const Eigen::RowVectorXd left = (own - explained).cwiseMax(noiseVariance);
  return (outputVariance * left).cwiseSqrt();
}

GaussianProcessFit trainGaussianProcess(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                        const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                        const GaussianProcessOptions& options, const std::stop_token& stop) {
  RbfOptions common;
  common.relativeInputNoise = options.relativeInputNoise;
  requireUsable(samples, targets, common);
  GaussianProcessFit fit;
  fit.used = evenly(samples.cols(), options.mostSamples);
  if (fit.used.size() < samples.cols())
    fit.warnings.push_back(std::to_string(fit.used.size()) + " of " + std::to_string(samples.cols()) +
                           " samples were used: the time grows with the third power of their number");
  const Eigen::MatrixXd usedTargets = targets(Eigen::all, fit.used);
  const FeatureScaler scaler = FeatureScaler::fit(options.scaling, samples);
  const Likelihood likelihood(
      scaler.apply(noisyCopies(samples(Eigen::all, fit.used), options.relativeInputNoise, 1, options.seed, stop)),
      usedTargets);
  Search search{&likelihood, stop};
  const Scales scales(mostLikely(search));
  Factored best = likelihood.at(scales);
  if (!std::isfinite(best.logLikelihood))
    throw NetworkError("the Gaussian process found no scales at which its kernel can be factorised");
  const Eigen::MatrixXd weights = lapack::solveLower(best.factor, best.half, true); // samples x outputs
  fit.process.mean = {scaler,
                      likelihood.scaled(),
                      scales.spread,
                      SpreadConvention::Sigma,
                      BasisForm::Gaussian,
                      weights.transpose(),
                      scales.linear * lapack::product(weights, true, likelihood.scaled(), true),
                      likelihood.shift() + scales.linear * weights.colwise().sum().transpose()};
  fit.process.outputVariance = best.outputVariance;
  fit.process.linearVariance = scales.linear;
  fit.process.noiseVariance = scales.noise;
  fit.logLikelihood = best.logLikelihood;
  fit.evaluations = search.evaluations;
  fit.condition = std::pow(best.factor.diagonal().maxCoeff() / best.factor.diagonal().minCoeff(), 2);
  Eigen::MatrixXd inverse = best.factor;
  lapack::invertLowerInPlace(inverse);
  const Eigen::VectorXd diagonal = inverse.colwise().squaredNorm().transpose();
  fit.leaveOneOutResiduals = (diagonal.cwiseInverse().asDiagonal() * weights).transpose();
  fit.process.factor = std::move(best.factor);
  return fit;
}

} // namespace palp
