#include "app/cli/Cli.h"
#include "app/cli/MeshCostLine.h"
#include "app/cli/Options.h"
#include "app/cli/Pictures.h"
#include "app/cli/commands/SolveJson.h"
#include "app/cli/commands/SolvePath.h"
#include "app/study/touch/Touch.h"
#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"
#include "solver/DiscretisationError.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <unistd.h>

namespace palp {

namespace {

using Json = nlohmann::ordered_json;

struct SolveArguments {
  std::string design;
  MeshChoice mesh;
  LoadOptions loads;
  std::string current;
  OutputFile output;
};

void report(const Touch& touch, const DiscretisationError* error, Session& session) {
  const Solution& solution = *touch.solution();
  Json& result = session.result;
  result["converged"] = solution.converged;
  result["reached_load_fraction"] = solution.reachedLoadFraction;
  if (!solution.stopReason.empty()) result["stop_reason"] = solution.stopReason;
  result["newton"] = newtonJson(solution.newton);
  result["dof"] = touch.problem()->dof();
  result["elements"] = touch.mesh()->elementCount();
  result["element_type"] = touch.problem()->elementType();
  result["displacements_mm"] = displacementsJson(touch.design(), *touch.displacements());
  result["resistances_ohm"] = matrixJson(*touch.resistances_ohm());
  result["resistances_at_rest_ohm"] = matrixJson(resistancesAtRest_ohm(touch.design()));
  if (const FieldLaw* law = touch.design().field()) {
    result["resistance_law"] = "field";
    result["readout"] = kReadouts.name(law->readout);
  }
  result["max_volume_error"] = solution.maxVolumeError;
  if (!touch.load().indenters.empty()) result["indenters"] = indentersJson(touch.load(), solution.state().indenters);
  if (!error) return;
  result["error_estimate_relative"] = error->relative ? Json(*error->relative) : Json();
  result["error_estimate_method"] = error->method;
  if (touch.design().field())
    result["resistance_error_estimate"] = error->resistances ? Json(*error->resistances) : Json();
}

void print(const Touch& touch, const DiscretisationError* error) {
  const Solution& solution = *touch.solution();
  const Eigen::Matrix3Xd& u = touch.displacements()->upper_mm;
  if (solution.converged)
    std::printf("converged in %d Newton iterations%s%s\n", solution.iterations(),
                solution.stopReason.empty() ? "" : "; ", solution.stopReason.c_str());
  else
    std::printf("not converged: reached %s of the load; %s\n", withDigits(solution.reachedLoadFraction, 4).c_str(),
                solution.stopReason.c_str());
  std::printf("%d elements (%s), %d unknowns\n", touch.mesh()->elementCount(), touch.problem()->elementType().c_str(),
              touch.problem()->dof());
  std::printf("largest electrode displacement %s mm, largest |J - 1| %s\n",
              withDigits(std::sqrt(u.colwise().squaredNorm().maxCoeff()), 6).c_str(),
              withDigits(solution.maxVolumeError, 3).c_str());
  const std::vector<IndenterState>& indenters = solution.state().indenters;
  for (std::size_t k = 0; k < indenters.size(); ++k) printIndenter(touch.load().indenters[k], indenters[k]);
  const Eigen::MatrixXd rest = resistancesAtRest_ohm(touch.design());
  std::printf(
      "largest |dR/R| %s %%\n",
      withDigits(100 * ((*touch.resistances_ohm() - rest).cwiseQuotient(rest)).cwiseAbs().maxCoeff(), 4).c_str());
  if (error && error->relative)
    std::printf("discretisation error of the electrode displacements about %s %% (%s)\n",
                withDigits(100 * *error->relative, 2).c_str(), error->method.c_str());
  else if (error)
    std::printf("discretisation error of the electrode displacements: %s\n", error->method.c_str());
  if (error && error->resistances)
    std::printf("discretisation error of d ln R, read by %s, about %s %%\n",
                std::string(kReadouts.name(touch.design().field()->readout)).c_str(),
                withDigits(100 * *error->resistances, 2).c_str());
}

/// Row-wire and column-wire of --current ROW,COLUMN.
std::optional<std::pair<int, int>> currentOption(const SolveArguments& arguments, const SensorDesign& design) {
  if (arguments.current.empty()) return {};
  if (!design.field())
    throw UsageError("--current: resistance.law: " +
                     gotExpected("pairs, which has no current in the rubber", "a design with field"));
  if (arguments.output.path.empty())
    throw UsageError("--current: -o FILE is missing, the VTU file to write the fields to");
  const std::size_t comma = arguments.current.find(',');
  if (comma == std::string::npos) throw badValue("--current", arguments.current, "ROW,COLUMN, for example 4,15");
  return std::pair{
      wholeNumber("--current (row-wire)", arguments.current.substr(0, comma), 0, design.rowWires() - 1),
      wholeNumber("--current (column-wire)", arguments.current.substr(comma + 1), 0, design.columnWires() - 1)};
}

/// Newton as it goes, for a terminal.
NewtonObserver observer(const Session& session) {
  NewtonObserver observer;
  observer.stop = session.stop;
  if (isatty(STDERR_FILENO) == 1)
    observer.step = [](const NewtonStep& step) {
      std::fprintf(stderr, "load %s, iteration %d, residual %s\n", withDecimals(step.loadFraction, 4).c_str(),
                   step.iteration, withExponent(step.relativeResidual, 2).c_str());
    };
  return observer;
}

Exit runPath(const SolveArguments& arguments, const SensorDesign& design, Session& session) {
  if (!arguments.current.empty()) throw UsageError("--current: not together with --loads; give a single load");
  if (arguments.mesh.relativeAccuracy())
    throw UsageError("--accuracy: not together with --loads; give --mesh-size or --mapped");
  const std::vector<LoadCase> path = arguments.loads.loadPath(design);
  arguments.output.requireWritable();
  NewtonOptions options;
  options.threads = session.threads;
  printMeshCost(design, meshFor(design, path.front(), arguments.mesh.options()), session);
  return solvePath(design, path, arguments.mesh.options(), options, observer(session), arguments.output, session);
}

Exit run(const SolveArguments& arguments, Session& session) {
  const SensorDesign design = designOption(arguments.design);
  if (!arguments.loads.pathFile.empty()) return runPath(arguments, design, session);
  const LoadCase load = arguments.loads.loadCase(design);
  const auto pair = currentOption(arguments, design);
  arguments.output.requireWritable();
  printMeshCost(design, meshFor(design, load, arguments.mesh.options()), session);
  Touch touch(design, load, arguments.mesh.options());
  NewtonOptions options;
  options.threads = session.threads;
  options.oneTangent = true; // there is no next solve
  if (const auto accuracy = arguments.mesh.relativeAccuracy())
    touch.setMesh(session.stages.measure(
        "mesh", [&] { return meshForAccuracy(design, load, *accuracy, session.stop, session.threads); }));
  touch.advance(Stage::Resistances, options, observer(session));
  session.stages.add(touch.stages());
  std::optional<DiscretisationError> error;
  if (touch.solution()->converged) {
    try {
      error = session.stages.measure("estimate", [&] {
        return discretisationError(*touch.problem(), load, *touch.solution(), session.stop, session.threads,
                                   touch.resistances_ohm());
      });
    } catch (const Cancelled&) { // the solution is kept
    }
  }
  report(touch, error ? &*error : nullptr, session);
  if (!session.json) print(touch, error ? &*error : nullptr);
  if (touch.solution()->converged) warnWhereFewNodesTouch(load, touch.solution()->state().indenters, session);
  if (!arguments.output.path.empty() && !session.stop.stop_requested()) { // half a solve has no result
    const NodalFields fields = touch.problem()->fields(touch.solution()->state());
    std::optional<CurrentField> current;
    if (pair)
      current = touch.field()->current(touch.solution()->state(), *touch.network(), touch.design().field()->readout,
                                       pair->first, pair->second, session.threads, session.stop);
    throwIfStopped(session.stop);
    exportVtu(arguments.output, *touch.mesh(), &fields, current ? &*current : nullptr, session);
  }
  return touch.solution()->converged ? Exit::Done : Exit::NoResult;
}

} // namespace

void addSolve(Cli& cli) {
  auto arguments = std::make_shared<SolveArguments>();
  Command command = cli.command("solve", "Solves the deformation of the block under loads that act together.",
                                "palp solve paper --load 0:1,0,-6 --load 5:0,0.5,-2 --json",
                                [arguments](Session& session) { return run(*arguments, session); });
  command.option("design", arguments->design, "DESIGN", "design file, or paper").required();
  arguments->loads.declare(command);
  arguments->loads.declareIndenters(command);
  arguments->loads.declarePath(command);
  arguments->mesh.declare(command, true);
  command.group("Output");
  command.option("--current", arguments->current, "ROW,COLUMN",
                 "write potential, current density and power density for 1 V between the two wires to the VTU file "
                 "(field law)");
  arguments->output.declare(
      command, "VTU file to write: displacement, stress, pressure, volume ratio and contact traction at the nodes");
}

} // namespace palp
