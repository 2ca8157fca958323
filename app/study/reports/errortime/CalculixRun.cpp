#include "app/study/reports/errortime/CalculixRun.h"

#include "app/study/ChildProcess.h"
#include "io/AtomicFile.h"
#include "model/base/NumberText.h"
#include "solver/CalculixDeck.h"
#include "solver/PointProbe.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <thread>

namespace palp {

std::optional<std::string> calculixProgram() {
  const auto program = programInPath("ccx");
  if (!program) return {};
  return program->string();
}

CalculixRun runCalculix(const std::string& program, const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                        int threads, double limit_s, const std::stop_token& stop) {
  const ScratchFolder folder;
  writeFile(folder.path() / "job.inp", calculixDeck(design, mesh, load), true);
  const int cores = threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  ChildOrder order{program, {"job"}, folder.path(), {}, limit_s};
  for (const char* name : {"OMP_NUM_THREADS=", "CCX_NPROC_EQUATION_SOLVER=", "CCX_NPROC_STIFFNESS="})
    order.environment.push_back(name + std::to_string(cores));
  const ChildRun child = runChild(order, stop);
  CalculixRun run;
  run.seconds = child.seconds;
  run.peak_MB = child.peak_MB;
  run.failed = child.failed;
  if (!run.failed.empty()) return run;
  const std::filesystem::path results = folder.path() / "job.frd";
  if (std::filesystem::exists(results)) run.displacements_mm = frdDisplacements(readFile(results), mesh.nodeCount());
  const std::filesystem::path printed = folder.path() / "job.dat";
  if (std::filesystem::exists(printed)) run.reaction_N = datReaction_N(readFile(printed));
  if (run.displacements_mm.size() == 0) run.failed = "CalculiX ended without displacements";
  return run;
}

Eigen::Matrix3Xd upperElectrodes_mm(const CalculixRun& run, const SensorDesign& design, const Mesh& mesh) {
  constexpr Eigen::Index unknowns = 16; // zeros: neither bubble nor pressure is read at the nodes
  const LoadIncrement state{1, run.displacements_mm, Eigen::MatrixXd::Zero(unknowns, mesh.elementCount())};
  return PointProbe(mesh, design.upperElectrodes_mm()).displacements_mm(state);
}

std::optional<Eigen::Vector3d> datReaction_N(const std::string& dat) {
  const std::size_t title = dat.rfind("total force (fx,fy,fz) for set BOTTOM");
  if (title == std::string::npos) return {};
  std::istringstream lines(dat.substr(title));
  std::string line;
  std::getline(lines, line);
  Eigen::Vector3d force;
  if (!(lines >> force(0) >> force(1) >> force(2))) return {};
  return force;
}

Eigen::Matrix3Xd frdDisplacements(const std::string& frd, int nodes) {
  // Fixed columns (CalculiX CrunchiX manual, "Node file format"): " -1", node in 10, then values of 12 characters.
  constexpr std::size_t kNodeAt = 3, kNodeWidth = 10, kValueWidth = 12;
  Eigen::Matrix3Xd result;
  std::istringstream lines(frd);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(" -4  DISP", 0) == 0) {
      inside = true;
      result = Eigen::Matrix3Xd::Zero(3, nodes); // the last step counts
    } else if (line.rfind(" -3", 0) == 0) {
      inside = false;
    }
    if (!inside || line.rfind(" -1", 0) != 0 || line.size() < kNodeAt + kNodeWidth + 3 * kValueWidth) continue;
    const int node = std::stoi(line.substr(kNodeAt, kNodeWidth)) - 1;
    if (node < 0) return {};
    if (node >= nodes) continue; // an indenter's
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = numberIn(line.substr(kNodeAt + kNodeWidth + axis * kValueWidth, kValueWidth));
      if (!value) return {};
      result(static_cast<Eigen::Index>(axis), node) = *value;
    }
  }
  return result;
}

} // namespace palp
