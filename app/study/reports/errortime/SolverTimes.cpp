#include "app/study/reports/errortime/SolverTimes.h"

#include "app/study/reports/MeshShare.h"
#include "app/study/reports/ProcessMemory.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/errortime/CalculixRun.h"
#include "app/study/reports/errortime/Extrapolation.h"
#include "io/DesignFile.h"
#include "solver/CalculixDeck.h"
#include "solver/HyperelasticProblem.h"

#include <cmath>
#include <limits>

namespace palp {

namespace {

/// Ratio of the sizes of the three meshes that are extrapolated from.
constexpr double kRefinement = 1.5;
/// Unknowns above which a mesh runs once: three runs of it would take minutes.
constexpr int kOnceAbove = 60000;
constexpr double kFinest_mm = 1.6;
constexpr int kPublishedRow = 4;
constexpr double kCalculixOnceAbove_s = 15;
constexpr double kCalculixLimit_s = 60;

struct Plan {
  std::string family;
  MeshOptions options;
};

std::vector<Plan> plans(const SensorDesign& design, bool quick) {
  std::vector<Plan> result;
  const std::vector<double> sizes = quick ? std::vector{8.0, 5.4, 3.6} : std::vector{8.0, 5.4, 3.6, 2.4, kFinest_mm};
  for (const double size : sizes) {
    MeshOptions mesh;
    mesh.meshSize_mm = size * meshShare(design);
    result.push_back({"tetrahedra, graded", mesh});
  }
  result.push_back({"tetrahedra, graded", {}}); // the default
  using Counts = std::array<int, 3>;
  const std::vector<Counts> counts = quick ? std::vector{Counts{5, 5, 3}, Counts{10, 10, 5}}
                                           : std::vector{Counts{5, 5, 3}, Counts{10, 10, 5}, Counts{15, 15, 8},
                                                         Counts{20, 20, 10}, Counts{30, 30, 15}};
  for (const Counts& count : counts) {
    MeshOptions mesh;
    mesh.mapped = count;
    result.push_back({"hexahedra, mapped", mesh});
  }
  return result;
}

std::string nameOf(const MeshOptions& mesh) {
  if (mesh.meshSize_mm) return "--mesh-size " + shortNumber(*mesh.meshSize_mm);
  if (!mesh.mapped) return "default";
  const auto& [x, y, z] = *mesh.mapped;
  return "--mapped " + std::to_string(x) + "x" + std::to_string(y) + "x" + std::to_string(z);
}

std::vector<JudgedLoad> judgedLoads(const SensorDesign& design) {
  const Eigen::Vector3d low = design.forceRange.low_N, high = design.forceRange.high_N;
  const int middle = design.areas.columns / 2;
  std::vector<JudgedLoad> loads(3);
  loads[0].name = "middle of the range on area 0";
  loads[0].load.areas.push_back({0, (low + high) / 2});
  loads[1].name = "corner of the range on area " + std::to_string(middle);
  loads[1].load.areas.push_back({middle, {high.x(), high.y(), low.z()}});
  loads[2].name = "shear alone on the last area";
  loads[2].load.areas.push_back({design.areas.count() - 1, {high.x(), low.y(), 0}});
  return loads;
}

/// Runs one mesh through its phases; displacements of the upper electrodes, a load.
class MeshRun {
public:
  MeshRun(const SensorDesign& design, const Plan& plan, const std::vector<PublishedSolution>& published, int threads,
          std::stop_token stop)
      : design_(design), published_(published), stop_(std::move(stop)) {
    times.family = plan.family;
    times.options = plan.options;
    times.mesh = nameOf(plan.options);
    newton_.threads = threads;
  }

  void measure(const std::vector<JudgedLoad>& loads, int repeats) {
    Mesh mesh;
    times.meshing = timed(repeats, [&] { mesh = sensorMesh(design_, times.options); });
    times.elements = mesh.elementCount();
    times.size_mm = std::sqrt(design_.block_mm.x() * design_.block_mm.y() * design_.block_mm.z() / times.elements);
    const int runs = freeUnknowns(mesh) > kOnceAbove ? 1 : repeats;
    for (int i = 0; i < runs && !stop_.stop_requested(); ++i) {
      resetPeakMemory();
      const double before_MB = heldMemory_MB();
      once(mesh, loads, i == 0);
      if (i == 0) times.process_MB = peakMemory_MB() - before_MB;
    }
  }

  MeshTimes times;
  std::vector<Eigen::Matrix3Xd> displacements_mm; ///< empty where the load has no answer

private:
  void once(const Mesh& mesh, const std::vector<JudgedLoad>& loads, bool first) {
    std::optional<HyperelasticProblem> problem;
    times.pattern.seconds.push_back(secondsOf([&] {
      problem.emplace(design_, mesh);
      problem->findOrdering();
    }));
    std::size_t factorBytes = 0;
    times.factorisation.seconds.push_back(
        secondsOf([&] { factorBytes = problem->findFactor(newton_.threads, stop_); }));
    if (factorBytes == 0) return; // stopped
    times.dof = problem->dof();
    times.factor_MB = static_cast<double>(factorBytes) / (1024.0 * 1024);
    double seconds = 0;
    std::vector<double> loadSeconds;
    for (const JudgedLoad& load : loads) {
      Solution solution;
      loadSeconds.push_back(
          secondsOf([&] { solution = problem->solve(load.load, newton_, {.step = {}, .stop = stop_}); }));
      seconds += loadSeconds.back();
      if (!solution.converged) times.failed = load.name + ": " + solution.stopReason;
      if (!first) continue;
      displacements_mm.push_back(solution.converged ? problem->electrodes(solution.state()).upper_mm
                                                    : Eigen::Matrix3Xd()); // not of a part of the load
    }
    if (first) times.loadSeconds = loadSeconds;
    for (std::size_t l = 0; l < loads.size(); ++l)
      times.loadSeconds[l] = std::min(times.loadSeconds[l], loadSeconds[l]);
    times.solving.seconds.push_back(seconds / static_cast<double>(loads.size()));
    if (first) judgeByPublished(*problem);
  }

  void judgeByPublished(const HyperelasticProblem& problem) {
    for (const PublishedSolution& published : published_) {
      LoadCase load;
      load.areas.push_back({published.area, published.force_N});
      const Solution solution = problem.solve(load, newton_, {.step = {}, .stop = stop_});
      const Eigen::Index count = published.displacements_mm.cols();
      const Eigen::Matrix3Xd ours =
          problem.electrodes(solution.state()).upper_mm.middleCols(kPublishedRow * count, count);
      times.publishedErrors.push_back(solution.converged ? (ours - published.displacements_mm).norm() /
                                                               published.displacements_mm.norm()
                                                         : std::numeric_limits<double>::quiet_NaN());
    }
  }

  const SensorDesign& design_;
  const std::vector<PublishedSolution>& published_;
  std::stop_token stop_;
  NewtonOptions newton_;
};

/// Not a number where one of them has no answer.
double relativeTo(const Eigen::Matrix3Xd& reference_mm, const Eigen::Matrix3Xd& found_mm) {
  if (reference_mm.size() == 0 || found_mm.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  return (found_mm - reference_mm).norm() / reference_mm.norm();
}

/// CalculiX on a mesh under every load, its complete process timed (the first load `repeats` times, the others once);
/// meshed by us.
MeshTimes calculixTimes(const std::string& program, const SensorDesign& design, const MeshOptions& options,
                        const std::vector<JudgedLoad>& loads, int repeats, int threads, const std::stop_token& stop) {
  MeshTimes times;
  times.options = options;
  times.family = options.mapped ? "CalculiX, C3D8 mapped" : "CalculiX, C3D10 graded";
  times.mesh = "CalculiX " + nameOf(options);
  Mesh mesh;
  times.meshing = timed(repeats, [&] { mesh = sensorMesh(design, options); });
  times.dof = freeUnknowns(mesh);
  times.elements = mesh.elementCount();
  times.factor_MB = std::numeric_limits<double>::quiet_NaN(); // not reported
  for (std::size_t l = 0; l < loads.size() && times.failed.empty(); ++l) {
    Timing timing;
    const int runs = l == 0 ? repeats : 1;
    for (int i = 0; i < runs && timing.median() < kCalculixOnceAbove_s; ++i) {
      const CalculixRun run = runCalculix(program, design, mesh, loads[l].load, threads, kCalculixLimit_s, stop);
      timing.seconds.push_back(run.seconds);
      times.process_MB = std::max(times.process_MB, run.peak_MB);
      if (!run.failed.empty()) {
        times.failed = loads[l].name + ": " + run.failed;
        break;
      }
      if (i > 0) continue;
      const Eigen::Matrix3Xd upper = upperElectrodes_mm(run, design, mesh);
      times.errors.push_back(relativeTo(loads[l].reference_mm, upper));
    }
    times.loadSeconds.push_back(timing.median());
    if (l == 0) times.solving = timing;
  }
  return times;
}

/// No reference where too few of these, the finest last, have an answer.
void judgeBy(JudgedLoad& load, const std::vector<Eigen::Matrix3Xd>& answers_mm) {
  std::vector<Eigen::VectorXd> answers;
  for (const Eigen::Matrix3Xd& answer_mm : answers_mm) answers.emplace_back(answer_mm.reshaped());
  const auto truth = extrapolated(answers, kRefinement);
  load.order = truth ? truth->order : std::numeric_limits<double>::quiet_NaN();
  load.uncertainty = truth ? truth->uncertainty : std::numeric_limits<double>::quiet_NaN();
  if (truth) load.reference_mm = truth->value.reshaped(3, truth->value.size() / 3);
}

void addCalculix(SolverTimes& result, const SensorDesign& design, bool quick, int repeats, int threads,
                 const ReportProgress& progress, const std::stop_token& stop) {
  const auto program = calculixProgram();
  if (!program || !(design.material.poissonRatio < 0.5)) return;
  std::vector<MeshOptions> choices(quick ? 1 : 5);
  choices[0].mapped = {10, 10, 5};
  if (!quick) {
    choices[1].mapped = {20, 20, 10};
    choices[2].meshSize_mm = 8 * meshShare(design);
    choices[3].meshSize_mm = 5.4 * meshShare(design);
    choices[4].meshSize_mm = 3.6 * meshShare(design);
  }
  result.deck = calculixDeck(design, sensorMesh(design, choices[0]), result.loads[0].load);
  for (const MeshOptions& options : choices) {
    if (stop.stop_requested()) return;
    if (progress) progress(1, "CalculiX, " + nameOf(options));
    result.meshes.push_back(calculixTimes(*program, design, options, result.loads, repeats, threads, stop));
  }
}

} // namespace

double MeshTimes::total_s() const {
  return meshing.median() + pattern.median() + factorisation.median() + solving.median();
}

std::optional<SolverTimes> solverTimes(const SensorDesign& design, bool quick, int repeats, int threads,
                                       const ReportProgress& progress, std::stop_token stop) {
  SolverTimes result;
  result.loads = judgedLoads(design);
  if (!quick && designFingerprint(design) == designFingerprint(paperDesign())) result.published = publishedSolutions();
  std::vector<std::vector<Eigen::Matrix3Xd>> displacements;
  const std::vector<Plan> all = plans(design, quick);
  std::vector<std::size_t> tets;
  for (std::size_t i = 0; i < all.size(); ++i) {
    MeshRun run(design, all[i], result.published, threads, stop);
    if (progress) progress(static_cast<double>(i) / static_cast<double>(all.size()), "solver, " + run.times.mesh);
    run.measure(result.loads, repeats);
    if (stop.stop_requested()) return {};
    if (all[i].options.meshSize_mm) tets.push_back(i);
    result.meshes.push_back(std::move(run.times));
    displacements.push_back(std::move(run.displacements_mm));
  }
  for (std::size_t l = 0; l < result.loads.size(); ++l) {
    std::vector<Eigen::Matrix3Xd> ofTets;
    for (const std::size_t i : tets) ofTets.push_back(displacements[i][l]);
    judgeBy(result.loads[l], ofTets);
    for (std::size_t i = 0; i < result.meshes.size(); ++i)
      result.meshes[i].errors.push_back(relativeTo(result.loads[l].reference_mm, displacements[i][l]));
  }
  addCalculix(result, design, quick, repeats, threads, progress, stop);
  if (stop.stop_requested()) return {};
  return result;
}

} // namespace palp
