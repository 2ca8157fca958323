// What the mesh leaves of d ln R under a load, and what the estimate says of it: each read-out beside a mesh that is
// much finer, displacements, pressures and field included. Prints Markdown tables and the worst of each column.
//   field_error_benchmark CASE [SET [FACTOR]]
//   CASE    held, following or pressure: the lower electrodes, or a pressure law where they follow
//   SET     paper (default): the paper's design, 11 loads, a = 0.2 mm; these calibrated the estimate
//           or a seed: twelve loads drawn from it, on other layouts, blocks and radii
//   FACTOR  of the default size, of the finer mesh (default 0.4)
#include "model/FieldAtRest.h"
#include "solver/ConductionField.h"
#include "solver/DiscretisationError.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>
#include <vector>

using namespace palp;

namespace {

struct Validation {
  std::string name;
  SensorDesign design;
  std::vector<LoadCase> loads;
};

LoadCase onArea(int area, const Eigen::Vector3d& force_N) {
  return {{{area, force_N}}, {}};
}

std::vector<LoadCase> paperLoads() {
  return {onArea(0, {0, 0, -0.3}),    onArea(0, {1, 0, -6}),
          onArea(4, {-1, 1, -2}),     onArea(1, {0, 1, 0}),
          onArea(3, {0, 0, -4}),      onArea(3, {0, 0, -6}),
          onArea(2, {0.05, 0, 0}),    onArea(5, {0.3, -0.2, -1}),
          onArea(1, {-0.5, 0.5, -4}), {{{0, {0.7, 0.7, -0.1}}, {4, {0, 0, -3}}}, {}},
          onArea(3, {-1, -1, -0.5})};
}

/// Straight wires at these heights; the upper electrodes stand `apart_mm` from one another.
SensorDesign straight(double upper_mm, double lower_mm, const std::array<double, 3>& along_mm) {
  SensorDesign design = paperDesign();
  design.upper.z_mm = {{upper_mm}};
  design.lower.z_mm = {{lower_mm}};
  design.lower.along_mm = {{along_mm.begin(), along_mm.end()}};
  return design;
}

/// The paper's block with another size; the electrodes' places grow with it.
SensorDesign ofBlock(const Eigen::Vector3d& block_mm) {
  SensorDesign design = paperDesign();
  const Eigen::Vector3d by = block_mm.cwiseQuotient(design.block_mm);
  design.block_mm = block_mm;
  for (double& y : design.upper.wire_mm) y *= by.y();
  for (double& x : design.upper.along_mm[0]) x *= by.x();
  for (double& x : design.lower.wire_mm) x *= by.x();
  for (double& y : design.lower.along_mm[0]) y *= by.y();
  design.upper.z_mm = {{0.8 * block_mm.z()}};
  design.lower.z_mm = {{0.2 * block_mm.z()}};
  return design;
}

/// Six designs of two loads each, forces and radii drawn from the seed.
std::vector<Validation> drawn(unsigned seed) {
  std::mt19937 engine(seed);
  const auto uniform = [&](double low, double high) { return low + (high - low) * (engine() / 4294967296.); };
  SensorDesign soft = paperDesign();
  soft.material.poissonRatio = 0.47;
  soft.areas = {2, 2};
  std::vector<Validation> all{{"paper", paperDesign(), {}},
                              {"z 4 and 3.2, y 12 13 16", straight(4, 3.2, {12, 13, 16}), {}},
                              {"z 2.7 and 1.8", straight(2.7, 1.8, {4.35, 16.2, 19.5}), {}},
                              {"24 x 36 x 4 mm", ofBlock({24, 36, 4}), {}},
                              {"30 x 30 x 8 mm", ofBlock({30, 30, 8}), {}},
                              {"2 x 2 areas, nu 0.47", soft, {}}};
  for (Validation& each : all) {
    FieldLaw law;
    law.electrodeRadius_mm = 0.01 * std::round(100 * uniform(0.08, 0.25));
    each.design.resistance = law;
    for (int load = 0; load < 2; ++load) {
      const auto part = [&](double most) { return 0.01 * std::round(100 * uniform(-most, most)); };
      const int area = static_cast<int>(uniform(0, each.design.areas.count()));
      const double press = load == 0 ? 0.1 * std::round(10 * uniform(-6, 0)) : part(0.5); // the second mostly shears
      each.loads.push_back(onArea(area, {part(1), part(1), std::min(press, 0.)}));
    }
  }
  return all;
}

std::string name(const LoadCase& load) {
  std::string all;
  for (const AreaLoad& area : load.areas) {
    char one[80];
    std::snprintf(one, sizeof one, "%s%d: (%g, %g, %g)", all.empty() ? "" : " and ", area.area, area.force_N.x(),
                  area.force_N.y(), area.force_N.z());
    all += one;
  }
  return all;
}

struct Seen {
  std::array<double, 4> error{}, quotient{}; ///< of each read-out: relative error of d ln R; estimate over it
};

/// Prints a row for each load.
void compare(const Validation& validation, double factor, std::vector<Seen>& seen) {
  SensorDesign design = validation.design;
  const HyperelasticProblem usual(design, sensorMesh(design));
  const HyperelasticProblem fine(
      design, sensorMesh(design, {.meshSize_mm = factor * standardMeshSize_mm(design), .mapped = {}}));
  const ConductionField onUsual(usual), onFine(fine);
  const FieldLaw law = *design.field();
  std::printf("\n%s, a = %g mm, %d and %d nodes; error of d ln R [%%] (estimate / error)\n\n| load |",
              validation.name.c_str(), law.electrodeRadius_mm, usual.mesh().nodeCount(), fine.mesh().nodeCount());
  for (const auto& each : kReadouts.all()) std::printf(" %s |", each.second);
  std::printf(" rms of d ln R, finer mesh |\n|---|---|---|---|---|---|\n");
  for (const LoadCase& load : validation.loads) {
    const Solution solution = usual.solve(load), truth = fine.solve(load, {.relativeTolerance = 1e-7});
    std::printf("| %s |", name(load).c_str());
    if (!solution.converged || !truth.converged) {
      std::printf(" no solution | | | | |\n");
      continue;
    }
    const auto found = onUsual.network(solution.state()), better = onFine.network(truth.state());
    Seen row;
    std::string sizes;
    for (std::size_t i = 0; i < 4; ++i) {
      FieldLaw readBy = law;
      readBy.readout = kReadouts.all()[i].first;
      const Eigen::ArrayXXd rest =
          NetworkReading(networkAtRest(design, law), readBy.readout).resistances_ohm().array().log();
      const Eigen::MatrixXd resistances = NetworkReading(*found, readBy.readout).resistances_ohm();
      const Eigen::ArrayXXd there = NetworkReading(*better, readBy.readout).resistances_ohm().array().log() - rest;
      row.error[i] = ((resistances.array().log() - rest) - there).matrix().norm() / there.matrix().norm();
      SensorDesign read = design;
      read.resistance = readBy;
      const auto estimate = discretisationError(usual.withLawOf(read), load, solution, {}, 0, &resistances).resistances;
      row.quotient[i] = estimate ? *estimate / row.error[i] : 0;
      std::printf(" %.2f (%.2f) |", 100 * row.error[i], row.quotient[i]);
      char one[40];
      std::snprintf(one, sizeof one, " %.3e", std::sqrt(there.square().mean()));
      sizes += one;
      std::fflush(stdout);
    }
    std::printf("%s |\n", sizes.c_str());
    seen.push_back(row);
  }
}

} // namespace

int main(int argc, char** argv) {
  const std::string_view kind = argc > 1 ? argv[1] : "", set = argc > 2 ? argv[2] : "paper";
  const double factor = argc > 3 ? std::strtod(argv[3], nullptr) : 0.4;
  if ((kind != "held" && kind != "following" && kind != "pressure") || !(factor > 0 && factor < 1)) {
    std::fprintf(stderr, "field_error_benchmark held|following|pressure [paper|SEED [FACTOR]]\n");
    return 2;
  }
  std::vector<Validation> all{{"paper", paperDesign(), paperLoads()}};
  if (set == "paper")
    all.front().design.resistance = FieldLaw{};
  else
    all = drawn(static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10)));
  std::vector<Seen> seen;
  for (Validation& each : all) {
    each.design.lowerFollowsRubber = kind != "held";
    if (kind == "pressure") each.design.pressureLaw = PressureLaw{};
    compare(each, factor, seen);
  }
  if (seen.empty()) return 1;
  Seen worst;
  int within = 0, estimates = 0;
  double lowest = 1e9, highest = 0;
  for (const Seen& row : seen)
    for (std::size_t i = 0; i < 4; ++i) {
      worst.error[i] = std::max(worst.error[i], row.error[i]);
      if (row.quotient[i] <= 0) continue;
      ++estimates;
      within += row.quotient[i] >= 1. / 3 && row.quotient[i] <= 3 ? 1 : 0;
      lowest = std::min(lowest, row.quotient[i]);
      highest = std::max(highest, row.quotient[i]);
    }
  std::printf("\nworst error [%%]:");
  for (std::size_t i = 0; i < 4; ++i) std::printf(" %s %.2f", kReadouts.all()[i].second, 100 * worst.error[i]);
  std::printf("\n%d estimates of %d within a factor of 3; %.2f to %.2f times the error\n", within, estimates, lowest,
              highest);
  return 0;
}
