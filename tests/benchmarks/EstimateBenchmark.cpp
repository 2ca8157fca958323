// The estimate of the discretisation error beside the error itself, on designs, loads and meshes of which none was used
// to calibrate it. Prints a Markdown table and its worst factors.
//   estimate_benchmark [FIRST [COUNT]]   designs FIRST .. FIRST + COUNT - 1 of the list (default: all)
// The truth is the solution on a mesh that has at least 2.8 times the nodes of the default mesh.
#include "solver/DiscretisationError.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace palp;

namespace {

struct NamedLoad {
  std::string name;
  LoadCase load;
};

struct Validation {
  std::string name;
  SensorDesign design;
  std::vector<NamedLoad> loads;
};

NamedLoad onArea(int area, const Eigen::Vector3d& force_N) {
  char name[80];
  std::snprintf(name, sizeof name, "area %d, (%g, %g, %g) N", area, force_N.x(), force_N.y(), force_N.z());
  return {name, {{{area, force_N}}, {}}};
}

NamedLoad onDisc(const Eigen::Vector2d& centre_mm, double radius_mm, const Eigen::Vector3d& force_N) {
  char name[120];
  std::snprintf(name, sizeof name, "disc of %g mm at (%g, %g) mm, (%g, %g, %g) N", radius_mm, centre_mm.x(),
                centre_mm.y(), force_N.x(), force_N.y(), force_N.z());
  return {name, {{}, {{centre_mm, radius_mm, force_N}}}};
}

SensorDesign ofMaterial(double poissonRatio, double c10_MPa, double c01_MPa) {
  SensorDesign design = paperDesign();
  design.material.poissonRatio = poissonRatio;
  design.material.law = MooneyRivlin{c10_MPa, c01_MPa};
  return design;
}

SensorDesign withUpperAt(double z_mm) {
  SensorDesign design = paperDesign();
  design.upper.z_mm = {{z_mm}};
  return design;
}

/// The paper's block with another plan; the electrodes' places grow with it.
SensorDesign ofPlan(double x_mm, double y_mm) {
  SensorDesign design = paperDesign();
  const double alongX = x_mm / design.block_mm.x(), alongY = y_mm / design.block_mm.y();
  design.block_mm.head<2>() << x_mm, y_mm;
  for (double& y : design.upper.wire_mm) y *= alongY;
  for (double& x : design.upper.along_mm[0]) x *= alongX;
  for (double& x : design.lower.wire_mm) x *= alongX;
  for (double& y : design.lower.along_mm[0]) y *= alongY;
  return design;
}

SensorDesign ofHeight(double z_mm) {
  SensorDesign design = paperDesign();
  design.block_mm.z() = z_mm;
  design.upper.z_mm = {{0.8 * z_mm}};
  design.lower.z_mm = {{0.2 * z_mm}};
  return design;
}

SensorDesign withAreas(int columns, int rows) {
  SensorDesign design = paperDesign();
  design.areas = {columns, rows};
  return design;
}

std::vector<Validation> validations() {
  const double c10 = MooneyRivlin().c10_MPa, c01 = MooneyRivlin().c01_MPa;
  return {
      {"nu 0.3", ofMaterial(0.3, c10, c01), {onArea(0, {1, 0, -6}), onArea(4, {-1, 1, -2})}},
      {"nu 0.45", ofMaterial(0.45, c10, c01), {onArea(2, {0, 0, -4}), onArea(1, {1, 0, 0})}},
      {"nu 0.49", ofMaterial(0.49, c10, c01), {onArea(3, {1, -1, -5}), onArea(4, {0, 0, -6})}},
      {"nu 0.5", ofMaterial(0.5, c10, c01), {onArea(0, {0, 1, -6}), onArea(1, {0, 0, -3})}},
      {"c01 = 0", ofMaterial(0.499, c10 + c01, 0), {onArea(5, {1, 1, -6}), onArea(1, {0, 1, -1})}},
      {"c01 = c10", ofMaterial(0.499, 0.2, 0.2), {onArea(2, {1, 1, -6}), onArea(4, {0, 0, -3})}},
      {"ten times softer", ofMaterial(0.49, c10 / 10, c01 / 10), {onArea(0, {0.3, 0, -4}), onArea(4, {0, 0, -6})}},
      {"electrodes at 4.5 mm", withUpperAt(4.5), {onArea(0, {0, 0, -6}), onArea(4, {1, 0, -3})}},
      {"electrodes at 3 mm", withUpperAt(3), {onArea(0, {0, 0, -6}), onArea(4, {1, 0, -3})}},
      {"electrodes at 1.5 mm", withUpperAt(1.5), {onArea(3, {0, 0, -6}), onArea(1, {1, 0, -3})}},
      {"plan 20 x 40", ofPlan(20, 40), {onArea(0, {0, 1, -6}), onArea(4, {1, 0, -4})}},
      {"plan 60 x 60", ofPlan(60, 60), {onArea(0, {1, 0, -6}), onArea(1, {0, 0, -20})}},
      {"plan 40 x 20", ofPlan(40, 20), {onArea(5, {0, 1, -6}), onArea(1, {0, 0, -4})}},
      {"height 2 mm", ofHeight(2), {onArea(0, {1, 0, -6}), onArea(4, {0, 1, -3})}},
      {"height 12 mm", ofHeight(12), {onArea(0, {1, 0, -6}), onArea(4, {0, 1, -3})}},
      {"areas 2 x 2", withAreas(2, 2), {onArea(0, {1, 0, -6}), onArea(3, {0, 1, -1})}},
      {"areas 4 x 3", withAreas(4, 3), {onArea(0, {1, 0, -4}), onArea(5, {0, 1, -3})}},
      {"large loads", paperDesign(), {onArea(0, {5, -5, -60}), onArea(4, {0, 0, -40})}},
      {"two areas",
       paperDesign(),
       {{"areas 0 and 4, (1, 0, -3) and (0, -1, -2) N", {{{0, {1, 0, -3}}, {4, {0, -1, -2}}}, {}}}}},
      {"disc", paperDesign(), {onDisc({10, 12}, 1, {0, 0, -2})}},
      {"disc", paperDesign(), {onDisc({15, 15}, 2.5, {0.5, 0, -4})}},
      {"disc", paperDesign(), {onDisc({5, 21}, 0.5, {0, 0.1, -0.5})}},
      {"disc", paperDesign(), {onDisc({25.5, 26}, 3.5, {0, 0, -5})}},
      {"disc, 60 x 60", ofPlan(60, 60), {onDisc({23, 31}, 2, {0, 0, -3})}},
      {"disc, nu 0.45, 12 mm",
       [] {
         SensorDesign design = ofHeight(12);
         design.material.poissonRatio = 0.45;
         return design;
       }(),
       {onDisc({8, 20}, 1.5, {0.3, 0.3, -2})}},
  };
}

/// Prints a row for each load and mesh, and adds their factors estimate / error.
void compare(const Validation& validation, std::vector<double>& factors) {
  const SensorDesign& design = validation.design;
  const std::vector<FineDisc> discs = fineDiscs(validation.loads[0].load); // a disc's design has one load
  const auto meshOfSize = [&](double factor) {
    const double size_mm = factor * standardMeshSize_mm(design);
    return sensorMesh(design, {.meshSize_mm = size_mm, .mapped = {}, .discs = discs});
  };
  const Mesh standard = meshOfSize(1);
  double finest = 0.57;
  while (meshOfSize(finest).nodeCount() < 2.8 * standard.nodeCount()) finest *= 0.93;
  const HyperelasticProblem fine(design, meshOfSize(finest));
  std::vector<Solution> best;
  for (const NamedLoad& load : validation.loads) best.push_back(fine.solve(load.load, {.relativeTolerance = 1e-6}));
  fine.releaseFactor();
  for (const double factor : {1., 1.5}) {
    const HyperelasticProblem problem(design, factor == 1 ? standard : meshOfSize(factor));
    for (std::size_t i = 0; i < best.size(); ++i) {
      const LoadCase& load = validation.loads[i].load;
      std::printf("| %s | %s | %g | %.1f |", validation.name.c_str(), validation.loads[i].name.c_str(), factor,
                  double(fine.dof()) / problem.dof());
      const Solution solution = problem.solve(load);
      const Eigen::Matrix3Xd truth = fine.electrodes(best[i].state()).upper_mm;
      const double error = (problem.electrodes(solution.state()).upper_mm - truth).norm() / truth.norm();
      const DiscretisationError estimate = discretisationError(problem, load, solution);
      if (!best[i].converged || !solution.converged) {
        std::printf(" no solution | | |\n");
      } else if (!estimate.relative) {
        std::printf(" %.2f | %s | |\n", 100 * error, estimate.method.c_str());
      } else {
        factors.push_back(*estimate.relative / error);
        std::printf(" %.2f | %.2f | %.2f |\n", 100 * error, 100 * *estimate.relative, factors.back());
      }
      std::fflush(stdout);
    }
  }
}

} // namespace

int main(int argc, char** argv) {
  const std::vector<Validation> all = validations();
  const std::size_t first = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 0;
  const std::size_t count = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : all.size();
  std::printf("| design | load | mesh size / default | unknowns, truth / mesh | error [%%] | estimate [%%] | "
              "estimate / error |\n|---|---|---|---|---|---|---|\n");
  std::vector<double> factors;
  for (std::size_t i = first; i < std::min(all.size(), first + count); ++i) compare(all[i], factors);
  if (factors.empty()) return 1;
  const auto [lowest, highest] = std::minmax_element(factors.begin(), factors.end());
  std::printf("\n%zu estimates, %.2f to %.2f times the error\n", factors.size(), *lowest, *highest);
  return 0;
}
