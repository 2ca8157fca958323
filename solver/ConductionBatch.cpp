#include "solver/ConductionBatch.h"

#include "model/FieldAtRest.h"
#include "solver/field/ResistancePolynomial.h"

#include <algorithm>

namespace palp {

namespace {

/// Of d ln R: far below the mesh's own error, and what a cubic reaches for the paper's forces.
constexpr double tolerance = 1e-4;

} // namespace

struct ConductionBatch::State {
  SensorDesign design;
  BatchSolver& batch;
  BatchOptions options;
  ConductionField field;
  Eigen::MatrixXd logAtRest;
  std::vector<std::optional<ResistancePolynomial>> polynomials; ///< one an area

  State(const HyperelasticProblem& problem, BatchSolver& b, const BatchOptions& o)
      : design(problem.design()), batch(b), options(o), field(problem),
        logAtRest(NetworkReading(networkAtRest(design, *design.field()), design.field()->readout)
                      .resistances_ohm()
                      .array()
                      .log()),
        polynomials(std::size_t(design.areas.count())) {}

  /// Every load by its own state.
  Answers bySolves(std::span<const LoadCase> loads, const std::function<void(std::size_t)>& progress,
                   const std::stop_token& stop, std::size_t firstNumber) {
    Answers answers;
    answers.resistances_ohm.resize(loads.size());
    const auto take = [&](std::size_t i, const ElectrodeDisplacements& electrodes, const LoadIncrement& state) {
      if (const auto network = field.network(state, electrodes, 1, stop)) // the batch's threads are at work already
        answers.resistances_ohm[i] = NetworkReading(*network, design.field()->readout).resistances_ohm();
    };
    answers.displacements = batch.solveStates(loads, take, progress, stop, firstNumber);
    if (stop.stop_requested()) return {};
    return answers;
  }

  bool fit(int area, const std::stop_token& stop);
};

/// The smallest degree that meets the tolerance, or the best. False: stopped.
bool ConductionBatch::State::fit(int area, const std::stop_token& stop) {
  std::optional<ResistancePolynomial>& best = polynomials[std::size_t(area)];
  if (best) return true;
  std::vector<Eigen::Vector3d> forces;
  Eigen::MatrixXd changes(logAtRest.size(), 0);
  std::optional<ResistancePolynomial> found;
  for (int degree = ResistancePolynomial::lowestDegree; degree <= ResistancePolynomial::highestDegree; ++degree) {
    std::vector<LoadCase> loads;
    for (int i = static_cast<int>(forces.size()); i < ResistancePolynomial::statesFor(design.forceRange, degree); ++i) {
      forces.push_back(coveringForce(design.forceRange, i));
      loads.push_back({{{area, forces.back()}}, {}});
    }
    const Answers answers = bySolves(loads, {}, stop, 0);
    if (answers.resistances_ohm.empty()) return false;
    const Eigen::Index before = changes.cols();
    changes.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(forces.size()));
    for (std::size_t i = 0; i < answers.resistances_ohm.size(); ++i)
      changes.col(before + static_cast<Eigen::Index>(i)) =
          (answers.resistances_ohm[i].array().log() - logAtRest.array()).matrix().reshaped();
    ResistancePolynomial trial(design.forceRange, degree, forces, changes);
    if (!found || trial.error() < found->error()) found = std::move(trial);
    if (found->error() <= tolerance) break;
  }
  best = std::move(found);
  return true;
}

ConductionBatch::ConductionBatch(const HyperelasticProblem& problem, BatchSolver& batch, const BatchOptions& options)
    : state_(std::make_unique<State>(problem, batch, options)) {}
ConductionBatch::~ConductionBatch() = default;

ConductionBatch::Answers ConductionBatch::solve(std::span<const LoadCase> loads,
                                                const std::function<void(std::size_t)>& progress,
                                                const std::stop_token& stop, std::size_t firstNumber) {
  State& s = *state_;
  const auto one = [&](const LoadCase& load) { return onOneArea(load, s.design.forceRange); };
  if (!s.options.surrogate || !std::all_of(loads.begin(), loads.end(), one))
    return s.bySolves(loads, progress, stop, firstNumber);
  for (const LoadCase& load : loads)
    if (!s.fit(load.areas[0].area, stop)) return {};
  Answers answers{s.batch.solve(loads, progress, stop, firstNumber), {}};
  if (answers.displacements.size() < loads.size()) return {};
  for (const LoadCase& load : loads) {
    const Eigen::VectorXd change = s.polynomials[std::size_t(load.areas[0].area)]->at(load.areas[0].force_N);
    answers.resistances_ohm.emplace_back(
        (s.logAtRest.array() + change.reshaped(s.logAtRest.rows(), s.logAtRest.cols()).array()).exp());
  }
  return answers;
}

bool ConductionBatch::fitSurrogates(std::span<const int> areas, const std::stop_token& stop) {
  return std::all_of(areas.begin(), areas.end(), [&](int area) { return state_->fit(area, stop); });
}

double ConductionBatch::surrogateError() const {
  double error = 0;
  for (const auto& polynomial : state_->polynomials)
    if (polynomial) error = std::max(error, polynomial->error());
  return error;
}

} // namespace palp
