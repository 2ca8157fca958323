#include "nn/RbfTrainer.h"

#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "nn/LeaveOneOut.h"
#include "nn/NetworkError.h"
#include "nn/SpreadSweep.h"
#include "nn/rbf/RbfSystem.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

namespace palp {
namespace {

/// Leave-one-out error against the targets' deviation beyond which a reader is warned.
constexpr double kPoorScore = 0.3;

/// The leave-one-out errors at the best of the ridges.
LeaveOneOutResult atBestRidge(const RbfSystem& system, double spread, const std::stop_token& stop) {
  std::vector<LeaveOneOutResult> results = system.leaveOneOut(spread, logarithmicRange(1e-13, 10, 29), stop);
  const auto best =
      std::min_element(results.begin(), results.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
  return std::move(*best);
}

void warn(FitReport& report, const RbfOptions& options, const RbfSystem& system, Eigen::Index samples) {
  if (options.centerCount > samples)
    report.warnings.push_back(std::to_string(options.centerCount) + " centres were requested for " +
                              std::to_string(samples) + " samples: one centre per sample is used");
  if (system.tail() != options.tail)
    report.warnings.push_back("too few samples (" + std::to_string(samples) +
                              ") for an exact linear tail: it is penalised instead");
  if (samples < 10)
    report.warnings.push_back("only " + std::to_string(samples) +
                              " samples: errors found in training do not predict errors on new samples");
}

/// What a reader may still do who trained with this.
std::string remedy(bool noise, bool ridge) {
  if (noise && ridge) return "another spread, more samples or ";
  return noise ? "a ridge, or with " : ridge ? "noise, or with " : "noise or a ridge, or with ";
}

} // namespace

RbfFit trainRbf(const Eigen::Ref<const Eigen::MatrixXd>& samples, const Eigen::Ref<const Eigen::MatrixXd>& targets,
                const RbfOptions& options, const std::stop_token& stop) {
  const auto start = std::chrono::steady_clock::now();
  requireUsable(samples, targets, options);
  RbfOptions chosen = options;
  if (!options.spread) {
    const SpreadChoice choice = chooseSpread(samples, targets, options, stop);
    chosen.spread = choice.overall.spread;
    chosen.whitening = choice.whitening;
  }
  const double spread = *chosen.spread;
  const std::unique_ptr<RbfSystem> system = rbfSystem(samples, targets, chosen, options.noiseCopies, stop);
  std::optional<LeaveOneOutResult> left;
  if (!options.ridge) left = atBestRidge(*system, spread, stop);
  throwIfStopped(stop);

  RbfSolution solution = system->solve(spread, left ? left->ridge : *options.ridge, stop);
  RbfFit fit;
  fit.network = {system->scaler(),         system->centers(),       spread,
                 options.convention,       solution.form,           std::move(solution.weights),
                 std::move(solution.tail), std::move(solution.bias)};
  if (!fit.network.weights.allFinite() || !fit.network.bias.allFinite() || !fit.network.tail.allFinite())
    throw NetworkError("the weights are not finite at spread " + shortText(spread) +
                       "; choose another solver, a larger ridge or another scaler");
  FitReport& report = fit.report;
  report.spread = spread;
  report.ridge = solution.ridge;
  report.centers = static_cast<int>(system->centers().cols());
  report.condition = solution.condition;
  report.rank = solution.rank;
  report.largestWeight = fit.network.weights.size() == 0 ? 0 : fit.network.weights.cwiseAbs().maxCoeff();
  report.warnings = std::move(solution.warnings);
  warn(report, options, *system, samples.cols());
  if (options.leaveOneOut) {
    // Cholesky may have raised the ridge to what double precision can carry.
    if (!left || std::abs(left->ridge - solution.ridge) > 1e-9 * solution.ridge)
      left = system->leaveOneOut(spread, {solution.ridge}, stop).front();
    report.leaveOneOut = left->rms;
    if (left->score > kPoorScore)
      report.warnings.push_back("the leave-one-out error is " +
                                std::to_string(std::lround(100 * std::min(left->score, 1e6))) +
                                " % of the targets' deviation: at this spread and ridge the network does not predict "
                                "new samples; train with " +
                                remedy(options.relativeInputNoise > 0, solution.ridge > 0) + "more inputs");
    if (left->indefinite && report.warnings.empty())
      report.warnings.push_back(
          "the leave-one-out errors are those of a larger ridge: with this one the system is not "
          "definite to rounding, and the network may do worse on new samples; train with a " +
          std::string(solution.ridge > 0 ? "larger " : "") +
          (options.tail == Tail::Linear ? "ridge or a smaller spread" : "ridge, a smaller spread or a linear tail"));
    report.leaveOneOutResiduals = std::move(left->residuals);
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return fit;
}

} // namespace palp
