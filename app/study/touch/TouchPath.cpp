#include "app/study/touch/TouchPath.h"

#include "model/DesignError.h"
#include "model/base/Cancelled.h"
#include "solver/ConductionField.h"

#include <algorithm>
#include <optional>

namespace palp {

LoadCase pathEnvelope(const std::vector<LoadCase>& path) {
  LoadCase envelope = path.front();
  for (std::size_t k = 0; k < path.front().indenters.size(); ++k) {
    Indenter& widest = envelope.indenters[k];
    if (widest.press()) {
      for (const LoadCase& load : path)
        if (load.indenters[k].press()->force_N.z() < widest.press()->force_N.z())
          widest.control = *load.indenters[k].press();
      continue;
    }
    Motion low{0, Eigen::Vector2d::Zero()}, high = low;
    for (const LoadCase& load : path) {
      const Motion& motion = *load.indenters[k].motion();
      low.depth_mm = high.depth_mm = std::max(low.depth_mm, motion.depth_mm);
      low.shift_mm = low.shift_mm.cwiseMin(motion.shift_mm);
      high.shift_mm = high.shift_mm.cwiseMax(motion.shift_mm);
    }
    widest.control = low;
    if (high.shift_mm == low.shift_mm) continue;
    Indenter other = widest;
    other.control = high;
    envelope.indenters.push_back(other);
  }
  return envelope;
}

Solution joined(std::vector<Solution> steps) {
  Solution all = std::move(steps.front());
  for (std::size_t k = 1; k < steps.size(); ++k) {
    Solution& step = steps[k];
    const auto before = static_cast<double>(k);
    for (NewtonStep newton : step.newton) {
      newton.loadFraction += before;
      all.newton.push_back(newton);
    }
    for (std::size_t i = 1; i < step.increments.size(); ++i) { // the first is the end of the load before
      all.increments.push_back(std::move(step.increments[i]));
      all.increments.back().loadFraction += before;
    }
    all.converged = step.converged;
    all.cancelled = step.cancelled;
    all.reachedLoadFraction = before + step.reachedLoadFraction;
    all.stopReason = step.stopReason;
    all.maxVolumeError = std::max(all.maxVolumeError, step.maxVolumeError);
    all.reaction_N = step.reaction_N;
  }
  return all;
}

TouchPath followPath(const SensorDesign& design, const std::vector<LoadCase>& path, const MeshOptions& mesh,
                     const NewtonOptions& options, const NewtonObserver& observer, StageLog& stages) {
  requireValid(design);
  if (const auto wrong = whyInvalid(path, design)) throw DesignError(*wrong);
  Mesh made = stages.measure(
      "mesh", [&] { return sensorMesh(design, meshFor(design, pathEnvelope(path), mesh), observer.stop); });
  TouchPath result{stages.measure("factorise", [&] { return HyperelasticProblem(design, std::move(made)); }), {}};
  std::vector<Solution> solutions =
      stages.measure("solve", [&] { return result.problem.solvePath(path, options, observer); });
  std::optional<ConductionField> field;
  if (design.field()) field.emplace(result.problem);
  for (Solution& solution : solutions) {
    PathStep step;
    step.displacements = result.problem.electrodes(solution.state());
    step.solution = std::move(solution);
    if (field) {
      const auto network = stages.measure(
          "field", [&] { return field->network(step.solution.state(), options.threads, observer.stop); });
      if (!network) throw Cancelled();
      step.resistances_ohm = NetworkReading(*network, design.field()->readout).resistances_ohm();
    } else {
      step.resistances_ohm = rowColumnResistances(design, step.displacements);
    }
    result.steps.push_back(std::move(step));
  }
  return result;
}

} // namespace palp
