#pragma once

#include "app/study/material/TestRows.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// What is minimised: the sum of squared differences of nominal stress, each as it is or over the measured stress (at
/// least 1 % of the largest).
enum class Residuals { Absolute, Relative };
constexpr NamedEnum kResiduals("residuals", std::array{std::pair{Residuals::Absolute, "absolute"},
                                                       std::pair{Residuals::Relative, "relative"}});

/// A law that can be fitted: of Ogden's, one for each number of terms.
struct LawCandidate {
  RubberLawKind kind = RubberLawKind::NeoHooke;
  int terms = 0; ///< of Ogden's law; 0: another law
  /// "yeoh", "ogden-2".
  [[nodiscard]] std::string name() const;
  [[nodiscard]] int constants() const;
};
/// All of them: neo-hooke, mooney-rivlin, yeoh, gent, ogden-1, ogden-2, ogden-3.
std::vector<LawCandidate> lawCandidates();

/// A law fitted to a test.
struct LawFit {
  LawCandidate candidate;
  RubberLaw law;
  std::vector<std::string> names;      ///< of the constants, as in a design file: "c10_MPa", "alpha[1]"
  Eigen::VectorXd values;              ///< of the constants
  Eigen::MatrixXd covariance;          ///< of the constants, from the residuals' own scatter; empty: as many as rows
  double rms_MPa = 0;                  ///< root mean square of the differences of stress
  double rms = 0;                      ///< of what was minimised: equal to rms_MPa, or relative
  std::optional<double> heldOut;       ///< the same over rows that a fit to the others has not seen; none: too few rows
  std::array<StableRange, 3> stable{}; ///< in the order of TestMode, between the stretches 0.2 and 8
  bool stableOnRows = false;           ///< in each mode of the test, over its stretches
};

/// A law that could not be fitted, and why.
struct LawWithoutFit {
  LawCandidate candidate;
  std::string reason;
};

struct LawComparison {
  std::vector<LawFit> fits; ///< in the order of the candidates
  std::vector<LawWithoutFit> without;
  std::optional<std::size_t> best; ///< of those stable on the rows, the one with the smallest held-out error
  std::vector<std::string> warnings;
};

/// Fits each candidate to the rows, all modes together, by least squares. Laws that are linear in their constants by
/// QR; Gent's and Ogden's by the method of Levenberg and Marquardt from a fixed set of starts, as Ogden's sums have
/// several optima, found among 200 rows and refined with all (Ogden, Saccomandi and Sgura, Computational Mechanics 34,
/// 2004). Held-out errors: each mode's rows, ordered by stretch, in five successive parts, each predicted by a fit to
/// the other four. `progress` receives the share of the candidates that are fitted. Throws Cancelled.
LawComparison fitLaws(const std::vector<TestRow>& rows, const std::vector<LawCandidate>& candidates,
                      Residuals residuals, const std::stop_token& stop = {},
                      const std::function<void(double)>& progress = {});

/// Standard deviation [MPa] of the fitted stress at a stretch, from the covariance of the constants.
double fittedDeviation_MPa(const LawFit& fit, TestMode mode, double stretch);

} // namespace palp
