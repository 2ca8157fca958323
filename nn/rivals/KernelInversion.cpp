#include "nn/rivals/KernelInversion.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/RbfTrainer.h"
#include "nn/linear/RandomNumbers.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace palp {

namespace {

constexpr int kMostComponents = 48;
constexpr double kLeastSignal = 0.3;          // rms of a component that is kept, in standard deviations of the noise
constexpr double kLeastNoise = 1e-6;          // relative: what the solver's own tolerance leaves
constexpr Eigen::Index kTried = 500;          // samples on which the groups' shares are chosen
constexpr std::array kShares{0.1, 0.25, 0.6}; // of group 0's range
constexpr int kStarts = 6;
constexpr Eigen::Index kHeldOut = 5; // one of so many samples
constexpr int kMostSteps = 20;
constexpr double kSmallStep = 1e-4; // of the spread
constexpr double kBeyond = 0.1;     // of its range that a cause may lie outside

RbfOptions networkOptions(int threads) {
  RbfOptions options;
  options.scaling = Scaling::Raw;
  options.tail = Tail::Linear;
  options.threads = threads;
  return options;
}

/// Principal components of the measurements in units of their noise, the strongest first.
Eigen::MatrixXd projectionOf(const Eigen::MatrixXd& centred, const Eigen::VectorXd& noise) {
  const Eigen::MatrixXd scaled = noise.cwiseInverse().asDiagonal() * centred;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled * scaled.transpose() /
                                                             static_cast<double>(scaled.cols()));
  Eigen::Index kept = 0;
  while (kept < std::min<Eigen::Index>(kMostComponents, scaled.rows()) &&
         eigen.eigenvalues()(scaled.rows() - 1 - kept) > kLeastSignal * kLeastSignal)
    ++kept;
  return eigen.eigenvectors().rightCols(kept).rowwise().reverse().transpose() * noise.cwiseInverse().asDiagonal();
}

} // namespace

namespace {

/// The work of one fit: what all samples decide, then models of some of them.
class ForwardFit {
public:
  ForwardFit(const Eigen::MatrixXd& measurements, const Eigen::MatrixXd& causes, const Eigen::VectorXi& groups,
             const KernelForwardOptions& options, const std::stop_token& stop);
  /// How far the groups count: of each as little as may be, then one after the other by leave-one-out.
  void chooseShares();
  [[nodiscard]] KernelForwardModel modelOf(const std::vector<Eigen::Index>& samples,
                                           std::vector<std::string>* warnings);

private:
  [[nodiscard]] Eigen::VectorXd factors() const;
  [[nodiscard]] Eigen::MatrixXd scaledCauses(const std::vector<Eigen::Index>& samples) const;

  const Eigen::MatrixXd& causes_;
  const Eigen::VectorXi& groups_;
  const KernelForwardOptions& options_;
  const std::stop_token& stop_;
  KernelForwardModel common_; ///< less its network
  Eigen::MatrixXd components_;
  Eigen::VectorXd range_;
  double reference_ = 0; ///< largest range of group 0
  std::vector<Eigen::Index> varied_;
  std::vector<double> share_; ///< of each group
};

ForwardFit::ForwardFit(const Eigen::MatrixXd& measurements, const Eigen::MatrixXd& causes,
                       const Eigen::VectorXi& groups, const KernelForwardOptions& options, const std::stop_token& stop)
    : causes_(causes), groups_(groups), options_(options), stop_(stop) {
  const Eigen::VectorXd low = causes.rowwise().minCoeff(), high = causes.rowwise().maxCoeff();
  range_ = high - low;
  for (Eigen::Index k = 0; k < range_.size(); ++k) {
    if (range_(k) > 0) varied_.push_back(k);
    if (groups(k) == 0) reference_ = std::max(reference_, range_(k));
  }
  if (!(reference_ > 0)) throw NetworkError("the causes of group 0 do not vary");
  share_.assign(static_cast<std::size_t>(groups.maxCoeff()) + 1, kShares[0]);
  common_.causeOffset = (low + high) / 2;
  common_.causeDeviation = range_ / std::sqrt(12.);
  common_.measurementOffset = measurements.rowwise().mean();
  const Eigen::MatrixXd centred = measurements.colwise() - common_.measurementOffset;
  const Eigen::VectorXd size = measurements.array().square().rowwise().mean().sqrt();
  if (!(size.minCoeff() > 0)) throw NetworkError("a measurement is 0 in every sample");
  common_.projection = projectionOf(centred, std::max(options.relativeNoise, kLeastNoise) * size);
  if (common_.projection.rows() == 0) throw NetworkError("no measurement stands out of the noise");
  components_ = common_.projection * centred;
}

Eigen::VectorXd ForwardFit::factors() const {
  Eigen::VectorXd factor = Eigen::VectorXd::Zero(range_.size());
  for (const Eigen::Index k : varied_)
    factor(k) = groups_(k) == 0 ? 1 : share_[static_cast<std::size_t>(groups_(k))] * reference_ / range_(k);
  return factor;
}

Eigen::MatrixXd ForwardFit::scaledCauses(const std::vector<Eigen::Index>& samples) const {
  const Eigen::MatrixXd all = factors().asDiagonal() * (causes_.colwise() - common_.causeOffset);
  return all(varied_, samples);
}

void ForwardFit::chooseShares() {
  std::vector<Eigen::Index> tried(static_cast<std::size_t>(std::min(kTried, causes_.cols())));
  std::iota(tried.begin(), tried.end(), Eigen::Index(0));
  const Eigen::MatrixXd targets = components_(Eigen::all, tried);
  for (std::size_t group = 1; group < share_.size(); ++group) {
    double best = INFINITY, chosen = share_[group];
    for (const double candidate : kShares) {
      share_[group] = candidate;
      const RbfFit fit = trainRbf(scaledCauses(tried), targets, networkOptions(options_.threads), stop_);
      const double error = fit.report.leaveOneOut.squaredNorm();
      if (error < best) {
        best = error;
        chosen = candidate;
      }
    }
    share_[group] = chosen;
  }
}

KernelForwardModel ForwardFit::modelOf(const std::vector<Eigen::Index>& samples, std::vector<std::string>* warnings) {
  KernelForwardModel model = common_;
  model.causeFactor = factors();
  RbfFit fit =
      trainRbf(scaledCauses(samples), components_(Eigen::all, samples), networkOptions(options_.threads), stop_);
  if (stop_.stop_requested()) throw Cancelled();
  model.network = std::move(fit.network);
  const double noise = options_.relativeNoise > 0 ? 1 : 0;
  model.deviation = (noise + fit.report.leaveOneOut.array().square()).sqrt().cwiseMax(1e-12);
  model.inflation = Eigen::VectorXd::Ones(model.causes());
  if (warnings) *warnings = std::move(fit.report.warnings);
  return model;
}

/// What 68.3 % of the sizes lie below: one standard deviation of normal ones.
double oneDeviation(std::vector<double> sizes) {
  if (sizes.empty()) return 1;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(0.683 * static_cast<double>(sizes.size()));
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

} // namespace

KernelForwardFit fitKernelForwardModel(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                                       const Eigen::Ref<const Eigen::MatrixXd>& causes, const Eigen::VectorXi& groups,
                                       const KernelForwardOptions& options, const std::stop_token& stop) {
  if (measurements.cols() != causes.cols() || causes.rows() != groups.size() || causes.cols() < kHeldOut)
    throw NetworkError(std::to_string(causes.cols()) + " samples; a forward model of touches needs " +
                       std::to_string(kHeldOut) + " or more, a column of causes for each");
  const Eigen::MatrixXd allMeasurements = measurements, allCauses = causes;
  ForwardFit work(allMeasurements, allCauses, groups, options, stop);
  work.chooseShares();
  KernelForwardFit result;
  std::vector<Eigen::Index> rest, all;
  for (Eigen::Index i = 0; i < causes.cols(); ++i) {
    (i % kHeldOut == kHeldOut - 1 ? result.heldOut : rest).push_back(i);
    all.push_back(i);
  }
  // How far the deviations can be trusted: by samples that the model has not seen.
  const KernelForwardModel some = work.modelOf(rest, nullptr);
  const KernelInversion inversion(some);
  RandomNumbers random(1);
  result.heldOutResiduals.resize(causes.rows(), static_cast<Eigen::Index>(result.heldOut.size()));
  std::vector<std::vector<double>> sizes(static_cast<std::size_t>(causes.rows()));
  for (std::size_t i = 0; i < result.heldOut.size(); ++i) {
    if (stop.stop_requested()) throw Cancelled();
    const Eigen::VectorXd truth = causes.col(result.heldOut[i]);
    Eigen::VectorXd reading = measurements.col(result.heldOut[i]);
    for (double& value : reading) value *= 1 + options.relativeNoise * random.normal(); // as they will come
    const KernelEstimate estimate = inversion.estimate(reading);
    const Eigen::VectorXd off = truth - estimate.causes;
    result.heldOutResiduals.col(static_cast<Eigen::Index>(i)) = off;
    for (Eigen::Index k = 0; k < off.size(); ++k)
      if (estimate.standardDeviation(k) > 0)
        sizes[static_cast<std::size_t>(k)].push_back(std::abs(off(k)) / estimate.standardDeviation(k));
  }
  result.model = work.modelOf(all, &result.warnings);
  for (std::size_t k = 0; k < sizes.size(); ++k)
    result.model.inflation(static_cast<Eigen::Index>(k)) = oneDeviation(std::move(sizes[k]));
  return result;
}

struct KernelInversion::Trial {
  Eigen::VectorXd scaled;
  Eigen::VectorXd left; ///< weighted
  Eigen::MatrixXd information;
  double cost = INFINITY;
};

KernelInversion::KernelInversion(const KernelForwardModel& model)
    : model_(model), weight_(model.deviation.cwiseInverse()) {
  for (Eigen::Index k = 0; k < model.causes(); ++k)
    if (model.causeFactor(k) != 0) varied_.push_back(k);
  precision_ = (model.causeFactor.array() * model.causeDeviation.array())(varied_).square().inverse();
  starts_ = model.network.centers;
  expected_ = weight_.asDiagonal() * model.network.predict(starts_);
}

double KernelInversion::cost(const Eigen::VectorXd& left, const Eigen::VectorXd& scaled) const {
  return left.squaredNorm() + precision_.dot(scaled.cwiseAbs2());
}

KernelInversion::Trial KernelInversion::descend(const Eigen::VectorXd& start, const Eigen::VectorXd& wanted) const {
  const Eigen::VectorXd most = (1 + 2 * kBeyond) * std::sqrt(12.) / 2 * precision_.cwiseInverse().cwiseSqrt();
  const auto leftAt = [&](const Eigen::VectorXd& scaled) -> Eigen::VectorXd {
    return wanted - weight_.cwiseProduct(model_.network.predict(scaled));
  };
  Trial now{start, leftAt(start), {}, 0};
  now.cost = cost(now.left, now.scaled);
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd slope = weight_.asDiagonal() * model_.network.jacobian(now.scaled);
    now.information = slope.transpose() * slope;
    now.information.diagonal() += precision_;
    const Eigen::VectorXd uphill = slope.transpose() * now.left - precision_.cwiseProduct(now.scaled);
    bool better = false;
    double moved = 0;
    for (int tries = 0; tries < 6 && !better; ++tries) {
      Eigen::MatrixXd damped = now.information;
      damped.diagonal() *= 1 + damping;
      const Eigen::VectorXd next = (now.scaled + damped.llt().solve(uphill)).cwiseMin(most).cwiseMax(-most);
      const Eigen::VectorXd left = leftAt(next);
      const double found = cost(left, next);
      better = found < now.cost;
      damping = better ? damping / 8 : 10 * damping;
      if (!better) continue;
      moved = (next - now.scaled).norm();
      now.scaled = next;
      now.left = left;
      now.cost = found;
    }
    if (!better || moved < kSmallStep * model_.network.spread) break;
  }
  return now;
}

KernelEstimate KernelInversion::estimate(const Eigen::Ref<const Eigen::VectorXd>& measurement) const {
  const Eigen::VectorXd wanted = weight_.cwiseProduct(model_.projection * (measurement - model_.measurementOffset));
  const Eigen::VectorXd far = (expected_.colwise() - wanted).colwise().squaredNorm();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(far.size()));
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  const auto starts = std::min<std::ptrdiff_t>(kStarts, far.size());
  std::partial_sort(order.begin(), order.begin() + starts, order.end(),
                    [&](Eigen::Index a, Eigen::Index b) { return far(a) < far(b) || (far(a) == far(b) && a < b); });
  Trial best;
  for (std::ptrdiff_t i = 0; i < starts; ++i) {
    Trial trial = descend(starts_.col(order[static_cast<std::size_t>(i)]), wanted);
    if (i == 0 || trial.cost < best.cost) best = std::move(trial);
    if (best.left.squaredNorm() < 2 * static_cast<double>(best.left.size())) break; // explained: no other is needed
  }
  KernelEstimate estimate;
  estimate.causes = model_.causeOffset;
  estimate.standardDeviation = Eigen::VectorXd::Zero(model_.causes());
  const Eigen::MatrixXd covariance =
      best.information.llt().solve(Eigen::MatrixXd::Identity(best.information.rows(), best.information.cols()));
  for (std::size_t k = 0; k < varied_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double factor = model_.causeFactor(varied_[k]);
    estimate.causes(varied_[k]) += best.scaled(i) / factor;
    estimate.standardDeviation(varied_[k]) = model_.inflation(varied_[k]) * std::sqrt(covariance(i, i)) / factor;
  }
  estimate.chiSquare = best.left.squaredNorm() / static_cast<double>(best.left.size());
  return estimate;
}

} // namespace palp
