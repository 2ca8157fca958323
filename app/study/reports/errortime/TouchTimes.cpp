#include "app/study/reports/errortime/TouchTimes.h"

#include "app/study/reports/ReportText.h"
#include "app/study/reports/Timing.h"
#include "app/study/reports/errortime/CalculixRun.h"
#include "app/study/reports/errortime/Extrapolation.h"
#include "solver/HyperelasticProblem.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace palp {

namespace {

constexpr double kTouchRefinement = std::numbers::sqrt2;
constexpr double kTouchOrder = 1.3;   // of the error in the size, as the error estimate takes it
constexpr double kTouchLimit_s = 400; // of CalculiX, a run

struct Touch {
  std::string name;
  LoadCase load;
};

/// One mesh and its results.
struct TouchRun {
  std::string program, mesh;
  int dof = 0, elements = 0;
  double seconds = 0; ///< from scratch to the result
  Eigen::VectorXd force_N, electrodes_mm;
  double forceError = 0, electrodeError = 0; ///< relative
  std::string failed;
};

/// A sphere as large as the block is high, in its middle.
std::vector<Touch> testedTouches(const ReportText& words, const SensorDesign& design, bool quick) {
  const double h = design.block_mm.z();
  const Eigen::Vector2d middle = design.block_mm.head<2>() / 2;
  const Eigen::Vector2d shift_mm = {0.04 * h, 0};
  Touch plain{words("sphere", {{"radius", h}, {"depth", 0.08 * h}}), {}};
  plain.load.indenters = {{IndenterShape::Sphere, h, 0, middle, 0, Motion{0.08 * h, {0, 0}}}};
  if (quick) return {plain};
  Touch rough{words("sliding sphere", {{"radius", h}, {"depth", 0.08 * h}, {"shift", shift_mm.x()}}), {}};
  rough.load.indenters = {{IndenterShape::Sphere, h, 0, middle, 0.5, Motion{0.08 * h, shift_mm}}};
  return {plain, rough};
}

MeshOptions sized(const SensorDesign& design, const LoadCase& load, double factor) {
  MeshOptions options = meshFor(design, load, {});
  options.meshSize_mm = factor * standardMeshSize_mm(design);
  return options;
}

TouchRun ourTouch(const SensorDesign& design, const Touch& touch, double factor, int threads,
                  const std::stop_token& stop) {
  TouchRun run;
  const MeshOptions options = sized(design, touch.load, factor);
  run.program = "Palp";
  run.mesh = "--mesh-size " + shortNumber(*options.meshSize_mm) + (factor == 1 ? " (default)" : "");
  NewtonOptions newton;
  newton.threads = threads;
  run.seconds = secondsOf([&] {
    const HyperelasticProblem problem(design, sensorMesh(design, options));
    const Solution solution = problem.solve(touch.load, newton, {.step = {}, .stop = stop});
    run.dof = problem.dof();
    run.elements = problem.mesh().elementCount();
    if (!solution.converged) {
      run.failed = solution.stopReason;
      return;
    }
    run.force_N = solution.state().indenters[0].force_N;
    run.electrodes_mm = problem.electrodes(solution.state()).upper_mm.reshaped();
  });
  return run;
}

TouchRun calculixTouch(const std::string& program, const SensorDesign& design, const Touch& touch, MeshOptions options,
                       int threads, const std::stop_token& stop) {
  TouchRun run;
  run.program = options.mapped ? "CalculiX, C3D8 mapped" : "CalculiX, C3D10 graded";
  Mesh mesh;
  run.seconds = secondsOf([&] { mesh = sensorMesh(design, options); });
  run.mesh = options.mapped ? "--mapped 20x20x10" : "--mesh-size " + shortNumber(*options.meshSize_mm);
  run.dof = freeUnknowns(mesh);
  run.elements = mesh.elementCount();
  const CalculixRun found = runCalculix(program, design, mesh, touch.load, threads, kTouchLimit_s, stop);
  run.seconds += found.seconds;
  run.failed = found.failed;
  if (run.failed.empty() && !found.reaction_N) run.failed = "CalculiX ended without the clamped face's force";
  if (!run.failed.empty()) return run;
  run.force_N = -*found.reaction_N; // the indenter's on the block
  run.electrodes_mm = upperElectrodes_mm(found, design, mesh).reshaped();
  return run;
}

ReportChart chartOf(const ReportText& words, const std::vector<TouchRun>& runs, const std::string& file,
                    const std::string& what, const std::string& touch, double TouchRun::*error) {
  ReportChart chart = words.chart(file, "chart", {{"touch", touch}, {"what", what}});
  chart.logX = chart.logY = true;
  for (const TouchRun& run : runs) {
    if (!run.failed.empty()) continue;
    if (chart.curves.empty() || chart.curves.back().name != run.program) chart.curves.push_back({.name = run.program});
    chart.curves.back().x.push_back(run.seconds);
    chart.curves.back().y.push_back(100 * (run.*error));
  }
  return chart;
}

/// What the runs are compared with.
struct TouchReference {
  Extrapolation force, electrodes;
};

/// From the last two of our runs; none where one of them failed.
std::optional<TouchReference> referenceOf(const std::vector<TouchRun>& runs) {
  const TouchRun &coarse = runs[runs.size() - 2], &fine = runs.back();
  if (!coarse.failed.empty() || !fine.failed.empty()) return {};
  const double refinement = std::cbrt(double(fine.dof) / coarse.dof);
  return TouchReference{extrapolated(coarse.force_N, fine.force_N, refinement, kTouchOrder),
                        extrapolated(coarse.electrodes_mm, fine.electrodes_mm, refinement, kTouchOrder)};
}

ReportTable tableOf(const ReportText& words, const Touch& touch, const TouchReference& reference,
                    const std::vector<TouchRun>& runs) {
  const Eigen::VectorXd& force_N = reference.force.value;
  ReportTable table = words.table("table", {{"touch", touch.name},
                                            {"force", force_N.head<3>()},
                                            {"force_error", 100 * reference.force.uncertainty},
                                            {"electrode_error", 100 * reference.electrodes.uncertainty}});
  for (const TouchRun& run : runs) {
    const bool done = run.failed.empty();
    table.add({run.program, run.mesh, run.elements, run.dof, run.seconds,
               done ? shortNumber(100 * run.forceError) : "failed: " + run.failed,
               done ? shortNumber(100 * run.electrodeError) : "-"},
              done ? ReportTable::Mark::Plain : ReportTable::Mark::Bad);
  }
  return table;
}

/// The meshes that CalculiX runs on: it takes minutes where ours take a second.
std::vector<MeshOptions> calculixMeshes(const SensorDesign& design, const LoadCase& load, bool quick) {
  if (quick) return {sized(design, load, 4)};
  return {sized(design, load, 3), sized(design, load, 2), {.meshSize_mm = {}, .mapped = {{20, 20, 10}}}};
}

} // namespace

bool addTouchTimes(const ReportRequest& request, bool quick, const ReportProgress& progress,
                   const std::stop_token& stop, ReportContent& content, Csv& csv) {
  const SensorDesign& design = request.design;
  const std::vector<double> factors = quick ? std::vector{4.0, 4.0 / kTouchRefinement, 2.0}
                                            : std::vector{2.0, kTouchRefinement, 1.0, 1 / kTouchRefinement};
  const auto program = design.material.poissonRatio < 0.5 ? calculixProgram() : std::nullopt;
  const ReportText words("touch-times");
  content.parts.emplace_back(ReportHeading{words("heading")});
  content.parts.emplace_back(ReportWords{words("method", {{"calculix", words(program ? "calculix" : "no calculix")}})});
  const std::vector<Touch> touches = testedTouches(words, design, quick);
  for (std::size_t t = 0; t < touches.size(); ++t) {
    const Touch& touch = touches[t];
    const ReportProgress own = partOf(progress, static_cast<double>(t) / static_cast<double>(touches.size()),
                                      1 / static_cast<double>(touches.size()));
    const std::vector<MeshOptions> theirs =
        program ? calculixMeshes(design, touch.load, quick) : std::vector<MeshOptions>{};
    std::vector<TouchRun> runs;
    const auto report = [&](const std::string& what) {
      own(static_cast<double>(runs.size()) / static_cast<double>(factors.size() + theirs.size()), what);
    };
    for (const double factor : factors) {
      report(touch.name);
      runs.push_back(ourTouch(design, touch, factor, request.threads, stop));
      if (stop.stop_requested()) return false;
    }
    const std::optional<TouchReference> reference = referenceOf(runs);
    if (!reference) {
      content.parts.emplace_back(
          ReportWords{words("no reference", {{"touch", touch.name}, {"why", runs.back().failed}})});
      continue;
    }
    for (const MeshOptions& options : theirs) {
      report("CalculiX, " + touch.name);
      runs.push_back(calculixTouch(*program, design, touch, options, request.threads, stop));
      if (stop.stop_requested()) return false;
    }
    for (TouchRun& run : runs) {
      if (!run.failed.empty()) continue;
      run.forceError = (run.force_N - reference->force.value).norm() / reference->force.value.norm();
      run.electrodeError =
          (run.electrodes_mm - reference->electrodes.value).norm() / reference->electrodes.value.norm();
      for (const auto& [what, error] :
           {std::pair{"force of the touch", run.forceError}, std::pair{"electrode displacements", run.electrodeError}})
        csv.add(
            {"touch", run.program + ", " + run.mesh, touch.name, what, 100 * error, run.seconds, "", run.dof, "", ""});
    }
    content.parts.emplace_back(tableOf(words, touch, *reference, runs));
    const std::string number = std::to_string(t);
    content.parts.emplace_back(
        chartOf(words, runs, "touch_force_" + number, "force", touch.name, &TouchRun::forceError));
    content.parts.emplace_back(
        chartOf(words, runs, "touch_electrodes_" + number, "electrodes", touch.name, &TouchRun::electrodeError));
  }
  return true;
}

} // namespace palp
