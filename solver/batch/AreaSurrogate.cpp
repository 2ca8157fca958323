#include "solver/batch/AreaSurrogate.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int lowestDegree = 2, highestDegree = 6;
constexpr int keptForces = 24;             // from the fit, to measure its error
constexpr double pointsATerm = 1.5;        // least squares of a polynomial on scattered points
constexpr double surrogateFitShare = 0.01; // of the tolerance, for the solves that are fitted

/// Displacements of the upper, then of the lower electrodes, then the pressures.
Eigen::VectorXd numbers(const ElectrodeDisplacements& e) {
  Eigen::VectorXd all(e.upper_mm.size() + e.lower_mm.size() + e.upperPressure_MPa.size());
  all << e.upper_mm.reshaped(), e.lower_mm.reshaped(), e.upperPressure_MPa;
  return all;
}

/// Covering forces of indices first .. last - 1 and their answers; false: some have none.
bool addAnswers(BatchEngine& engine, const SensorDesign& design, int area, int last, double tolerance,
                const std::stop_token& stop, std::vector<Eigen::Vector3d>& forces,
                std::vector<ElectrodeDisplacements>& answers) {
  std::vector<LoadCase> loads;
  for (int i = static_cast<int>(forces.size()); i < last; ++i) {
    forces.push_back(coveringForce(design.forceRange, i));
    loads.push_back({{{area, forces.back()}}, {}});
  }
  const auto found = engine.solve(loads, surrogateFitShare * tolerance, {}, stop);
  if (found.size() != loads.size()) return false;
  for (const auto& answer : found) {
    if (!answer) return false;
    answers.push_back(*answer);
  }
  return true;
}

} // namespace

double relativeDifference(const ElectrodeDisplacements& a, const ElectrodeDisplacements& reference) {
  const double norm = reference.upper_mm.norm();
  return norm > 0 ? (a.upper_mm - reference.upper_mm).norm() / norm : a.upper_mm.norm();
}

AreaSurrogate::AreaSurrogate(const ForceRange& range, int degree, const std::vector<Eigen::Vector3d>& forces_N,
                             const std::vector<ElectrodeDisplacements>& answers)
    : polynomial_(range, degree), degree_(degree), upper_(answers.front().upper_mm.cols()),
      lower_(answers.front().lower_mm.cols()) {
  const std::size_t kept = keptForces, count = forces_N.size();
  const std::vector<Eigen::Vector3d> fitted(forces_N.begin(), forces_N.end() - kept);
  Eigen::MatrixXd values(numbers(answers.front()).size(), static_cast<Eigen::Index>(fitted.size()));
  for (std::size_t i = 0; i < fitted.size(); ++i) values.col(static_cast<Eigen::Index>(i)) = numbers(answers[i]);
  coefficients_ = values * polynomial_.fit(fitted);
  for (std::size_t first = fitted.size(); first < count; first += lanes) {
    const std::size_t some = std::min<std::size_t>(lanes, count - first);
    const auto guesses = evaluate({forces_N.data() + first, some});
    for (std::size_t i = 0; i < some; ++i)
      error_ = std::max(error_, relativeDifference(guesses[i], answers[first + i]));
  }
}

std::optional<AreaSurrogate> AreaSurrogate::fit(BatchEngine& engine, const SensorDesign& design, int area,
                                                double tolerance, const std::stop_token& stop) {
  std::vector<Eigen::Vector3d> forces;
  std::vector<ElectrodeDisplacements> answers;
  std::optional<AreaSurrogate> best;
  for (int degree = lowestDegree; degree <= highestDegree; ++degree) {
    const int terms = ForcePolynomial(design.forceRange, degree).terms();
    const int needed = std::max(8, static_cast<int>(pointsATerm * terms)) + keptForces;
    if (!addAnswers(engine, design, area, needed, tolerance, stop, forces, answers)) return {};
    AreaSurrogate trial(design.forceRange, degree, forces, answers);
    if (!best || trial.error() < best->error()) best = std::move(trial);
    if (best->error() <= tolerance) break;
  }
  return best;
}

std::vector<ElectrodeDisplacements> AreaSurrogate::evaluate(std::span<const Eigen::Vector3d> forces_N) const {
  const int terms = polynomial_.terms();
  LaneVector monomials(std::size_t(terms) * lanes), out(coefficients_.rows() * lanes);
  for (std::size_t i = 0; i < forces_N.size(); ++i) {
    const Eigen::VectorXd values = polynomial_.monomials(forces_N[i]);
    for (int t = 0; t < terms; ++t) monomials[std::size_t(t) * lanes + i] = values(t);
  }
  laneKernels().addPolynomials(coefficients_.data(), terms, monomials.data(), static_cast<int>(coefficients_.rows()),
                               out.data(), lanes);
  std::vector<ElectrodeDisplacements> answers;
  for (std::size_t i = 0; i < forces_N.size(); ++i) {
    const Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<lanes>> lane(out.data() + i, coefficients_.rows());
    answers.push_back({lane.head(3 * upper_).reshaped(3, upper_),
                       lane.segment(3 * upper_, 3 * lower_).reshaped(3, lower_), lane.tail(upper_)});
  }
  return answers;
}

} // namespace palp
