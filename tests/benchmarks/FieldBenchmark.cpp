// What the field costs. Tables of times, each the least of some runs:
//   field_benchmark layout   a layout at rest, step by step, and the error of what comes out against a quadrature that
//   is
//                            much finer
//   field_benchmark state    one solved state of the paper's design on its default mesh, beside its solve, and another
//                            read-out of it
//   field_benchmark samples  600 samples by the surrogate, whose error is measured on states that were not fitted
// All of them without an argument.
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/touch/SampleGenerator.h"
#include "model/FieldAtRest.h"
#include "model/FieldSensitivity.h"
#include "solver/ConductionField.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

palp::SensorDesign fieldDesign(bool following, bool pressureLaw = false) {
  palp::SensorDesign design = palp::paperDesign();
  design.resistance = palp::FieldLaw{.readout = palp::Readout::VirtualGround};
  design.lowerFollowsRubber = following;
  if (pressureLaw) design.pressureLaw = palp::PressureLaw{};
  return design;
}

using Changes = std::vector<std::array<Eigen::MatrixXd, 3>>;

struct Times {
  double wall_s = 1e9, processor_s = 1e9;
};

/// Least of some runs, for other programs only ever add to it.
Times least(const std::function<void()>& work, int runs = 5) {
  Times found;
  for (int run = 0; run < runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    work();
    found.wall_s =
        std::min(found.wall_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    found.processor_s = std::min(found.processor_s, static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
  }
  return found;
}

void print(const std::string& what, const Times& times) {
  std::printf("%-48s %.3f s, of processors %.3f s\n", what.c_str(), times.wall_s, times.processor_s);
}

/// Largest over areas and forces of the difference of d ln R, relative in the mean square.
double difference(const Changes& found, const Changes& finer) {
  double worst = 0;
  for (std::size_t area = 0; area < found.size(); ++area)
    for (std::size_t axis = 0; axis < 3; ++axis)
      worst = std::max(worst, (found[area][axis] - finer[area][axis]).norm() / finer[area][axis].norm());
  return worst;
}

/// Sum of results, so that none is left out.
double layout() {
  palp::SensorDesign design = palp::paperDesign();
  design.lowerFollowsRubber = true;
  const palp::FieldLaw law;
  palp::StageLog stages;
  std::optional<palp::AreaResponse> response;
  print("the block's response, all threads",
        least([&] { response = palp::AreaResponse::atRest(design, {}, 0, stages, {}, {}); }));
  double sum = 0; // of results, so that none is left out
  for (const int threads : {1, 0})
    print(std::string("a layout, four read-outs, bounds, ") + (threads == 1 ? "one thread" : "all threads"), least([&] {
            const palp::FieldResponse field(design, law, *response, threads);
            for (const auto& each : palp::kReadouts.all())
              for (const int row : {4, -1}) sum += field.bound(each.first, row, 1e-4).mean();
          }));
  const palp::FieldSensitivity field(design, law);
  print("of it G, network, quadrature, one thread",
        least([&] { sum += palp::FieldSensitivity(design, law).facePoints_mm()(0, 0); }));
  print("of it displacements of the faces, one thread",
        least([&] { sum += response->perNewtonAt(field.facePoints_mm(), 1)[0][0](0, 0); }));
  std::printf("points of the faces %d\n", static_cast<int>(field.facePoints_mm().cols()));
  const palp::FieldResponse usual(design, law, *response, 0);
  const palp::FieldResponse finer(design, law, *response, 0, 3);
  for (const auto& [readout, name] : palp::kReadouts.all())
    std::printf("error of d ln R, %-17s %.2e\n", name,
                difference(usual.logSensitivity(readout), finer.logSensitivity(readout)));
  return sum;
}

double state() {
  double sum = 0;
  for (const auto& [what, design] : {std::pair{"lower electrodes held", fieldDesign(false)},
                                     {"they follow", fieldDesign(true)},
                                     {"they follow, pressure law", fieldDesign(true, true)}}) {
    const palp::HyperelasticProblem problem(design, palp::sensorMesh(design));
    const palp::LoadCase load{{{0, {1, 0, -6}}}, {}};
    palp::Solution solution;
    std::printf("%s, %d nodes\n", what, problem.mesh().nodeCount());
    print("  the solve, all threads", least([&] { solution = problem.solve(load); }, 3));
    const palp::ConductionField field(problem);
    std::optional<palp::TerminalNetwork> network;
    print("  its first network, with the one at rest", least([&] { network = field.network(solution.state()); }, 1));
    for (const int threads : {1, 0})
      print(std::string("  a network, ") + (threads == 1 ? "one thread" : "all threads"),
            least([&] { network = field.network(solution.state(), threads); }));
    print("  another read-out of it",
          least([&] { sum += palp::NetworkReading(*network, palp::Readout::RowsGrounded).resistances_ohm().mean(); }));
  }
  return sum;
}

double samples() {
  double sum = 0;
  for (const auto& [what, design] :
       {std::pair{"lower electrodes held", fieldDesign(false)}, {"they follow", fieldDesign(true)}}) {
    palp::SampleRequest request;
    request.surrogate = true;
    double error = 0;
    const auto make = [&] {
      palp::SampleGenerator generator(design, request);
      generator.generate({0, generator.total()},
                         [&](const palp::SampleSet& set) { sum += set.resistances_ohm.mean(); });
      error = generator.measuredError();
    };
    print(std::string("600 samples by the surrogate, ") + what, least(make, 1));
    std::printf("  error of d ln R on states that were not fitted %.1e\n", error);
  }
  return sum;
}

} // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  double sum = 0;
  bool known = what.empty();
  for (const auto& [name, part] : {std::pair{"layout", &layout}, {"state", &state}, {"samples", &samples}}) {
    if (!what.empty() && what != name) continue;
    known = true;
    sum += part();
  }
  if (!known) std::fprintf(stderr, "field_benchmark [layout|state|samples]\n");
  return !known ? 2 : std::isfinite(sum) ? 0 : 1;
}
