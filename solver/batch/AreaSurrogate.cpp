#include "solver/batch/AreaSurrogate.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int lowestDegree = 2, highestDegree = 6;
constexpr int keptForces = 24;             // held out of the fit to measure its error
constexpr double pointsATerm = 1.5;        // for least squares on scattered points
constexpr double surrogateFitShare = 0.01; // of the tolerance, for the fitted solves

/// Displacements of the upper, then of the lower electrodes, then the pressures.
Eigen::VectorXd numbers(const ElectrodeDisplacements& e) {
  Eigen::VectorXd all(e.upper_mm.size() + e.lower_mm.size() + e.upperPressure_MPa.size());
  all << e.upper_mm.reshaped(), e.lower_mm.reshaped(), e.upperPressure_MPa;
  return all;
}

/// The fit of an area: its answers to the covering forces, in their order.
struct AreaFit {
  std::size_t index; ///< among the requested areas
  int area;
  std::vector<ElectrodeDisplacements> answers{};
  bool without = false; ///< some loads have no answer
};

/// Adds the answers of all these to forces first .. . Returns false if cancelled.
bool addAnswers(BatchEngine& engine, std::vector<AreaFit>& fits, const std::vector<Eigen::Vector3d>& forces,
                std::size_t first, double tolerance, const std::stop_token& stop) {
  std::vector<LoadCase> loads;
  for (const AreaFit& fit : fits)
    for (std::size_t i = first; i < forces.size(); ++i) loads.push_back({{{fit.area, forces[i]}}, {}});
  const auto found = engine.solve(loads, surrogateFitShare * tolerance, {}, stop);
  if (found.size() != loads.size()) return false;
  auto answer = found.begin();
  for (AreaFit& fit : fits)
    for (std::size_t i = first; i < forces.size(); ++i, ++answer)
      if (*answer)
        fit.answers.push_back(**answer);
      else
        fit.without = true;
  return true;
}

} // namespace

double relativeDifference(const ElectrodeDisplacements& a, const ElectrodeDisplacements& reference,
                          const SensorDesign& design) {
  const auto relative = [](double difference, double norm) { return norm > 0 ? difference / norm : difference; };
  const double upper_mm = reference.upper_mm.norm();
  double largest = relative((a.upper_mm - reference.upper_mm).norm(), upper_mm);
  if (design.lowerFollowsRubber)
    largest = std::max(largest, relative((a.lower_mm - reference.lower_mm).norm(), upper_mm));
  if (design.pressureLaw)
    largest = std::max(
        largest, (a.upperPressure_MPa - reference.upperPressure_MPa).norm() /
                     std::hypot(reference.upperPressure_MPa.norm(),
                                design.pressureLaw->p0_MPa * std::sqrt(double(reference.upperPressure_MPa.size()))));
  if (design.field() || (!design.lowerFollowsRubber && !design.pressureLaw)) return largest;
  const auto logs = [&](const ElectrodeDisplacements& e) -> Eigen::ArrayXXd {
    return rowColumnResistances(design, e).array().log();
  };
  const Eigen::ArrayXXd truth = logs(reference);
  const double change = (truth - logs(ElectrodeDisplacements::atRest(design))).matrix().norm();
  return std::max(largest, relative((logs(a) - truth).matrix().norm(), change));
}

AreaSurrogate::AreaSurrogate(const SensorDesign& design, int degree, const std::vector<Eigen::Vector3d>& forces_N,
                             const std::vector<ElectrodeDisplacements>& answers)
    : polynomial_(design.forceRange, degree), degree_(degree), upper_(answers.front().upper_mm.cols()),
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
      error_ = std::max(error_, relativeDifference(guesses[i], answers[first + i], design));
  }
}

std::vector<std::optional<AreaSurrogate>> AreaSurrogate::fit(BatchEngine& engine, const SensorDesign& design,
                                                             std::span<const int> areas, double tolerance,
                                                             const std::stop_token& stop) {
  std::vector<std::optional<AreaSurrogate>> best(areas.size());
  std::vector<AreaFit> open;
  for (std::size_t k = 0; k < areas.size(); ++k) open.push_back({k, areas[k]});
  std::vector<Eigen::Vector3d> forces;
  for (int degree = lowestDegree; degree <= highestDegree && !open.empty(); ++degree) {
    const int terms = ForcePolynomial(design.forceRange, degree).terms();
    const int needed = std::max(8, static_cast<int>(pointsATerm * terms)) + keptForces;
    const std::size_t before = forces.size();
    while (static_cast<int>(forces.size()) < needed)
      forces.push_back(coveringForce(design.forceRange, static_cast<int>(forces.size())));
    if (!addAnswers(engine, open, forces, before, tolerance, stop))
      return std::vector<std::optional<AreaSurrogate>>(areas.size());
    std::erase_if(open, [&](const AreaFit& fit) {
      std::optional<AreaSurrogate>& own = best[fit.index];
      if (fit.without) {
        own.reset();
        return true;
      }
      AreaSurrogate trial(design, degree, forces, fit.answers);
      if (!own || trial.error() < own->error()) own = std::move(trial);
      return own->error() <= tolerance;
    });
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
