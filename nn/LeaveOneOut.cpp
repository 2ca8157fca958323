#include "nn/LeaveOneOut.h"

#include "model/base/GotExpected.h"
#include "model/base/Parallel.h"
#include "model/base/Text.h"
#include "nn/NetworkError.h"
#include "nn/SpreadSweep.h"
#include "nn/rbf/RbfSystem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace palp {
namespace {

/// Copies with noise that the spread is chosen on; the fit itself takes the options' number.
constexpr int kChoiceCopies = 4;
constexpr int kGridSpreads = 24;
constexpr int kRefinements = 10;
/// Steps beyond the grid's upper end, while that is the best: where the samples are few for their inputs.
constexpr int kStepsBeyond = 12;
/// The optimum is flat where there is noise, and each spread costs more.
constexpr int kNoisyGridSpreads = 6;
constexpr int kChoiceRidges = 15;
constexpr int kFinalRidges = 29;
constexpr double kFirstPower = 0.5;
constexpr std::array kOtherPowers{0.25, 0.75};

std::vector<double> ridgesOf(const RbfOptions& options, int count) {
  if (options.ridge) return {*options.ridge};
  return logarithmicRange(1e-13, 10, count);
}

bool better(const LeaveOneOutResult& a, const LeaveOneOutResult& b) {
  return a.score < b.score || (!std::isfinite(b.score) && std::isfinite(a.score));
}

LeaveOneOutResult bestOf(std::vector<LeaveOneOutResult> results) {
  LeaveOneOutResult best = std::move(results.front());
  for (LeaveOneOutResult& result : results)
    if (better(result, best)) best = std::move(result);
  return best;
}

/// From a twentieth of the samples' extent to 300 times it: from isolated bumps to the flat limit, a polynomial.
std::vector<double> spreadsFor(const RbfSystem& system, bool noisy) {
  const Eigen::MatrixXd& centers = system.centers();
  const Eigen::VectorXd middle = centers.rowwise().mean();
  const double extent = std::sqrt((centers.colwise() - middle).colwise().squaredNorm().maxCoeff());
  if (!(extent > 0)) return {1};
  return noisy ? logarithmicRange(0.1 * extent, 18 * extent, kNoisyGridSpreads)
               : logarithmicRange(0.05 * extent, 300 * extent, kGridSpreads);
}

/// Golden-section search for the smallest score on a logarithmic scale.
LeaveOneOutResult refined(const RbfSystem& system, const std::vector<double>& ridges, double low, double high,
                          LeaveOneOutResult best, const std::stop_token& stop) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = std::log(low), b = std::log(high);
  const auto at = [&](double logSpread) { return bestOf(system.leaveOneOut(std::exp(logSpread), ridges, stop)); };
  LeaveOneOutResult left = at(b - golden * (b - a)), right = at(a + golden * (b - a));
  for (int i = 2; i < kRefinements; ++i) {
    const bool goLeft = better(left, right);
    if (better(goLeft ? left : right, best)) best = goLeft ? left : right;
    if (goLeft) {
      b = std::log(right.spread);
      right = std::move(left);
      left = at(b - golden * (b - a));
    } else {
      a = std::log(left.spread);
      left = std::move(right);
      right = at(a + golden * (b - a));
    }
  }
  const LeaveOneOutResult& last = better(left, right) ? left : right;
  return better(last, best) ? last : best;
}

/// A system and a spread to try it at.
struct Trial {
  const RbfSystem* system;
  double spread;
};

std::vector<LeaveOneOutResult> tried(const std::vector<Trial>& trials, const std::vector<double>& ridges, int threads,
                                     const std::stop_token& stop) {
  std::vector<LeaveOneOutResult> results(trials.size());
  inParallel(trials.size(), threads, [&](std::size_t i) {
    results[i] = bestOf(trials[i].system->leaveOneOut(trials[i].spread, ridges, stop));
  });
  return results;
}

std::vector<LeaveOneOutResult> onGrid(const RbfSystem& system, const std::vector<double>& spreads,
                                      const std::vector<double>& ridges, int threads, const std::stop_token& stop) {
  std::vector<Trial> trials;
  for (const double spread : spreads) trials.push_back({&system, spread});
  return tried(trials, ridges, threads, stop);
}

std::size_t indexOfBest(const std::vector<LeaveOneOutResult>& results) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < results.size(); ++i)
    if (better(results[i], results[best])) best = i;
  return best;
}

/// The half-steps around the best spread, then the other powers of whitening at that spread and around it.
void refineNoisy(const Eigen::Ref<const Eigen::MatrixXd>& samples, const Eigen::Ref<const Eigen::MatrixXd>& targets,
                 const RbfOptions& options, const RbfSystem& system, int copies, const std::vector<double>& ridges,
                 const std::stop_token& stop, SpreadChoice& choice) {
  const auto& grid = choice.grid;
  const double step = grid.size() < 2 ? 1 : std::sqrt(grid[1].spread / grid[0].spread);
  const double middle = choice.overall.spread;
  for (LeaveOneOutResult& result : onGrid(system, {middle / step, middle * step}, ridges, options.threads, stop)) {
    if (better(result, choice.overall)) choice.overall = result;
    choice.grid.push_back(std::move(result));
  }
  if (options.scaling != Scaling::Whiten || options.whitening) return;
  std::vector<std::unique_ptr<RbfSystem>> others;
  std::vector<Trial> trials;
  for (const double power : kOtherPowers) {
    RbfOptions changed = options;
    changed.whitening = power;
    others.push_back(rbfSystem(samples, targets, changed, copies, stop));
    for (const double factor : {1 / step, 1.0, step})
      trials.push_back({others.back().get(), choice.overall.spread * factor});
  }
  const std::vector<LeaveOneOutResult> results = tried(trials, ridges, options.threads, stop);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (better(results[i], choice.overall)) {
      choice.overall = results[i];
      choice.whitening = kOtherPowers[i / 3];
    }
}

} // namespace

std::vector<LeaveOneOutResult> leaveOneOut(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                           const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                           const std::vector<double>& spreads, const RbfOptions& options,
                                           const std::stop_token& stop) {
  requireUsable(samples, targets, options);
  for (const double spread : spreads)
    if (!(spread > 0 && spread <= 1e100))
      throw NetworkError("spread: " + gotExpected(spread, "", "above 0 up to 1e100"));
  return onGrid(*rbfSystem(samples, targets, options, options.noiseCopies, stop), spreads,
                ridgesOf(options, kFinalRidges), options.threads, stop);
}

SpreadChoice chooseSpread(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                          const Eigen::Ref<const Eigen::MatrixXd>& targets, const RbfOptions& options,
                          const std::stop_token& stop) {
  requireUsable(samples, targets, options);
  const bool noisy = options.relativeInputNoise > 0;
  const int copies = std::min(options.noiseCopies, kChoiceCopies);
  const std::unique_ptr<RbfSystem> system = rbfSystem(samples, targets, options, copies, stop);
  std::vector<double> spreads = spreadsFor(*system, noisy);
  const std::vector<double> ridges = ridgesOf(options, noisy ? kChoiceRidges : kFinalRidges);
  SpreadChoice choice;
  choice.whitening = options.whitening.value_or(kFirstPower);
  choice.grid = onGrid(*system, spreads, ridges, options.threads, stop);
  std::size_t best = indexOfBest(choice.grid);
  for (int beyond = 0; !noisy && beyond < kStepsBeyond && best > 0 && best + 1 == spreads.size(); ++beyond) {
    spreads.push_back(spreads[best] * spreads[best] / spreads[best - 1]);
    choice.grid.push_back(onGrid(*system, {spreads.back()}, ridges, options.threads, stop).front());
    best = indexOfBest(choice.grid);
  }
  choice.overall = choice.grid[best];
  if (noisy)
    refineNoisy(samples, targets, options, *system, copies, ridges, stop, choice);
  else
    choice.overall = refined(*system, ridges, spreads[best == 0 ? 0 : best - 1],
                             spreads[std::min(best + 1, spreads.size() - 1)], choice.grid[best], stop);
  for (Eigen::Index o = 0; o < targets.rows(); ++o) {
    const auto least = std::min_element(choice.grid.begin(), choice.grid.end(),
                                        [o](const auto& a, const auto& b) { return a.rms(o) < b.rms(o); });
    choice.spreadOfEachOutput.push_back(least->spread);
  }
  return choice;
}

} // namespace palp
