#include "nn/inversion/ForwardProcess.h"

#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/Parallel.h"
#include "nn/NetworkError.h"
#include "nn/inversion/PlaceKernel.h"
#include "nn/inversion/PriorTable.h"
#include "nn/linear/Lapack.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace palp {

namespace {

constexpr int kMostComponents = 160;
constexpr double kLeastSignal = 0.1; // rms of a component that is kept, in standard deviations of the noise
constexpr Eigen::Index kMostInitialGuesses = 400; // samples kept as initial guesses
constexpr Eigen::Index kMostTried = 2000;         // samples on which widths are chosen
constexpr int kMostTerms = 60;
constexpr int kMostDegree = 4;
constexpr std::array kWidths{0.05, 0.07, 0.1, 0.14, 0.2, 0.3, 0.45}; // share of the positions' range
constexpr std::array kDecays{0.1, 0.3, 1.};                          // of the coefficients from one degree to the next
constexpr std::array kSmoothings{1e-8, 1e-6, 1e-4,
                                 1e-2}; // variance of a sample's own error, relative to the components'
/// Intervals of the table along the longer range of the positions; of many samples, which resolve shorter lengths.
constexpr int kNodes = 50, kNodesOfMany = 80;
constexpr double kBeyondRange = 0.1; // share of its range by which a position may exceed it
constexpr double kRestVariance = 1;  // of the part that does not depend on the parameters, relative to the components'
constexpr const char* kNoFunction = "no smooth function interpolates the samples; check for duplicates";

} // namespace

ForwardProcess::ForwardProcess(const Eigen::MatrixXd& measurements, const Eigen::MatrixXd& parameters,
                               const Eigen::VectorXi& groups, const KernelForwardOptions& options,
                               const std::stop_token& stop)
    : options_(options), stop_(stop), mirrors_(options.mirrors, measurements.rows(), parameters.rows()) {
  const Eigen::VectorXd low = parameters.rowwise().minCoeff(), high = parameters.rowwise().maxCoeff();
  const Eigen::VectorXd range = high - low;
  common_.parameterOffset = (low + high) / 2;
  common_.parameterDeviation = range / std::sqrt(12.);
  common_.parameterFactor = Eigen::VectorXd::Zero(range.size());
  std::vector<Eigen::Index> others;
  std::vector<double> shift;
  std::size_t places = 0;
  for (Eigen::Index k = 0; k < range.size(); ++k) {
    if (!(range(k) > 0)) continue;
    const auto input = static_cast<int>(varied_.size());
    varied_.push_back(k);
    if (groups(k) == 0) {
      if (places == 2)
        throw NetworkError("varying parameters of group 0: " + gotExpected("3", "2 coordinates of the position"));
      form_.place[places++] = input;
      common_.parameterFactor(k) = 1;
      range_ = std::max(range_, range(k));
      shift.push_back(0);
      continue;
    }
    others.push_back(input);
    if (groups(k) == 1) common_.amplitudes.push_back(input);
    // A amplitude counts from 0, anything else from its middle; both decay about 1.
    const double size = groups(k) == 1 ? std::max(std::abs(low(k)), std::abs(high(k))) : range(k) / 2;
    common_.parameterFactor(k) = 1 / size;
    shift.push_back(groups(k) == 1 ? common_.parameterOffset(k) / size : 0);
  }
  if (places == 0) throw NetworkError("the parameters of group 0 (the position) do not vary");
  form_.shift = Eigen::Map<Eigen::VectorXd>(shift.data(), static_cast<Eigen::Index>(shift.size()));
  int degree = kMostDegree;
  do form_.exponents = placeMonomials(form_.inputs(), others, common_.amplitudes, degree);
  while (form_.terms() > kMostTerms && --degree > 1);
  for (int element = 0; element < mirrors_.size(); ++element) {
    const Eigen::MatrixXd image = mirrors_.image(parameters, element);
    for (Eigen::Index k = 0; k < range.size(); ++k)
      if (range(k) == 0 && image(k, 0) != parameters(k, 0))
        throw NetworkError("a mirror reflects a parameter that does not vary, to values that no sample has");
    images_.push_back(
        (common_.parameterFactor.asDiagonal() * (image.colwise() - common_.parameterOffset))(varied_, Eigen::all));
  }
  // Mirrors leave the mean of all samples and their images as it is, and the noise.
  common_.measurementOffset = mirrors_.part(measurements.rowwise().mean(), 0);
  const Eigen::VectorXd size = mirrors_.part(measurements.array().square().rowwise().mean(), 0).cwiseSqrt();
  if (!(size.minCoeff() > 0)) throw NetworkError("a measurement is 0 in every sample");
  const Eigen::MatrixXd centred = measurements.colwise() - common_.measurementOffset;
  project(centred, std::max(options.relativeNoise, leastTouchNoise) * size);
  components_ = common_.projection * centred;
  placeNodes();
  if (options.priorMean) subtractPrior();
}

/// Principal components of the measurements in units of their noise, those of each parity adjacent, the strongest
/// first.
void ForwardProcess::project(const Eigen::MatrixXd& centred, const Eigen::VectorXd& noise) {
  std::vector<lapack::SymmetricEigen> found;
  std::vector<double> signals;
  for (int parity = 0; parity < mirrors_.size(); ++parity) {
    const Eigen::MatrixXd scaled = noise.cwiseInverse().asDiagonal() * mirrors_.part(centred, parity);
    found.push_back(
        lapack::symmetricEigen(lapack::product(scaled, false, scaled, true) / static_cast<double>(scaled.cols())));
    for (const double value : found.back().values)
      if (value > kLeastSignal * kLeastSignal) signals.push_back(value);
  }
  if (signals.empty()) throw NetworkError("no measurement exceeds the noise");
  std::sort(signals.begin(), signals.end(), std::greater());
  const double least = signals[std::min<std::size_t>(kMostComponents, signals.size()) - 1];
  common_.projection.resize(0, noise.size());
  for (int parity = 0; parity < mirrors_.size(); ++parity) {
    const auto& [values, vectors] = found[static_cast<std::size_t>(parity)];
    const auto kept = static_cast<Eigen::Index>(
        std::count_if(values.begin(), values.end(), [&](double value) { return value >= least; }));
    const Eigen::Index from = common_.projection.rows();
    common_.projection.conservativeResize(from + kept, Eigen::NoChange);
    common_.projection.bottomRows(kept) =
        vectors.rightCols(kept).rowwise().reverse().transpose() * noise.cwiseInverse().asDiagonal();
    if (kept > 0) parts_.push_back({parity, from, kept});
  }
}

/// Nodes over the range of the positions and a margin.
void ForwardProcess::placeNodes() {
  const int most = images_[0].cols() < manyTouchSamples ? kNodes : kNodesOfMany;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const int input = form_.place[static_cast<std::size_t>(axis)];
    if (input < 0) continue;
    const double low = images_[0].row(input).minCoeff(), high = images_[0].row(input).maxCoeff();
    const double from = low - kBeyondRange * (high - low), to = high + kBeyondRange * (high - low);
    const int steps = std::clamp(static_cast<int>(std::ceil(most * (high - low) / range_)), 1, most);
    form_.step(axis) = (to - from) / steps;
    form_.low(axis) = from - form_.step(axis);
    form_.nodes[static_cast<std::size_t>(axis)] = steps + 3;
  }
}

/// Stores the prior mean as a table of the same form and subtracts it from the components.
void ForwardProcess::subtractPrior() {
  const auto prior = [this](const Eigen::MatrixXd& scaled) { return priorAt(scaled); };
  prior_ = priorTable(form_, common_.amplitudes, images_[0], prior, stop_);
  Eigen::VectorXd value;
  Eigen::MatrixXd slope;
  for (Eigen::Index i = 0; i < components_.cols(); ++i) {
    prior_.evaluate(images_[0].col(i), value, slope);
    components_.col(i) -= value;
  }
}

/// Components of the prior mean at scaled parameters.
Eigen::MatrixXd ForwardProcess::priorAt(const Eigen::MatrixXd& scaled) const {
  Eigen::MatrixXd parameters = common_.parameterOffset.replicate(1, scaled.cols());
  for (std::size_t k = 0; k < varied_.size(); ++k)
    parameters.row(varied_[k]) += scaled.row(static_cast<Eigen::Index>(k)) / common_.parameterFactor(varied_[k]);
  return common_.projection * (options_.priorMean(parameters).colwise() - common_.measurementOffset);
}

Eigen::MatrixXd ForwardProcess::placesOf(const Eigen::MatrixXd& scaled) const {
  Eigen::MatrixXd places = Eigen::MatrixXd::Zero(2, scaled.cols());
  for (Eigen::Index axis = 0; axis < 2; ++axis)
    if (const int input = form_.place[static_cast<std::size_t>(axis)]; input >= 0) places.row(axis) = scaled.row(input);
  return places;
}

/// Covariances between the samples and their images, for each product of mirrors; without v0.
std::vector<Eigen::MatrixXd> ForwardProcess::covariances(const std::vector<Eigen::Index>& samples,
                                                         const Smoothness& by) const {
  std::vector<Eigen::MatrixXd> result;
  Eigen::MatrixXd places, terms;
  for (std::size_t element = 0; element < imagesFor(by); ++element) {
    const Eigen::MatrixXd scaled = images_[element](Eigen::all, samples);
    const Eigen::MatrixXd placesThere = placesOf(scaled),
                          termsThere = monomialsOf(form_, scaled, by.decay, common_.amplitudes.empty() ? 0 : 1);
    if (result.empty()) {
      places = placesThere;
      terms = termsThere;
    }
    result.push_back(gaussians(places, placesThere, by.width * range_));
    result.back().array() *= lapack::product(terms, true, termsThere, false).array();
    throwIfStopped(stop_);
  }
  return result;
}

std::vector<ForwardProcess::Part> ForwardProcess::partsFor(const Smoothness& by) const {
  if (by.mirrored) return parts_;
  return {{0, 0, components_.rows()}};
}

/// Returns nullopt where a system is singular to rounding. Residuals by S. Sundararajan and S. S. Keerthi, 2001.
std::optional<ForwardProcess::Fitted> ForwardProcess::fitted(const std::vector<Eigen::Index>& samples,
                                                             const Smoothness& by) const {
  const std::vector<Eigen::MatrixXd> ofImages = covariances(samples, by);
  const Eigen::MatrixXd targets = components_(Eigen::all, samples).transpose();
  Fitted result{Eigen::MatrixXd(targets.rows(), targets.cols()), Eigen::MatrixXd(targets.rows(), targets.cols())};
  for (const Part& part : partsFor(by)) {
    Eigen::MatrixXd system = ofImages[0];
    for (std::size_t element = 1; element < ofImages.size(); ++element)
      system += MirrorGroup::sign(part.parity, static_cast<int>(element)) * ofImages[element];
    if (part.parity == 0) system.array() += static_cast<double>(ofImages.size()) * kRestVariance;
    system.diagonal().array() += by.smoothing;
    throwIfStopped(stop_);
    if (!lapack::choleskyInPlace(system)) return {};
    throwIfStopped(stop_);
    lapack::invertLowerInPlace(system);
    system.triangularView<Eigen::StrictlyUpper>().setZero();
    throwIfStopped(stop_);
    auto weights = result.weights.middleCols(part.from, part.count);
    weights = lapack::product(system, true,
                              lapack::product(system, false, targets.middleCols(part.from, part.count), false), false);
    const Eigen::VectorXd inverseDiagonal = system.colwise().squaredNorm();
    result.leaveOneOut.middleCols(part.from, part.count) = inverseDiagonal.cwiseInverse().asDiagonal() * weights;
  }
  return result;
}

void ForwardProcess::chooseSmoothness() {
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
    along(&Smoothness::decay, kDecays);
    along(&Smoothness::smoothing, kSmoothings);
    for (const double width : kWidths)
      if (Smoothness by = smoothness_; mirrors_.size() > 1 && by.mirrored) {
        by.width = width;
        by.mirrored = false;
        tryOne(by);
      }
    if (!(best < 0.98 * before)) break;
  }
  if (!std::isfinite(best)) throw NetworkError(kNoFunction);
}

SplineTable ForwardProcess::tableOf(const std::vector<Eigen::Index>& samples, const Eigen::MatrixXd& weights) const {
  SplineTable table = form_;
  // The covariance's monomials at the samples and their images, times the constant factor of those at the table.
  std::vector<Eigen::MatrixXd> places, terms;
  const int least = common_.amplitudes.empty() ? 0 : 1;
  for (std::size_t element = 0; element < imagesFor(smoothness_); ++element) {
    const Eigen::MatrixXd& image = images_[element];
    places.push_back(placesOf(image(Eigen::all, samples)));
    terms.push_back(monomialsOf(form_, image(Eigen::all, samples), smoothness_.decay, least));
    for (Eigen::Index j = 0; j < table.terms(); ++j)
      terms.back().row(j) *= std::pow(smoothness_.decay, table.exponents.col(j).sum() - least);
  }
  const std::vector<Part> parts = partsFor(smoothness_);
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(weights.cols(), table.terms() * table.nodes[0] * table.nodes[1]);
  inParallel(static_cast<std::size_t>(table.nodes[1]), options_.threads, [&](std::size_t line) {
    if (stop_.stop_requested()) return;
    const auto y = static_cast<int>(line);
    Eigen::MatrixXd nodes(2, table.nodes[0]);
    for (int x = 0; x < table.nodes[0]; ++x) nodes.col(x) = nodeOf(form_, x, y);
    for (std::size_t element = 0; element < places.size(); ++element) {
      const Eigen::MatrixXd shares = gaussians(places[element], nodes, width()); // samples x nodes
      for (Eigen::Index j = 0; j < table.terms(); ++j) {
        const Eigen::MatrixXd ofTerm = weights.transpose() * (terms[element].row(j).transpose().asDiagonal() * shares);
        for (const Part& part : parts) {
          const double sign = MirrorGroup::sign(part.parity, static_cast<int>(element));
          for (int x = 0; x < table.nodes[0]; ++x)
            values.col(j + table.terms() * (x + Eigen::Index(table.nodes[0]) * y)).segment(part.from, part.count) +=
                sign * ofTerm.col(x).segment(part.from, part.count);
        }
      }
    }
  });
  throwIfStopped(stop_);
  table.rest = Eigen::VectorXd::Zero(weights.cols()); // its size is the number of outputs
  table.interpolate(std::move(values));
  if (parts[0].parity == 0)
    table.rest.head(parts[0].count) = static_cast<double>(places.size()) * kRestVariance *
                                      weights.leftCols(parts[0].count).colwise().sum().transpose();
  if (prior_.coefficients.size() > 0) {
    table.coefficients += prior_.coefficients;
    table.rest += prior_.rest;
  }
  table.round(); // to keep its file short
  return table;
}

KernelForwardModel ForwardProcess::modelOf(const std::vector<Eigen::Index>& samples) const {
  KernelForwardModel model = common_;
  const std::optional<Fitted> found = fitted(samples, smoothness_);
  if (!found) throw NetworkError(kNoFunction);
  model.table = tableOf(samples, found->weights);
  const Eigen::Index initialGuesses =
      std::min<Eigen::Index>(kMostInitialGuesses, static_cast<Eigen::Index>(samples.size()));
  model.initialGuesses = images_[0](Eigen::all, samples).leftCols(initialGuesses);
  const double noise = options_.relativeNoise > 0 ? 1 : 0;
  model.deviation = (noise + found->leaveOneOut.array().square().colwise().mean()).sqrt().cwiseMax(1e-12);
  model.inflation = Eigen::VectorXd::Ones(model.parameters());
  return model;
}

} // namespace palp
