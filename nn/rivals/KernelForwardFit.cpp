#include "nn/rivals/KernelInversion.h"

#include "model/base/Cancelled.h"
#include "model/base/Parallel.h"
#include "nn/NetworkError.h"
#include "nn/linear/Lapack.h"
#include "nn/linear/RandomNumbers.h"
#include "nn/rivals/PlaceKernel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <optional>

namespace palp {

namespace {

constexpr int kMostComponents = 160;
constexpr double kLeastSignal = 0.1;      // rms of a component that is kept, in standard deviations of the noise
constexpr Eigen::Index kHeldOut = 5;      // one of so many samples
constexpr Eigen::Index kMostStarts = 400; // samples kept for the inversion to begin at
constexpr Eigen::Index kMostTried = 2000; // samples on which widths are chosen
constexpr int kMostTerms = 60;
constexpr int kMostDegree = 4;
constexpr std::array kWidths{0.05, 0.07, 0.1, 0.14, 0.2, 0.3, 0.45}; // of the places' range
constexpr std::array kReaches{0.1, 0.3, 1.};                         // of each further degree's coefficients
constexpr std::array kSmoothings{1e-8, 1e-6, 1e-4, 1e-2}; // variance left to a sample, of the components' own
constexpr int kNodes = 50; // between the table's nodes along the longer range of the places, and what lies beyond
constexpr double kBeyondRange = 0.1; // of its range that a place may lie outside
constexpr double kRestVariance = 1;  // of what does not depend on the causes, in the components' own
constexpr const char* kNoFunction = "no smooth function goes through the samples: are some the same?";

/// Principal components of the measurements in units of their noise, the strongest first.
Eigen::MatrixXd projectionOf(const Eigen::MatrixXd& centred, const Eigen::VectorXd& noise) {
  const Eigen::MatrixXd scaled = noise.cwiseInverse().asDiagonal() * centred;
  const lapack::SymmetricEigen eigen =
      lapack::symmetricEigen(lapack::product(scaled, false, scaled, true) / static_cast<double>(scaled.cols()));
  Eigen::Index kept = 0;
  while (kept < std::min<Eigen::Index>(kMostComponents, scaled.rows()) &&
         eigen.values(scaled.rows() - 1 - kept) > kLeastSignal * kLeastSignal)
    ++kept;
  return eigen.vectors.rightCols(kept).rowwise().reverse().transpose() * noise.cwiseInverse().asDiagonal();
}

/// What leave-one-out chooses.
struct Smoothness {
  double width = kWidths[3]; ///< of the Gaussians over the places
  double reach = kReaches[1];
  double smoothing = kSmoothings[1];
};

/// The work of one fit: what all samples decide, then models of some of them. The components z of the causes c, with x
/// their places and m_j the monomials of the others, are a Gaussian process with the covariance
///   v0 + exp(-|x - x'|^2 / (2 width^2)) sum_j reach^(2 degree_j - 2) m_j m_j'
/// and its mean is a table's splines times monomials (C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for
/// Machine Learning, 2006, 2.2, 5.4.2).
class ForwardFit {
public:
  ForwardFit(const Eigen::MatrixXd& measurements, const Eigen::MatrixXd& causes, const Eigen::VectorXi& groups,
             const KernelForwardOptions& options, const std::stop_token& stop);
  void chooseSmoothness();
  [[nodiscard]] double width() const { return smoothness_.width * range_; }
  [[nodiscard]] KernelForwardModel modelOf(const std::vector<Eigen::Index>& samples) const;

private:
  struct Fitted {
    Eigen::MatrixXd weights;     ///< samples x components
    Eigen::MatrixXd leaveOneOut; ///< residuals, samples x components
  };
  [[nodiscard]] Eigen::MatrixXd placesOf(const std::vector<Eigen::Index>& samples) const;
  [[nodiscard]] Eigen::MatrixXd monomialsAt(const Eigen::MatrixXd& scaled, double reach) const;
  [[nodiscard]] std::optional<Fitted> fitted(const std::vector<Eigen::Index>& samples, const Smoothness& by) const;
  void placeNodes();
  void takeKnown();
  [[nodiscard]] Eigen::MatrixXd knownAt(const Eigen::MatrixXd& scaled) const;
  [[nodiscard]] Eigen::Vector2d node(int x, int y) const;
  [[nodiscard]] SplineTable tableOf(const std::vector<Eigen::Index>& samples, const Eigen::MatrixXd& weights) const;

  const KernelForwardOptions& options_;
  const std::stop_token& stop_;
  KernelForwardModel common_;        ///< less its table
  SplineTable form_;                 ///< without coefficients and rest
  std::vector<Eigen::Index> varied_; ///< causes
  SplineTable known_;                ///< what is known beforehand; without coefficients: nothing
  Eigen::MatrixXd scaled_;           ///< causes that vary x samples
  Eigen::MatrixXd components_;
  double range_ = 0; ///< largest of the places
  Smoothness smoothness_;
};

ForwardFit::ForwardFit(const Eigen::MatrixXd& measurements, const Eigen::MatrixXd& causes,
                       const Eigen::VectorXi& groups, const KernelForwardOptions& options, const std::stop_token& stop)
    : options_(options), stop_(stop) {
  const Eigen::VectorXd low = causes.rowwise().minCoeff(), high = causes.rowwise().maxCoeff();
  const Eigen::VectorXd range = high - low;
  common_.causeOffset = (low + high) / 2;
  common_.causeDeviation = range / std::sqrt(12.);
  common_.causeFactor = Eigen::VectorXd::Zero(range.size());
  std::vector<Eigen::Index> others;
  std::vector<double> shift;
  std::size_t places = 0;
  for (Eigen::Index k = 0; k < range.size(); ++k) {
    if (!(range(k) > 0)) continue;
    const auto input = static_cast<int>(varied_.size());
    varied_.push_back(k);
    if (groups(k) == 0) {
      if (places == 2) throw NetworkError("three causes of group 0 vary; allowed are two places");
      form_.place[places++] = input;
      common_.causeFactor(k) = 1;
      range_ = std::max(range_, range(k));
      shift.push_back(0);
      continue;
    }
    others.push_back(input);
    if (groups(k) == 1) common_.strengths.push_back(input);
    // A strength counts from 0, anything else from its middle; both reach about 1.
    const double size = groups(k) == 1 ? std::max(std::abs(low(k)), std::abs(high(k))) : range(k) / 2;
    common_.causeFactor(k) = 1 / size;
    shift.push_back(groups(k) == 1 ? common_.causeOffset(k) / size : 0);
  }
  if (places == 0) throw NetworkError("the causes of group 0 do not vary");
  form_.shift = Eigen::Map<Eigen::VectorXd>(shift.data(), static_cast<Eigen::Index>(shift.size()));
  int degree = kMostDegree;
  do form_.exponents = placeMonomials(form_.inputs(), others, common_.strengths, degree);
  while (form_.terms() > kMostTerms && --degree > 1);
  scaled_ = (common_.causeFactor.asDiagonal() * (causes.colwise() - common_.causeOffset))(varied_, Eigen::all);
  common_.measurementOffset = measurements.rowwise().mean();
  const Eigen::MatrixXd centred = measurements.colwise() - common_.measurementOffset;
  const Eigen::VectorXd size = measurements.array().square().rowwise().mean().sqrt();
  if (!(size.minCoeff() > 0)) throw NetworkError("a measurement is 0 in every sample");
  common_.projection = projectionOf(centred, std::max(options.relativeNoise, leastTouchNoise) * size);
  if (common_.projection.rows() == 0) throw NetworkError("no measurement stands out of the noise");
  components_ = common_.projection * centred;
  placeNodes();
  if (options.known) takeKnown();
}

/// Over the range of the places and what may lie beyond.
void ForwardFit::placeNodes() {
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const int input = form_.place[static_cast<std::size_t>(axis)];
    if (input < 0) continue;
    const double low = scaled_.row(input).minCoeff(), high = scaled_.row(input).maxCoeff();
    const double from = low - kBeyondRange * (high - low), to = high + kBeyondRange * (high - low);
    const int steps = std::clamp(static_cast<int>(std::ceil(kNodes * (high - low) / range_)), 1, kNodes);
    form_.step(axis) = (to - from) / steps;
    form_.low(axis) = from - form_.step(axis);
    form_.nodes[static_cast<std::size_t>(axis)] = steps + 3;
  }
}

/// Scaled places of a node; 0 where there is none.
Eigen::Vector2d ForwardFit::node(int x, int y) const {
  return {form_.place[0] < 0 ? 0 : form_.low(0) + x * form_.step(0),
          form_.place[1] < 0 ? 0 : form_.low(1) + y * form_.step(1)};
}

/// The known measurements as a table of the same form: at each node the monomials that fit them best on a grid of the
/// other causes' ranges. The components keep what it leaves.
void ForwardFit::takeKnown() {
  // The grid of the other causes: so many levels each that the monomials are determined.
  std::vector<Eigen::Index> others;
  for (Eigen::Index k = 0; k < scaled_.rows(); ++k)
    if (k != form_.place[0] && k != form_.place[1]) others.push_back(k);
  const int levels = others.size() <= 2 ? kMostDegree + 1 : 3;
  Eigen::Index count = 1;
  for (std::size_t k = 0; k < others.size(); ++k) count *= levels;
  Eigen::MatrixXd grid(scaled_.rows(), count);
  grid.setZero();
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Index rest = i;
    for (const Eigen::Index k : others) {
      const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * (static_cast<double>(rest % levels) + 0.5) / levels);
      const double low = scaled_.row(k).minCoeff(), high = scaled_.row(k).maxCoeff();
      grid(k, i) = low + share * (high - low);
      rest /= levels;
    }
  }
  known_ = form_;
  known_.rest = Eigen::VectorXd::Zero(common_.projection.rows());
  const Eigen::MatrixXd terms = monomialsAt(grid, 1);
  const Eigen::MatrixXd solver =
      terms.transpose() *
      (terms * terms.transpose() + 1e-12 * terms.squaredNorm() * Eigen::MatrixXd::Identity(terms.rows(), terms.rows()))
          .llt()
          .solve(Eigen::MatrixXd::Identity(terms.rows(), terms.rows()));
  Eigen::MatrixXd values(common_.projection.rows(), known_.terms() * known_.nodes[0] * known_.nodes[1]);
  const Eigen::VectorXd rest = knownAt(Eigen::MatrixXd::Zero(0, 0)).col(0);
  for (int y = 0; y < known_.nodes[1]; ++y) { // a line of nodes at once
    stopIfAsked(stop_);
    Eigen::MatrixXd at(scaled_.rows(), count * known_.nodes[0]);
    for (int x = 0; x < known_.nodes[0]; ++x) {
      at.middleCols(count * x, count) = grid;
      for (std::size_t axis = 0; axis < 2; ++axis)
        if (known_.place[axis] >= 0)
          at.row(known_.place[axis]).segment(count * x, count).setConstant(node(x, y)(static_cast<Eigen::Index>(axis)));
    }
    const Eigen::MatrixXd found = knownAt(at).colwise() - rest;
    for (int x = 0; x < known_.nodes[0]; ++x)
      values.middleCols(known_.terms() * (x + Eigen::Index(known_.nodes[0]) * y), known_.terms()) =
          found.middleCols(count * x, count) * solver;
  }
  known_.interpolate(std::move(values));
  known_.rest = rest;
  Eigen::VectorXd value;
  Eigen::MatrixXd slope;
  for (Eigen::Index i = 0; i < components_.cols(); ++i) {
    known_.evaluate(scaled_.col(i), value, slope);
    components_.col(i) -= value;
  }
}

/// Components of what is known at scaled causes; where none are given of the rest, all strengths 0.
Eigen::MatrixXd ForwardFit::knownAt(const Eigen::MatrixXd& scaled) const {
  const bool rest = scaled.size() == 0;
  Eigen::MatrixXd causes = common_.causeOffset.replicate(1, rest ? 1 : scaled.cols());
  for (std::size_t k = 0; k < varied_.size(); ++k) {
    const auto input = static_cast<Eigen::Index>(k);
    if (!rest) causes.row(varied_[k]) += scaled.row(input) / common_.causeFactor(varied_[k]);
  }
  if (rest)
    for (const int input : common_.strengths) causes(varied_[static_cast<std::size_t>(input)], 0) = 0;
  return common_.projection * (options_.known(causes).colwise() - common_.measurementOffset);
}

Eigen::MatrixXd ForwardFit::placesOf(const std::vector<Eigen::Index>& samples) const {
  Eigen::MatrixXd places = Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(samples.size()));
  for (Eigen::Index axis = 0; axis < 2; ++axis)
    if (const int input = form_.place[static_cast<std::size_t>(axis)]; input >= 0)
      for (std::size_t i = 0; i < samples.size(); ++i)
        places(axis, static_cast<Eigen::Index>(i)) = scaled_(input, samples[i]);
  return places;
}

/// Terms x columns, each by the power of the reach that its degree has.
Eigen::MatrixXd ForwardFit::monomialsAt(const Eigen::MatrixXd& scaled, double reach) const {
  Eigen::MatrixXd all(form_.terms(), scaled.cols());
  const int least = common_.strengths.empty() ? 0 : 1;
  for (Eigen::Index j = 0; j < form_.terms(); ++j) {
    Eigen::ArrayXd value =
        Eigen::ArrayXd::Constant(scaled.cols(), std::pow(reach, form_.exponents.col(j).sum() - least));
    for (Eigen::Index k = 0; k < form_.inputs(); ++k)
      for (int power = 0; power < form_.exponents(k, j); ++power)
        value *= scaled.row(k).transpose().array() + form_.shift(k);
    all.row(j) = value.transpose();
  }
  return all;
}

/// None where the system is singular to rounding. Residuals by S. Sundararajan and S. S. Keerthi, 2001.
std::optional<ForwardFit::Fitted> ForwardFit::fitted(const std::vector<Eigen::Index>& samples,
                                                     const Smoothness& by) const {
  const Eigen::MatrixXd places = placesOf(samples), terms = monomialsAt(scaled_(Eigen::all, samples), by.reach);
  Eigen::MatrixXd system = gaussians(places, places, by.width * range_);
  system.array() *= lapack::product(terms, true, terms, false).array();
  system.array() += kRestVariance;
  system.diagonal().array() += by.smoothing;
  stopIfAsked(stop_);
  if (!lapack::choleskyInPlace(system)) return {};
  stopIfAsked(stop_);
  lapack::invertLowerInPlace(system);
  system.triangularView<Eigen::StrictlyUpper>().setZero();
  stopIfAsked(stop_);
  const Eigen::MatrixXd targets = components_(Eigen::all, samples).transpose();
  Fitted result;
  result.weights = lapack::product(system, true, lapack::product(system, false, targets, false), false);
  const Eigen::VectorXd inverseDiagonal = system.colwise().squaredNorm();
  result.leaveOneOut = inverseDiagonal.cwiseInverse().asDiagonal() * result.weights;
  return result;
}

void ForwardFit::chooseSmoothness() {
  std::vector<Eigen::Index> tried(static_cast<std::size_t>(std::min(kMostTried, components_.cols())));
  std::iota(tried.begin(), tried.end(), Eigen::Index(0));
  double best = INFINITY;
  const auto tryOne = [&](const Smoothness& by) {
    const std::optional<Fitted> found = fitted(tried, by);
    const double error = found ? found->leaveOneOut.squaredNorm() : INFINITY;
    if (!(error < best)) return;
    best = error;
    smoothness_ = by;
  };
  const auto along = [&](double Smoothness::*number, const auto& values) {
    for (const double value : values)
      if (Smoothness by = smoothness_; by.*number != value) {
        by.*number = value;
        tryOne(by);
      }
  };
  tryOne(smoothness_);
  for (int round = 0; round < 2; ++round) {
    const double before = best;
    along(&Smoothness::width, kWidths);
    along(&Smoothness::reach, kReaches);
    along(&Smoothness::smoothing, kSmoothings);
    if (!(best < 0.98 * before)) break;
  }
  if (!std::isfinite(best)) throw NetworkError(kNoFunction);
}

SplineTable ForwardFit::tableOf(const std::vector<Eigen::Index>& samples, const Eigen::MatrixXd& weights) const {
  SplineTable table = form_;
  const Eigen::MatrixXd places = placesOf(samples);
  // The covariance's monomials at the samples, times the part of those at the table that is no monomial.
  Eigen::MatrixXd terms = monomialsAt(scaled_(Eigen::all, samples), smoothness_.reach);
  const int least = common_.strengths.empty() ? 0 : 1;
  for (Eigen::Index j = 0; j < table.terms(); ++j)
    terms.row(j) *= std::pow(smoothness_.reach, table.exponents.col(j).sum() - least);
  Eigen::MatrixXd values(weights.cols(), table.terms() * table.nodes[0] * table.nodes[1]);
  inParallel(static_cast<std::size_t>(table.nodes[1]), options_.threads, [&](std::size_t line) {
    if (stop_.stop_requested()) return;
    const auto y = static_cast<int>(line);
    Eigen::MatrixXd nodes(2, table.nodes[0]);
    for (int x = 0; x < table.nodes[0]; ++x) nodes.col(x) = node(x, y);
    const Eigen::MatrixXd shares = gaussians(places, nodes, width()); // samples x nodes
    for (Eigen::Index j = 0; j < table.terms(); ++j) {
      const Eigen::MatrixXd ofTerm = weights.transpose() * (terms.row(j).transpose().asDiagonal() * shares);
      for (int x = 0; x < table.nodes[0]; ++x)
        values.col(j + table.terms() * (x + Eigen::Index(table.nodes[0]) * y)) = ofTerm.col(x);
    }
  });
  stopIfAsked(stop_);
  table.interpolate(std::move(values));
  table.rest = kRestVariance * weights.colwise().sum().transpose();
  if (known_.coefficients.size() > 0) {
    table.coefficients += known_.coefficients;
    table.rest += known_.rest;
  }
  table.round(); // short in its file
  return table;
}

KernelForwardModel ForwardFit::modelOf(const std::vector<Eigen::Index>& samples) const {
  KernelForwardModel model = common_;
  const std::optional<Fitted> found = fitted(samples, smoothness_);
  if (!found) throw NetworkError(kNoFunction);
  model.table = tableOf(samples, found->weights);
  const Eigen::Index starts = std::min<Eigen::Index>(kMostStarts, static_cast<Eigen::Index>(samples.size()));
  model.starts = scaled_(Eigen::all, samples).leftCols(starts);
  const double noise = options_.relativeNoise > 0 ? 1 : 0;
  model.deviation = (noise + found->leaveOneOut.array().square().colwise().mean()).sqrt().cwiseMax(1e-12);
  model.inflation = Eigen::VectorXd::Ones(model.causes());
  return model;
}

/// What this share of the sizes lies below: 0.683 is one standard deviation of normal ones.
double quantile(double share, std::vector<double> sizes) {
  if (sizes.empty()) return 1;
  const auto there = sizes.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sizes.size()));
  std::nth_element(sizes.begin(), there, sizes.end());
  return *there;
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
  work.chooseSmoothness();
  KernelForwardFit result;
  result.width = work.width();
  std::vector<Eigen::Index> rest, all(static_cast<std::size_t>(causes.cols()));
  std::iota(all.begin(), all.end(), Eigen::Index(0));
  for (const Eigen::Index i : all) (i % kHeldOut == kHeldOut - 1 ? result.heldOut : rest).push_back(i);
  // How far the deviations can be trusted: by samples that the model has not seen.
  const KernelForwardModel some = work.modelOf(rest);
  const KernelInversion inversion(some);
  RandomNumbers random(1);
  result.heldOutResiduals.resize(causes.rows(), static_cast<Eigen::Index>(result.heldOut.size()));
  std::vector<double> left;
  std::vector<std::vector<double>> sizes(static_cast<std::size_t>(causes.rows()));
  for (std::size_t i = 0; i < result.heldOut.size(); ++i) {
    if (stop.stop_requested()) throw Cancelled();
    const Eigen::VectorXd truth = causes.col(result.heldOut[i]);
    Eigen::VectorXd reading = measurements.col(result.heldOut[i]);
    for (double& value : reading) value *= 1 + options.relativeNoise * random.normal(); // as they will come
    const KernelEstimate estimate = inversion.estimate(reading);
    left.push_back(estimate.chiSquare);
    const Eigen::VectorXd off = result.heldOutResiduals.col(static_cast<Eigen::Index>(i)) = truth - estimate.causes;
    for (Eigen::Index k = 0; k < off.size(); ++k)
      if (estimate.standardDeviation(k) > 0)
        sizes[static_cast<std::size_t>(k)].push_back(std::abs(off(k)) / estimate.standardDeviation(k));
  }
  result.model = work.modelOf(all);
  result.model.leftByOne = quantile(0.99, std::move(left));
  for (std::size_t k = 0; k < sizes.size(); ++k)
    result.model.inflation(static_cast<Eigen::Index>(k)) = quantile(0.683, std::move(sizes[k]));
  return result;
}

} // namespace palp
