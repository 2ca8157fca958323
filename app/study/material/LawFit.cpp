#include "app/study/material/LawFit.h"

#include "app/study/material/LeastSquares.h"
#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr int kFolds = 5;
constexpr std::size_t kRowsOfSearch = 200; // for the minimum among many
constexpr double kLeastStretchShown = 0.2, kMostStretchShown = 8;
constexpr double kSmallestShare = 0.01; // of the largest stress, that relative residuals divide by at least

RubberLaw lawOf(const LawCandidate& candidate, const Eigen::VectorXd& v) {
  switch (candidate.kind) {
  case RubberLawKind::MooneyRivlin:
    return MooneyRivlin{v(0), v(1)};
  case RubberLawKind::NeoHooke:
    return NeoHooke{v(0)};
  case RubberLawKind::Yeoh:
    return Yeoh{v(0), v(1), v(2)};
  case RubberLawKind::Gent:
    return Gent{v(0), v(1)};
  case RubberLawKind::Ogden: {
    Ogden law{{}, {}};
    for (int k = 0; k < candidate.terms; ++k) {
      law.mu_MPa.push_back(v(2 * k));
      law.alpha.push_back(v(2 * k + 1));
    }
    return law;
  }
  }
  return {};
}

std::vector<std::string> namesOf(const LawCandidate& candidate) {
  switch (candidate.kind) {
  case RubberLawKind::MooneyRivlin:
    return {"c10_MPa", "c01_MPa"};
  case RubberLawKind::NeoHooke:
    return {"c10_MPa"};
  case RubberLawKind::Yeoh:
    return {"c10_MPa", "c20_MPa", "c30_MPa"};
  case RubberLawKind::Gent:
    return {"mu_MPa", "jm"};
  case RubberLawKind::Ogden: {
    std::vector<std::string> names;
    for (int k = 0; k < candidate.terms; ++k)
      for (const char* name : {"mu_MPa", "alpha"}) names.push_back(std::string(name) + "[" + std::to_string(k) + "]");
    return names;
  }
  }
  return {};
}

/// The rows with what their residuals are divided by.
struct FitProblem {
  std::vector<TestRow> rows;
  Eigen::VectorXd scale; ///< [MPa, or 1] over the root of the weight

  [[nodiscard]] Eigen::VectorXd stresses(const RubberLaw& law) const {
    Eigen::VectorXd all(static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      all(static_cast<Eigen::Index>(i)) = nominalStress_MPa(law, rows[i].mode, rows[i].stretch);
    return all;
  }
  [[nodiscard]] Eigen::VectorXd measured() const {
    Eigen::VectorXd all(static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) all(static_cast<Eigen::Index>(i)) = rows[i].stress_MPa;
    return all;
  }
  [[nodiscard]] Eigen::VectorXd residuals(const RubberLaw& law) const {
    return (stresses(law) - measured()).cwiseQuotient(scale);
  }
};

FitProblem problemOf(const std::vector<TestRow>& rows, Residuals residuals, double largest_MPa) {
  FitProblem problem{rows, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(rows.size()))};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double& scale = problem.scale(static_cast<Eigen::Index>(i));
    if (residuals == Residuals::Relative) scale = std::max(std::abs(rows[i].stress_MPa), kSmallestShare * largest_MPa);
    scale /= std::sqrt(rows[i].weight);
  }
  return problem;
}

double largestStretching(const std::vector<TestRow>& rows) {
  double most = 0;
  for (const TestRow& row : rows) most = std::max(most, testStretches(row.mode, row.stretch).squaredNorm() - 3);
  return most;
}

bool isLinear(const LawCandidate& candidate) {
  return candidate.kind != RubberLawKind::Gent && candidate.kind != RubberLawKind::Ogden;
}

/// By the columns d stress / d constant of a law that is linear in its constants.
std::optional<Eigen::VectorXd> linearFit(const LawCandidate& candidate, const FitProblem& problem) {
  const int count = candidate.constants();
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(problem.rows.size()), count);
  for (int k = 0; k < count; ++k)
    columns.col(k) = problem.stresses(lawOf(candidate, Eigen::VectorXd::Unit(count, k))).cwiseQuotient(problem.scale);
  return leastSquares(columns, problem.measured().cwiseQuotient(problem.scale));
}

/// Ogden's moduli by linear least squares, the exponents given.
std::optional<Eigen::VectorXd> ogdenStart(const LawCandidate& candidate, const FitProblem& problem,
                                          const std::vector<double>& alphas) {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(problem.rows.size()), candidate.terms);
  for (int k = 0; k < candidate.terms; ++k)
    columns.col(k) = problem.stresses(Ogden{{1}, {alphas[static_cast<std::size_t>(k)]}}).cwiseQuotient(problem.scale);
  const auto moduli = leastSquares(columns, problem.measured().cwiseQuotient(problem.scale));
  if (!moduli) return {};
  Eigen::VectorXd start(2 * candidate.terms);
  for (int k = 0; k < candidate.terms; ++k) {
    start(2 * k) = (*moduli)(k);
    start(2 * k + 1) = alphas[static_cast<std::size_t>(k)];
  }
  return start;
}

/// None for laws that are linear in their constants.
std::vector<Eigen::VectorXd> startsOf(const LawCandidate& candidate, const FitProblem& problem) {
  std::vector<Eigen::VectorXd> starts;
  if (isLinear(candidate)) return starts;
  if (candidate.kind == RubberLawKind::Gent) {
    const auto slope = linearFit({RubberLawKind::NeoHooke}, problem);
    for (const double reach : {1.05, 1.5, 3.0, 10.0, 100.0})
      if (slope)
        starts.emplace_back(Eigen::Vector2d(2 * slope->value() / reach, reach * largestStretching(problem.rows)));
    return starts;
  }
  const std::vector<double> exponents{-8, -4, -1.5, 0.6, 1.5, 3, 6, 10};
  std::vector<double> chosen;
  const std::function<void(std::size_t)> choose = [&](std::size_t from) {
    if (static_cast<int>(chosen.size()) == candidate.terms) {
      if (const auto start = ogdenStart(candidate, problem, chosen)) starts.push_back(*start);
      return;
    }
    for (std::size_t k = from; k < exponents.size(); ++k) {
      chosen.push_back(exponents[k]);
      choose(k + 1);
      chosen.pop_back();
    }
  };
  choose(0);
  return starts;
}

/// Whether a design may have these constants (model/MaterialCheck.h).
bool allowed(const LawCandidate& candidate, const Eigen::VectorXd& v) {
  if (!v.allFinite() || v.cwiseAbs().maxCoeff() > 1e9) return false;
  if (candidate.kind == RubberLawKind::Gent) return v(0) > 0 && v(1) > 0;
  for (int k = 0; k < candidate.terms; ++k)
    if (const double size = std::abs(v(2 * k + 1)); size < 0.01 || size > 50) return false;
  return shearModulus_MPa(lawOf(candidate, v)) > 0;
}

/// The problem with every k-th row, of which there are about `most`.
FitProblem thinned(const FitProblem& problem, std::size_t most) {
  const std::size_t step = (problem.rows.size() + most - 1) / most;
  FitProblem few;
  std::vector<Eigen::Index> chosen;
  for (std::size_t i = 0; i < problem.rows.size(); i += step) {
    few.rows.push_back(problem.rows[i]);
    chosen.push_back(static_cast<Eigen::Index>(i));
  }
  few.scale = problem.scale(chosen);
  return few;
}

/// The smallest of the minima that the starts lead to.
std::optional<Eigen::VectorXd> bestMinimum(const LawCandidate& candidate, const FitProblem& problem,
                                           const std::vector<Eigen::VectorXd>& starts, const std::stop_token& stop) {
  std::optional<Eigen::VectorXd> best;
  double least = INFINITY;
  for (const Eigen::VectorXd& start : starts) {
    if (!allowed(candidate, start)) continue;
    const Minimum minimum = levenbergMarquardt(
        start,
        [&](const Eigen::VectorXd& v) {
          throwIfStopped(stop);
          return problem.residuals(lawOf(candidate, v));
        },
        [&](const Eigen::VectorXd& v) { return allowed(candidate, v); });
    if (!(minimum.squares < least * (1 - 1e-9))) continue; // of equal optima, the first
    least = minimum.squares;
    best = minimum.at;
  }
  return best;
}

/// Many starts are tried on a part of the rows, whose best minimum is the start for all of them.
std::optional<Eigen::VectorXd> fitted(const LawCandidate& candidate, const FitProblem& problem,
                                      const std::vector<Eigen::VectorXd>& starts, const std::stop_token& stop) {
  if (isLinear(candidate)) return linearFit(candidate, problem);
  if (starts.size() < 2 || problem.rows.size() <= kRowsOfSearch) return bestMinimum(candidate, problem, starts, stop);
  const auto near = bestMinimum(candidate, thinned(problem, kRowsOfSearch), starts, stop);
  return near ? bestMinimum(candidate, problem, {*near}, stop) : std::nullopt;
}

double rmsOf(const Eigen::VectorXd& residuals) {
  return std::sqrt(residuals.squaredNorm() / double(residuals.size()));
}

/// The part of five that each row belongs to: successive stretches of its mode.
std::vector<int> foldsOf(const std::vector<TestRow>& rows) {
  std::vector<int> folds(rows.size(), 0);
  for (const auto& [mode, name] : kTestModes.all()) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i].mode == mode) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rows[a].stretch < rows[b].stretch; });
    for (std::size_t k = 0; k < order.size(); ++k) folds[order[k]] = static_cast<int>(k * kFolds / order.size());
  }
  return folds;
}

std::optional<double> heldOutError(const LawCandidate& candidate, const std::vector<TestRow>& rows, Residuals residuals,
                                   double largest_MPa, const Eigen::VectorXd& values, const std::stop_token& stop) {
  const std::vector<int> folds = foldsOf(rows);
  double squares = 0;
  for (int fold = 0; fold < kFolds; ++fold) {
    std::vector<TestRow> seen, unseen;
    for (std::size_t i = 0; i < rows.size(); ++i) (folds[i] == fold ? unseen : seen).push_back(rows[i]);
    if (unseen.empty()) continue;
    if (static_cast<int>(seen.size()) <= candidate.constants()) return {};
    const auto others = fitted(candidate, problemOf(seen, residuals, largest_MPa), {values}, stop);
    if (!others) return {};
    const double part = problemOf(unseen, residuals, largest_MPa).residuals(lawOf(candidate, *others)).squaredNorm();
    if (!std::isfinite(part)) return {}; // beyond Gent's limit
    squares += part;
  }
  return std::sqrt(squares / double(rows.size()));
}

Eigen::MatrixXd covarianceOf(const LawCandidate& candidate, const FitProblem& problem, const Eigen::VectorXd& values) {
  const Eigen::Index free = static_cast<Eigen::Index>(problem.rows.size()) - values.size();
  if (free <= 0) return {};
  const auto residuals = [&](const Eigen::VectorXd& v) { return problem.residuals(lawOf(candidate, v)); };
  const double variance = residuals(values).squaredNorm() / double(free);
  return variance * inverseOfSquares(differences(values, residuals));
}

bool isStableOn(const RubberLaw& law, const std::vector<TestRow>& rows) {
  for (const auto& [mode, name] : kTestModes.all()) {
    double least = 1, most = 1;
    for (const TestRow& row : rows)
      if (row.mode == mode) {
        least = std::min(least, row.stretch);
        most = std::max(most, row.stretch);
      }
    const StableRange range = stableRange(law, mode, least, most);
    if (range.least > least || range.most < most) return false;
  }
  return true;
}

/// What the rows and fits cannot be used for.
std::vector<std::string> warningsOf(const std::vector<TestRow>& rows, const LawComparison& comparison) {
  std::vector<std::string> warnings;
  const bool tensionAlone = std::all_of(rows.begin(), rows.end(), [](const TestRow& row) {
    return row.mode == TestMode::Equibiaxial ? row.stretch <= 1 : row.stretch >= 1;
  });
  if (!tensionAlone) return warnings;
  warnings.emplace_back("the rows have no compression, and a tactile sensor works in compression, where casting "
                        "silicones are often stiffer: expected a test in compression (or equibiaxial tension) as well");
  for (const LawFit& fit : comparison.fits)
    if (const double least = fit.stable[0].least; least > 0.5)
      warnings.push_back(fit.candidate.name() +
                         ": fitted to tension alone, unstable in uniaxial compression below a "
                         "stretch of " +
                         withDigits(least, 3) +
                         (fit.candidate.kind == RubberLawKind::MooneyRivlin && fit.values(1) < 0
                              ? " (c01 is " + withDigits(fit.values(1), 3) + " MPa, below 0)"
                              : ""));
  return warnings;
}

std::string whyNot(const LawCandidate& candidate, const std::vector<TestRow>& rows) {
  const bool planar =
      std::all_of(rows.begin(), rows.end(), [](const TestRow& row) { return row.mode == TestMode::Planar; });
  if (candidate.kind == RubberLawKind::MooneyRivlin && planar)
    return "planar rows alone cannot separate c10 from c01 (I1 = I2 there), only their sum; expected another mode, too";
  return "the rows do not determine its constants; expected more stretches or another mode";
}

} // namespace

std::string LawCandidate::name() const {
  return kRubberLaws.name(kind) + (kind == RubberLawKind::Ogden ? "-" + std::to_string(terms) : "");
}

int LawCandidate::constants() const {
  return static_cast<int>(namesOf(*this).size());
}

std::vector<LawCandidate> lawCandidates() {
  return {{RubberLawKind::NeoHooke, 0}, {RubberLawKind::MooneyRivlin, 0}, {RubberLawKind::Yeoh, 0},
          {RubberLawKind::Gent, 0},     {RubberLawKind::Ogden, 1},        {RubberLawKind::Ogden, 2},
          {RubberLawKind::Ogden, 3}};
}

LawComparison fitLaws(const std::vector<TestRow>& given, const std::vector<LawCandidate>& candidates,
                      Residuals residuals, const std::stop_token& stop, const std::function<void(double)>& progress) {
  std::vector<TestRow> rows;
  double largest_MPa = 0;
  for (const TestRow& row : given)
    if (row.weight > 0) {
      rows.push_back(row);
      largest_MPa = std::max(largest_MPa, std::abs(row.stress_MPa));
    }
  LawComparison comparison;
  const FitProblem problem = problemOf(rows, residuals, largest_MPa);
  std::size_t done = 0;
  for (const LawCandidate& candidate : candidates) {
    if (progress) progress(static_cast<double>(done++) / static_cast<double>(candidates.size()));
    if (static_cast<int>(rows.size()) < candidate.constants()) {
      comparison.without.push_back(
          {candidate, gotExpected(std::to_string(rows.size()) + " rows",
                                  "at least its " + std::to_string(candidate.constants()) + " constants")});
      continue;
    }
    const auto values = fitted(candidate, problem, startsOf(candidate, problem), stop);
    if (!values) {
      comparison.without.push_back({candidate, whyNot(candidate, rows)});
      continue;
    }
    LawFit fit{.candidate = candidate,
               .law = lawOf(candidate, *values),
               .names = namesOf(candidate),
               .values = *values,
               .covariance = {},
               .heldOut = {}};
    fit.covariance = covarianceOf(candidate, problem, *values);
    fit.rms_MPa = rmsOf(problem.stresses(fit.law) - problem.measured());
    fit.rms = rmsOf(problem.residuals(fit.law));
    fit.heldOut = heldOutError(candidate, rows, residuals, largest_MPa, *values, stop);
    for (const auto& [mode, name] : kTestModes.all())
      fit.stable[static_cast<std::size_t>(mode)] = stableRange(fit.law, mode, kLeastStretchShown, kMostStretchShown);
    fit.stableOnRows = isStableOn(fit.law, rows);
    comparison.fits.push_back(std::move(fit));
  }
  for (std::size_t k = 0; k < comparison.fits.size(); ++k) {
    const LawFit& fit = comparison.fits[k];
    if (!fit.stableOnRows || !fit.heldOut) continue;
    if (!comparison.best || *fit.heldOut < *comparison.fits[*comparison.best].heldOut) comparison.best = k;
  }
  comparison.warnings = warningsOf(rows, comparison);
  return comparison;
}

double fittedDeviation_MPa(const LawFit& fit, TestMode mode, double stretch) {
  if (fit.covariance.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto stress = [&](const Eigen::VectorXd& v) {
    return Eigen::VectorXd::Constant(1, nominalStress_MPa(lawOf(fit.candidate, v), mode, stretch)).eval();
  };
  const Eigen::MatrixXd slope = differences(fit.values, stress);
  return std::sqrt(std::max(0.0, (slope * fit.covariance * slope.transpose()).value()));
}

} // namespace palp
