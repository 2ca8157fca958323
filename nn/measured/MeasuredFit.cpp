#include "nn/measured/MeasuredFit.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/linear/Lapack.h"
#include "nn/linear/RandomNumbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace palp {

namespace {

constexpr Eigen::Index kRowsOfChoice = 2000, kRowsOfFit = 6000;
constexpr int kCentersOfChoice = 200, kCentersOfFit = 500;
constexpr double kTail = 10; ///< features of the line are longer by this factor: penalised 100 times less
constexpr double kFloor =
    0.1; ///< an input that varies less than this share of the largest is not raised to deviation 1
constexpr double kFewest = 1e-11; ///< eigenvalues of the Gaussians' matrix that count, of the largest
constexpr double kEqual = 1.02, kEqualIndependent = 1.005;
constexpr double kDecades = 1.5; ///< readings that vary by more are also tried as ln R and 1/R
constexpr double kBeyondRange = 0.1;
constexpr double kWithinOne = 0.683;
constexpr int kManyReadings = 3; ///< more are remembered as what a line makes of them
constexpr int kTimes = 3;
constexpr Eigen::Index kManyRuns = 50; ///< are thinned run by run, fewer row by row

std::vector<double> lambdas() {
  std::vector<double> all;
  for (int exponent = -11; exponent <= 0; ++exponent) all.push_back(std::pow(10.0, exponent));
  return all;
}

/// Offset and factor of each input: deviation 1, but an input that hardly varies is not raised by more than 10 times
/// against the largest of the first `readings`; then one factor: mean square length 1.
FeatureScaler inputScaler(const Eigen::MatrixXd& inputs, Eigen::Index readings) {
  FeatureScaler scaler;
  scaler.scaling = Scaling::ZScore;
  scaler.offset = inputs.rowwise().mean();
  const Eigen::MatrixXd centred = inputs.colwise() - scaler.offset;
  const Eigen::VectorXd deviation = centred.array().square().rowwise().mean().sqrt();
  const double floor = kFloor * deviation.head(readings).maxCoeff();
  scaler.factor = Eigen::VectorXd::Zero(inputs.rows());
  for (Eigen::Index i = 0; i < inputs.rows(); ++i)
    if (deviation(i) > 1e-12 * inputs.row(i).cwiseAbs().maxCoeff())
      scaler.factor(i) = 1 / std::hypot(deviation(i), floor);
  const double length = std::sqrt((scaler.factor.asDiagonal() * centred).colwise().squaredNorm().mean());
  if (!(length > 0)) throw NetworkError("the readings do not vary");
  scaler.factor /= length;
  return scaler;
}

/// A line, or Gaussians of one spread on some of the samples and a line.
struct Features {
  double spread = 0; ///< 0: a line alone
  Eigen::MatrixXd centers;
  Eigen::MatrixXd basis; ///< combinations of Gaussians that are independent to rounding: centres x combinations

  /// Rows x features of scaled inputs (inputs x rows).
  [[nodiscard]] Eigen::MatrixXd at(const Eigen::MatrixXd& scaled) const {
    if (spread == 0) return scaled.transpose();
    Eigen::MatrixXd gaussians = squaredDistances(scaled, centers);
    basisInPlace(gaussians, gaussianRate(spread, SpreadConvention::Radbas));
    Eigen::MatrixXd all(scaled.cols(), basis.cols() + scaled.rows());
    all.leftCols(basis.cols()) = lapack::product(gaussians, false, basis, false);
    all.rightCols(scaled.rows()) = kTail * scaled.transpose();
    return all;
  }
};

Features featuresOf(const Eigen::MatrixXd& scaled, double spread, int most, std::uint64_t seed) {
  Features features;
  features.spread = spread;
  if (spread == 0) return features;
  std::vector<Eigen::Index> chosen(static_cast<std::size_t>(scaled.cols()));
  std::iota(chosen.begin(), chosen.end(), Eigen::Index{0});
  RandomNumbers random(seed);
  for (std::size_t i = chosen.size(); i > 1; --i) std::swap(chosen[i - 1], chosen[random.below(i)]);
  chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(most)));
  std::sort(chosen.begin(), chosen.end());
  features.centers = scaled(Eigen::all, chosen);
  Eigen::MatrixXd kernel = squaredDistances(features.centers, features.centers);
  basisInPlace(kernel, gaussianRate(spread, SpreadConvention::Radbas));
  const lapack::SymmetricEigen eigen = lapack::symmetricEigen(kernel);
  Eigen::Index first = 0;
  while (eigen.values(first) <= kFewest * eigen.values(eigen.values.size() - 1)) ++first;
  const Eigen::Index count = eigen.values.size() - first;
  features.basis = eigen.vectors.rightCols(count) * eigen.values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
  return features;
}

/// Every k-th row, or every k-th run where they are many.
std::vector<Eigen::Index> thinnedRows(const MeasuredRows& rows, Eigen::Index most) {
  const Eigen::Index step = std::max<Eigen::Index>(1, (rows.size() + most - 1) / most);
  const bool byRun = rows.runCount() > kManyRuns;
  std::vector<Eigen::Index> chosen;
  Eigen::Index run = -1, within = 0;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (i == 0 || rows.runs(i) != rows.runs(i - 1)) {
      ++run;
      within = 0;
    }
    if ((byRun ? run : within) % step == 0) chosen.push_back(i);
    ++within;
  }
  return chosen;
}

MeasuredRows rowsAt(const MeasuredRows& rows, const std::vector<Eigen::Index>& chosen) {
  MeasuredRows part{rows.readings(chosen, Eigen::all), rows.targets(chosen, Eigen::all), {}, rows.runs(chosen)};
  if (rows.times_s.size() > 0) part.times_s = rows.times_s(chosen);
  return part;
}

double percentile(Eigen::VectorXd values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<Eigen::Index>(at);
  const Eigen::Index high = std::min<Eigen::Index>(low + 1, values.size() - 1);
  return values(low) + (at - static_cast<double>(low)) * (values(high) - values(low));
}

std::vector<ReadingTransform> transformsFor(const Eigen::MatrixXd& readings) {
  std::vector<ReadingTransform> all{ReadingTransform::None};
  if (!(readings.minCoeff() > 0)) return all;
  for (const auto column : readings.colwise())
    if (percentile(column, 0.995) > kDecades * percentile(column, 0.005)) {
      all.insert(all.end(), {ReadingTransform::Logarithm, ReadingTransform::Inverse});
      break;
    }
  return all;
}

/// Sets of time constants: none, and neighbours of dt, 4 dt, 16 dt, ... up to a sixteenth of the time recorded.
std::vector<std::vector<double>> ladder(const MeasuredRows& rows, double& spacing_s) {
  std::vector<double> gaps;
  double recorded_s = 0;
  for (Eigen::Index i = 1; i < rows.size(); ++i)
    if (rows.runs(i) == rows.runs(i - 1)) {
      gaps.push_back(rows.times_s(i) - rows.times_s(i - 1));
      recorded_s += gaps.back();
    }
  std::vector<std::vector<double>> sets{{}};
  if (gaps.empty() || !(recorded_s > 0)) return sets;
  std::sort(gaps.begin(), gaps.end());
  spacing_s = gaps[gaps.size() / 2] > 0 ? gaps[gaps.size() / 2] : recorded_s / static_cast<double>(gaps.size());
  std::vector<double> all;
  for (double time_s = spacing_s; time_s <= recorded_s / 16; time_s *= 4) all.push_back(time_s);
  if (all.empty()) all.push_back(spacing_s);
  for (std::size_t i = 0; i + kTimes <= all.size(); ++i)
    sets.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(i),
                      all.begin() + static_cast<std::ptrdiff_t>(i) + kTimes);
  return sets;
}

/// Errors of predictions that are limited to the range, as shares of the targets' deviations.
class Judge {
public:
  explicit Judge(const Eigen::MatrixXd& targets) : targets_(targets) {
    const Eigen::RowVectorXd low = targets.colwise().minCoeff(), high = targets.colwise().maxCoeff();
    low_ = low - kBeyondRange * (high - low);
    high_ = high + kBeyondRange * (high - low);
    variance_ =
        (targets.rowwise() - targets.colwise().mean()).colwise().squaredNorm() / static_cast<double>(targets.rows());
    if (!(variance_.maxCoeff() > 0)) throw NetworkError("the forces do not vary");
  }

  [[nodiscard]] Eigen::MatrixXd limited(const Eigen::MatrixXd& errors) const {
    Eigen::MatrixXd all = errors;
    for (Eigen::Index i = 0; i < all.rows(); ++i)
      all.row(i) = targets_.row(i) - (targets_.row(i) - errors.row(i)).cwiseMax(low_).cwiseMin(high_);
    return all;
  }
  /// Infinite where an error is not a number. `rows`: those that are judged; empty: all.
  [[nodiscard]] double score(const Eigen::MatrixXd& limitedErrors) const {
    double sum = 0;
    int varying = 0;
    for (Eigen::Index j = 0; j < variance_.size(); ++j) {
      if (!(variance_(j) > 0)) continue;
      sum += limitedErrors.col(j).squaredNorm() / static_cast<double>(limitedErrors.rows()) / variance_(j);
      ++varying;
    }
    return std::isfinite(sum) ? std::sqrt(sum / varying) : std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] const Eigen::RowVectorXd& low() const { return low_; }
  [[nodiscard]] const Eigen::RowVectorXd& high() const { return high_; }

private:
  const Eigen::MatrixXd& targets_;
  Eigen::RowVectorXd low_, high_, variance_;
};

Eigen::VectorXd rootMeanSquare(const Eigen::MatrixXd& errors) {
  return errors.array().square().colwise().mean().sqrt().transpose();
}

/// Number of the features in the order from plain to rich: a line, then wide to narrow Gaussians.
constexpr double kSpreads[] = {0, 4, 2, 1, 0.5};

/// What was tried and how it erred.
struct Candidate {
  InputStage stage;
  std::size_t plainness = 0;
  double spread = 0;
  std::size_t lambda = 0;
  double score = 0;
};

class Choice {
public:
  Choice(const MeasuredRows& rows, const MeasuredOptions& options, const std::stop_token& stop,
         const std::function<void(double)>& progress)
      : rows_(rows), options_(options), stop_(stop), progress_(progress) {
    lambdas_ = options.ridge ? std::vector<double>{*options.ridge} : lambdas();
    spreads_ = options.lineOnly ? std::vector<double>{0}
               : options.spread ? std::vector<double>{*options.spread}
                                : std::vector<double>(std::begin(kSpreads), std::end(kSpreads));
  }

  MeasuredFit run() {
    fit_.validation.dependence = findDependence(rows_, options_.order, stop_);
    tryAll();
    const Candidate chosen = best();
    fit_.stage = chosen.stage;
    finish(chosen);
    return std::move(fit_);
  }

private:
  [[nodiscard]] RowOrder order() const { return fit_.validation.dependence.order; }

  std::vector<std::vector<double>> memories() {
    if (options_.memory_s) return {*options_.memory_s};
    if (order() == RowOrder::Independent) return {{}};
    if (rows_.times_s.size() == 0) {
      fit_.validation.noClock = true;
      return {{}};
    }
    return ladder(rows_, spacing_s_);
  }

  void tryAll() {
    const std::vector<Eigen::Index> thin = thinnedRows(rows_, kRowsOfChoice);
    const MeasuredRows few = rowsAt(rows_, thin);
    const std::vector<Fold> folds = foldsFor(few, order());
    const Judge judge(few.targets);
    const auto transforms = options_.transform ? std::vector{*options_.transform} : transformsFor(rows_.readings);
    const auto sets = memories();
    std::size_t done = 0;
    for (const ReadingTransform transform : transforms) {
      InputStage stage;
      stage.transform = transform;
      const bool remembers = std::any_of(sets.begin(), sets.end(), [](const auto& set) { return !set.empty(); });
      if (remembers && rows_.readings.cols() > kManyReadings) addLine(stage, few, folds, judge);
      for (const std::vector<double>& times_s : sets) {
        stage.times_s = times_s;
        stage.longestGap_s = times_s.empty() ? 0 : times_s.back();
        tryStage(stage, thin, few, folds, judge);
        if (progress_)
          progress_(0.7 * static_cast<double>(++done) / static_cast<double>(transforms.size() * sets.size()));
      }
    }
  }

  /// The signals that are remembered: what a line without memory makes of the readings.
  void addLine(InputStage& stage, const MeasuredRows& few, const std::vector<Fold>& folds, const Judge& judge) const {
    const Eigen::MatrixXd inputs = stage.transformed(few.readings.transpose());
    const Eigen::VectorXd mean = inputs.rowwise().mean();
    Eigen::VectorXd factor = (inputs.colwise() - mean).array().square().rowwise().mean().sqrt();
    const double all = std::sqrt(static_cast<double>(inputs.rows()));
    for (double& one : factor) one = one > 0 ? 1 / (one * all) : 0;
    const Eigen::MatrixXd scaled = factor.asDiagonal() * (inputs.colwise() - mean);
    const GroupRidge line(scaled.transpose(), few.targets);
    const auto tried = lambdas();
    const auto errors = line.errors(folds, tried, stop_);
    std::size_t least = 0;
    double score = std::numeric_limits<double>::infinity();
    for (std::size_t l = 0; l < errors.size(); ++l)
      if (const double one = judge.score(errors[l]); one < score) {
        score = one;
        least = l;
      }
    const Eigen::MatrixXd solution = line.fit(tried[least]);
    stage.weights = solution.topRows(inputs.rows()).transpose() * factor.asDiagonal();
    stage.constant = solution.bottomRows<1>().transpose() - stage.weights * mean;
  }

  void tryStage(const InputStage& stage, const std::vector<Eigen::Index>& thin, const MeasuredRows& few,
                const std::vector<Fold>& folds, const Judge& judge) {
    const Eigen::MatrixXd inputs = inputsOf(stage)(Eigen::all, thin);
    const FeatureScaler scaler = inputScaler(inputs, rows_.readings.cols());
    const Eigen::MatrixXd scaled = scaler.apply(inputs);
    for (std::size_t s = 0; s < spreads_.size(); ++s) {
      throwIfStopped(stop_);
      const Features features = featuresOf(scaled, spreads_[s], kCentersOfChoice, options_.seed);
      const auto errors = GroupRidge(features.at(scaled), few.targets).errors(folds, lambdas_, stop_);
      for (std::size_t l = 0; l < errors.size(); ++l)
        candidates_.push_back({stage, s, spreads_[s], l, judge.score(judge.limited(errors[l]))});
    }
  }

  [[nodiscard]] Eigen::MatrixXd inputsOf(const InputStage& stage) const {
    return stage.apply(rows_.readings.transpose(), rows_.times_s.transpose(), rows_.runs.cast<double>().transpose());
  }

  [[nodiscard]] Candidate best() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& one : candidates_) least = std::min(least, one.score);
    if (!std::isfinite(least))
      throw NetworkError("no ridge makes the fit definite; the readings are beyond double precision");
    const double equal = (order() == RowOrder::Independent ? kEqualIndependent : kEqual) * least;
    const Candidate* chosen = nullptr;
    const auto plainer = [](const Candidate& a, const Candidate& b) {
      return std::tuple(a.stage.times_s.size(), a.plainness, a.score) <
             std::tuple(b.stage.times_s.size(), b.plainness, b.score);
    };
    for (const Candidate& one : candidates_)
      if (one.score <= equal && (chosen == nullptr || plainer(one, *chosen))) chosen = &one;
    return *chosen;
  }

  /// More rows and Gaussians, spreads and ridges next to the choice; then the errors that are stated.
  void finish(const Candidate& chosen) {
    const std::vector<Eigen::Index> thin = thinnedRows(rows_, kRowsOfFit);
    const MeasuredRows many = rowsAt(rows_, thin);
    const std::vector<Fold> folds = foldsFor(many, order());
    const Judge judge(many.targets);
    const Eigen::MatrixXd inputs = inputsOf(fit_.stage)(Eigen::all, thin);
    const FeatureScaler scaler = inputScaler(inputs, rows_.readings.cols());
    const Eigen::MatrixXd scaled = scaler.apply(inputs);
    std::vector<double> near;
    for (std::size_t l = chosen.lambda == 0 ? 0 : chosen.lambda - 1; l < std::min(lambdas_.size(), chosen.lambda + 2);
         ++l)
      near.push_back(lambdas_[l]);
    double least = std::numeric_limits<double>::infinity();
    Features features;
    Eigen::MatrixXd errors;
    std::optional<GroupRidge> system;
    for (const double factor : chosen.spread == 0 || options_.spread ? std::vector{1.0} : std::vector{0.7, 1.0, 1.4}) {
      throwIfStopped(stop_);
      Features tried =
          featuresOf(scaled, factor * chosen.spread, options_.centers.value_or(kCentersOfFit), options_.seed);
      GroupRidge fit(tried.at(scaled), many.targets);
      const auto found = fit.errors(folds, near, stop_);
      bool better = false;
      for (std::size_t l = 0; l < near.size(); ++l) {
        const Eigen::MatrixXd limited = judge.limited(found[l]);
        const double score = judge.score(limited);
        if (!(score < least)) continue;
        better = true;
        least = score;
        errors = limited;
        fit_.validation.lambda = near[l];
      }
      if (better) {
        features = std::move(tried);
        system.emplace(std::move(fit));
      }
      if (progress_) progress_(0.85);
    }
    if (!system) throw NetworkError("no ridge makes the fit definite; the readings are beyond double precision");
    makeNetwork(scaler, features, system->fit(fit_.validation.lambda));
    fit_.low = judge.low().transpose();
    fit_.high = judge.high().transpose();
    state(many, thin, judge, *system, errors, least);
    fitDeviation(many.targets, errors);
    fitEllipse(scaled, folds);
  }

  void makeNetwork(const FeatureScaler& scaler, const Features& features, const Eigen::MatrixXd& solution) {
    RbfNetwork& network = fit_.network;
    network.scaler = scaler;
    const Eigen::Index inputs = scaler.offset.size(), outputs = solution.cols();
    network.bias = solution.bottomRows<1>().transpose();
    network.spread = features.spread > 0 ? features.spread : 1;
    if (features.spread == 0) {
      network.centers.resize(inputs, 0);
      network.weights.resize(outputs, 0);
      network.tail = solution.topRows(inputs).transpose();
      return;
    }
    network.centers = features.centers;
    network.weights = (features.basis * solution.topRows(features.basis.cols())).transpose();
    network.tail = kTail * solution.middleRows(features.basis.cols(), inputs).transpose();
  }

  void state(const MeasuredRows& many, const std::vector<Eigen::Index>& thin, const Judge& judge,
             const GroupRidge& system, const Eigen::MatrixXd& errors, double score) {
    MeasuredValidation& validation = fit_.validation;
    validation.stated = rootMeanSquare(errors);
    validation.score = score;
    validation.errors = errors.transpose();
    validation.fittedRows = thin;
    validation.rows = many.size();
    const Eigen::MatrixXd single = judge.limited(system.singleRowErrors(validation.lambda));
    validation.singleRow = rootMeanSquare(single);
    validation.singleRowScore = judge.score(single);
    if (const int runs = many.runCount(); runs < 2 || order() == RowOrder::Runs) return;
    const Eigen::MatrixXd recording =
        judge.limited(system.errors(foldsOfRuns(many), {validation.lambda}, stop_).front());
    validation.recording = rootMeanSquare(recording);
    validation.recordingScore = judge.score(recording);
  }

  /// b out of a list of shares of the range, a by bisection so that 68.3 % of the errors lie within one deviation; the
  /// b for which the smaller and the larger forces have equal shares.
  void fitDeviation(const Eigen::MatrixXd& targets, const Eigen::MatrixXd& errors) {
    DeviationLaw& law = fit_.deviation;
    law.range = (targets.colwise().maxCoeff() - targets.colwise().minCoeff()).transpose();
    law.a = law.b = Eigen::VectorXd::Zero(targets.cols());
    Eigen::VectorXd size = Eigen::VectorXd::Zero(targets.rows());
    const Eigen::Index forces = options_.forces < 0 ? targets.cols() : options_.forces;
    law.range.tail(targets.cols() - forces).setZero();
    for (Eigen::Index j = 0; j < forces; ++j)
      if (law.range(j) > 0) size += ((targets.col(j) - errors.col(j)) / law.range(j)).cwiseAbs2();
    size = size.cwiseSqrt();
    const double median = percentile(size, 0.5);
    for (Eigen::Index j = 0; j < targets.cols(); ++j) {
      const double range = targets.col(j).maxCoeff() - targets.col(j).minCoeff();
      if (!(range > 0)) continue;
      const Eigen::VectorXd error = errors.col(j).cwiseAbs();
      double least = std::numeric_limits<double>::infinity();
      for (const double percent : {0, 1, 2, 4, 6, 9, 13, 18, 25, 35}) {
        const double b = percent / 100 * range;
        double low = 1e-9 * range, high = 10 * range, a = low;
        Shares shares;
        for (int i = 0; i < 60; ++i) {
          a = std::sqrt(low * high);
          shares = sharesWithin(error, size, median, a, b);
          (shares.all < kWithinOne ? low : high) = a;
        }
        const double off =
            std::abs(shares.upper - shares.lower) + 10 * std::max(0.0, std::abs(shares.all - kWithinOne) - 0.01);
        if (!(off < least - 0.02)) continue;
        least = off;
        law.a(j) = a;
        law.b(j) = b;
      }
    }
  }

  struct Shares {
    double all = 0, lower = 0, upper = 0;
  };
  static Shares sharesWithin(const Eigen::VectorXd& error, const Eigen::VectorXd& size, double median, double a,
                             double b) {
    double count[2] = {}, within[2] = {};
    for (Eigen::Index i = 0; i < error.size(); ++i) {
      const int half = size(i) > median ? 1 : 0;
      ++count[half];
      if (error(i) <= std::hypot(a, b * size(i))) ++within[half];
    }
    const auto share = [](double part, double of) { return of > 0 ? part / of : 1; };
    return {share(within[0] + within[1], count[0] + count[1]), share(within[0], count[0]), share(within[1], count[1])};
  }

  /// 99 % of the left-out rows are nearer to those that stay.
  void fitEllipse(const Eigen::MatrixXd& scaled, const std::vector<Fold>& folds) {
    std::vector<double> distances;
    for (const Fold& fold : folds) {
      std::vector<Eigen::Index> stay;
      std::size_t next = 0;
      for (Eigen::Index i = 0; i < scaled.cols(); ++i) {
        if (next < fold.judged.size() && fold.judged[next] == i)
          ++next;
        else
          stay.push_back(i);
      }
      if (stay.size() < 2) continue;
      const TrainingEllipse others = ellipseOf(scaled(Eigen::all, stay));
      for (const Eigen::Index i : fold.judged) distances.push_back(others.distance(scaled.col(i)));
    }
    fit_.ellipse = ellipseOf(scaled);
    fit_.ellipse.limit =
        distances.empty() ? std::numeric_limits<double>::max()
                          : percentile(Eigen::Map<const Eigen::VectorXd>(distances.data(),
                                                                         static_cast<Eigen::Index>(distances.size())),
                                       0.99);
  }

  static TrainingEllipse ellipseOf(const Eigen::MatrixXd& scaled) {
    TrainingEllipse ellipse;
    ellipse.offset = scaled.rowwise().mean();
    const Eigen::MatrixXd centred = scaled.colwise() - ellipse.offset;
    Eigen::MatrixXd covariance = centred * centred.transpose() / std::max(1.0, static_cast<double>(scaled.cols() - 1));
    covariance.diagonal().array() += 1e-4 * covariance.trace() / static_cast<double>(scaled.rows());
    if (!lapack::choleskyInPlace(covariance)) throw NetworkError("the readings do not vary");
    const Eigen::MatrixXd half =
        lapack::solveLower(covariance, Eigen::MatrixXd::Identity(scaled.rows(), scaled.rows()), false);
    ellipse.inverseCovariance = half.transpose() * half;
    return ellipse;
  }

  const MeasuredRows& rows_;
  const MeasuredOptions& options_;
  const std::stop_token& stop_;
  const std::function<void(double)>& progress_;
  std::vector<double> lambdas_, spreads_;
  double spacing_s_ = 0;
  std::vector<Candidate> candidates_;
  MeasuredFit fit_;
};

} // namespace

Eigen::MatrixXd DeviationLaw::at(const Eigen::Ref<const Eigen::MatrixXd>& predicted) const {
  Eigen::RowVectorXd square = Eigen::RowVectorXd::Zero(predicted.cols());
  for (Eigen::Index j = 0; j < predicted.rows(); ++j)
    if (range(j) > 0) square += (predicted.row(j) / range(j)).cwiseAbs2();
  Eigen::MatrixXd all(predicted.rows(), predicted.cols());
  for (Eigen::Index j = 0; j < predicted.rows(); ++j) all.row(j) = (a(j) * a(j) + b(j) * b(j) * square.array()).sqrt();
  return all;
}

double TrainingEllipse::distance(const Eigen::Ref<const Eigen::VectorXd>& scaled) const {
  const Eigen::VectorXd from = scaled - offset;
  return from.dot(inverseCovariance * from);
}

MeasuredFit fitMeasured(const MeasuredRows& rows, const MeasuredOptions& options, const std::stop_token& stop,
                        const std::function<void(double)>& progress) {
  if (rows.size() < 2 || rows.targets.rows() != rows.size() || rows.runs.size() != rows.size())
    throw NetworkError("measured rows: two or more are needed");
  if (!rows.readings.allFinite() || !rows.targets.allFinite())
    throw NetworkError("measured rows: a number is not finite");
  MeasuredRows clocked;
  if (options.rowsAreClock && rows.times_s.size() == 0) {
    clocked = rows;
    clocked.times_s = Eigen::VectorXd::LinSpaced(rows.size(), 0, static_cast<double>(rows.size() - 1));
  }
  return Choice(clocked.size() > 0 ? clocked : rows, options, stop, progress).run();
}

} // namespace palp
