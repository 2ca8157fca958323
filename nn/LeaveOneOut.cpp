#include "nn/LeaveOneOut.h"

#include "nn/NetworkError.h"
#include "nn/Parallel.h"
#include "nn/RbfProblem.h"
#include "nn/SpreadSweep.h"

#include <algorithm>
#include <cmath>

namespace palp {
namespace {

/// Copies with noise that the spread is chosen on; the fit itself takes the options' number.
constexpr int choiceCopies = 4;
constexpr int gridSpreads = 24;
constexpr int refinements = 10;
/// The optimum is flat where there is noise, and each spread costs more.
constexpr int noisyGridSpreads = 12;

void stopIfAsked(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled();
}

std::vector<double> ridgesOf(const RbfOptions& options) {
  if (options.ridge) return {*options.ridge};
  return logarithmicRange(1e-13, 10, 29);
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
std::vector<double> spreadsFor(const RbfProblem& problem, bool noisy) {
  const Eigen::MatrixXd& centers = problem.centers();
  const Eigen::VectorXd middle = centers.rowwise().mean();
  const double extent = std::sqrt((centers.colwise() - middle).colwise().squaredNorm().maxCoeff());
  if (!(extent > 0)) return {1};
  return noisy ? logarithmicRange(0.1 * extent, 30 * extent, noisyGridSpreads)
               : logarithmicRange(0.05 * extent, 300 * extent, gridSpreads);
}

/// Golden-section search for the least score on a logarithmic scale.
LeaveOneOutResult refined(const RbfProblem& problem, const std::vector<double>& ridges, double low, double high,
                          LeaveOneOutResult best, const std::stop_token& stop) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = std::log(low), b = std::log(high);
  const auto at = [&](double logSpread) {
    stopIfAsked(stop);
    return bestOf(problem.leaveOneOut(std::exp(logSpread), ridges));
  };
  LeaveOneOutResult left = at(b - golden * (b - a)), right = at(a + golden * (b - a));
  for (int i = 2; i < refinements; ++i) {
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

std::vector<LeaveOneOutResult> onGrid(const RbfProblem& problem, const std::vector<double>& spreads,
                                      const std::vector<double>& ridges, const std::stop_token& stop) {
  std::vector<LeaveOneOutResult> results(spreads.size());
  inParallel(spreads.size(), [&](std::size_t i) {
    stopIfAsked(stop);
    results[i] = bestOf(problem.leaveOneOut(spreads[i], ridges));
  });
  return results;
}

} // namespace

std::vector<LeaveOneOutResult> leaveOneOut(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                                           const Eigen::Ref<const Eigen::MatrixXd>& targets,
                                           const std::vector<double>& spreads, const RbfOptions& options,
                                           const std::stop_token& stop) {
  requireUsable(samples, targets, options);
  for (const double spread : spreads)
    if (!(spread > 0 && spread <= 1e100))
      throw NetworkError("spread: " + std::to_string(spread) + "; allowed is above 0 up to 1e100");
  return onGrid(*rbfProblem(samples, targets, options, options.noiseCopies), spreads, ridgesOf(options), stop);
}

SpreadChoice chooseSpread(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                          const Eigen::Ref<const Eigen::MatrixXd>& targets, const RbfOptions& options,
                          const std::stop_token& stop) {
  requireUsable(samples, targets, options);
  const bool noisy = options.relativeInputNoise > 0;
  const std::unique_ptr<RbfProblem> problem =
      rbfProblem(samples, targets, options, std::min(options.noiseCopies, choiceCopies));
  const std::vector<double> spreads = spreadsFor(*problem, noisy);
  const std::vector<double> ridges = ridgesOf(options);
  SpreadChoice choice;
  choice.grid = onGrid(*problem, spreads, ridges, stop);
  std::size_t best = 0;
  for (std::size_t i = 1; i < spreads.size(); ++i)
    if (better(choice.grid[i], choice.grid[best])) best = i;
  for (Eigen::Index o = 0; o < targets.rows(); ++o) {
    const auto least = std::min_element(choice.grid.begin(), choice.grid.end(),
                                        [o](const auto& a, const auto& b) { return a.rms(o) < b.rms(o); });
    choice.spreadOfEachOutput.push_back(least->spread);
  }
  choice.overall = noisy ? choice.grid[best]
                         : refined(*problem, ridges, spreads[best == 0 ? 0 : best - 1],
                                   spreads[std::min(best + 1, spreads.size() - 1)], choice.grid[best], stop);
  return choice;
}

} // namespace palp
