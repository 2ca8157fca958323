#include "nn/measured/MeasuredFit.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/measured/MeasuredFeatures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace palp {

namespace {

constexpr Eigen::Index kRowsOfChoice = 2000, kRowsOfFit = 6000;
constexpr int kCentersOfChoice = 200, kCentersOfFit = 500;
constexpr double kEqual = 1.02, kEqualIndependent = 1.005;
constexpr int kManyReadings = 3; ///< more are remembered as what a line makes of them

std::vector<double> lambdas() {
  std::vector<double> all;
  for (int exponent = -11; exponent <= 0; ++exponent) all.push_back(std::pow(10.0, exponent));
  return all;
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
    spreads_ = options.spread ? std::vector<double>{*options.spread}
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

  [[nodiscard]] std::vector<std::vector<double>> memories() const {
    if (options_.memory_s) return {*options_.memory_s};
    if (order() == RowOrder::Independent || rows_.times_s.size() == 0) return {{}};
    return memoriesFor(rows_);
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
        stage.rowsAreClock = !times_s.empty() && options_.rowsAreClock;
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
    state(many, thin, judge, *system, errors, least);
    fit_.deviation = fitDeviation(many.targets, errors, options_.forces);
    fit_.ellipse = fitEllipse(scaled, folds);
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
    validation.stated = rootMeanSquareOfColumns(errors);
    validation.score = score;
    validation.errors = errors.transpose();
    validation.fittedRows = thin;
    const Eigen::MatrixXd single = judge.limited(system.singleRowErrors(validation.lambda));
    validation.singleRow = rootMeanSquareOfColumns(single);
    validation.singleRowScore = judge.score(single);
    if (const int runs = many.runCount(); runs < 2 || order() == RowOrder::Runs) return;
    const Eigen::MatrixXd recording =
        judge.limited(system.errors(foldsOfRuns(many), {validation.lambda}, stop_).front());
    validation.recording = rootMeanSquareOfColumns(recording);
    validation.recordingScore = judge.score(recording);
  }

  const MeasuredRows& rows_;
  const MeasuredOptions& options_;
  const std::stop_token& stop_;
  const std::function<void(double)>& progress_;
  std::vector<double> lambdas_, spreads_;
  std::vector<Candidate> candidates_;
  MeasuredFit fit_;
};

} // namespace

MeasuredFit fitMeasured(const MeasuredRows& rows, const MeasuredOptions& options, const std::stop_token& stop,
                        const std::function<void(double)>& progress) {
  if (rows.size() < 2 || rows.targets.rows() != rows.size() || rows.runs.size() != rows.size())
    throw NetworkError("measured rows: two or more are needed");
  if (!rows.readings.allFinite() || !rows.targets.allFinite())
    throw NetworkError("measured rows: a number is not finite");
  if (!options.rowsAreClock) return Choice(rows, options, stop, progress).run();
  MeasuredRows clocked = rows;
  clocked.times_s = rowNumbers(rows.size());
  return Choice(clocked, options, stop, progress).run();
}

} // namespace palp
