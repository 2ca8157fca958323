#include "app/cli/commands/SolvePath.h"

#include "app/cli/Pictures.h"
#include "app/cli/commands/SolveJson.h"
#include "app/study/touch/TouchPath.h"
#include "model/base/Cancelled.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <cstdio>
#include <iostream>

namespace palp {

namespace {

using Json = nlohmann::ordered_json;

Json stepJson(const SensorDesign& design, const LoadCase& load, const PathStep& step) {
  Json json;
  json["converged"] = step.solution.converged;
  json["reached_load_fraction"] = step.solution.reachedLoadFraction;
  if (!step.solution.stopReason.empty()) json["stop_reason"] = step.solution.stopReason;
  json["newton"] = newtonJson(step.solution.newton);
  json["indenters"] = indentersJson(load, step.solution.state().indenters);
  json["displacements_mm"] = displacementsJson(design, step.displacements);
  json["resistances_ohm"] = matrixJson(step.resistances_ohm);
  json["max_volume_error"] = step.solution.maxVolumeError;
  return json;
}

void print(const std::vector<LoadCase>& path, const TouchPath& touched) {
  std::printf("%d elements (%s), %d unknowns\n", touched.problem.mesh().elementCount(),
              touched.problem.elementType().c_str(), touched.problem.dof());
  for (std::size_t k = 0; k < touched.steps.size(); ++k) {
    const Solution& solution = touched.steps[k].solution;
    if (solution.converged)
      std::printf("step %zu: converged in %d Newton iterations\n", k, solution.iterations());
    else
      std::printf("step %zu: not converged: reached %s of the step; %s\n", k,
                  withDigits(solution.reachedLoadFraction, 4).c_str(), solution.stopReason.c_str());
    for (std::size_t i = 0; i < solution.state().indenters.size(); ++i)
      printIndenter(path[k].indenters[i], solution.state().indenters[i]);
  }
}

} // namespace

void warnWhereFewNodesTouch(const LoadCase& load, const std::vector<IndenterState>& indenters, Session& session) {
  for (std::size_t k = 0; k < indenters.size(); ++k) {
    if (indenters[k].touchingNodes >= kFewTouchingNodes) continue;
    const std::string warning = shapeName(load.indenters[k].shape) + ": only " +
                                std::to_string(indenters[k].touchingNodes) +
                                " nodes of the mesh touch it; below about " + std::to_string(kFewTouchingNodes) +
                                " its depth and contact are inaccurate: choose a finer mesh";
    if (std::find(session.warnings.begin(), session.warnings.end(), warning) != session.warnings.end()) continue;
    session.warnings.push_back(warning);
    if (!session.json) std::cout << "warning: " << warning << '\n';
  }
}

Exit solvePath(const SensorDesign& design, const std::vector<LoadCase>& path, const MeshOptions& mesh,
               const NewtonOptions& options, const NewtonObserver& observer, const OutputFile& output,
               Session& session) {
  const TouchPath touched = followPath(design, path, mesh, options, observer, session.stages);
  const Solution& last = touched.steps.back().solution;
  const bool whole = touched.steps.size() == path.size() && last.converged;
  session.result["converged"] = whole;
  if (!last.stopReason.empty()) session.result["stop_reason"] = last.stopReason;
  session.result["dof"] = touched.problem.dof();
  session.result["elements"] = touched.problem.mesh().elementCount();
  session.result["element_type"] = touched.problem.elementType();
  session.result["resistances_at_rest_ohm"] = matrixJson(resistancesAtRest_ohm(design));
  Json& steps = session.result["steps"] = Json::array();
  for (std::size_t k = 0; k < touched.steps.size(); ++k) steps.push_back(stepJson(design, path[k], touched.steps[k]));
  if (!session.json) print(path, touched);
  for (std::size_t k = 0; k < touched.steps.size(); ++k)
    warnWhereFewNodesTouch(path[k], touched.steps[k].solution.state().indenters, session);
  if (!output.path.empty() && !session.stop.stop_requested()) {
    const NodalFields fields = touched.problem.fields(last.state());
    throwIfStopped(session.stop);
    exportVtu(output, touched.problem.mesh(), &fields, nullptr, session);
  }
  return whole ? Exit::Done : Exit::NoResult;
}

} // namespace palp
