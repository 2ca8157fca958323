// A layout under the field at rest, step by step: time on one thread and on all, and beside it the error of what comes
// out against a quadrature that is much finer. A table.
#include "app/study/reports/layout/FieldResponse.h"
#include "model/FieldSensitivity.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace {

using Changes = std::vector<std::array<Eigen::MatrixXd, 3>>;

struct Times {
  double wall_s = 1e9, processor_s = 1e9;
};

/// Least of some runs, for other programs only ever add to it.
Times least(const std::function<void()>& work) {
  Times found;
  for (int run = 0; run < 5; ++run) {
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

} // namespace

int main() {
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
  return std::isfinite(sum) ? 0 : 1;
}
