#include "app/study/reports/CalculixRun.h"

#include "io/AtomicFile.h"
#include "model/Error.h"
#include "solver/CalculixDeck.h"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <sstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace palp {

namespace {

/// A new folder for temporary files; gone with the object.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "palp-ccx-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw Error(pattern + ": no folder can be made there");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored; // what stays is a temporary file
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// The environment with the number of threads that CalculiX takes.
std::vector<std::string> environmentWith(int threads) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry; ++entry) result.emplace_back(*entry);
  for (const char* name : {"OMP_NUM_THREADS=", "CCX_NPROC_EQUATION_SOLVER=", "CCX_NPROC_STIFFNESS="})
    result.push_back(name + std::to_string(threads));
  return result;
}

pid_t start(const std::string& program, const std::filesystem::path& folder, int threads) {
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "job.log", O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::vector<std::string> environment = environmentWith(threads);
  std::vector<char*> pointers;
  pointers.reserve(environment.size() + 1);
  for (std::string& entry : environment) pointers.push_back(entry.data());
  pointers.push_back(nullptr);
  std::string name = program, job = "job";
  std::array<char*, 3> arguments{name.data(), job.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), pointers.data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw Error(program + ": cannot be started");
  return child;
}

} // namespace

std::optional<std::string> calculixProgram() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string program = folder + "/ccx";
    if (access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

CalculixRun runCalculix(const std::string& program, const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                        int threads, double limit_s, const std::stop_token& stop) {
  CalculixRun run;
  const TemporaryFolder folder;
  writeFile(folder.path() / "job.inp", calculixDeck(design, mesh, load), true);
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  const int cores = threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const pid_t child = start(program, folder.path(), cores);
  int status = 0;
  bool ended = false;
  struct rusage used {};
  while (wait4(child, &status, WNOHANG, &used) == 0) {
    if (!ended && (stop.stop_requested() || elapsed() > limit_s)) {
      kill(child, SIGKILL);
      ended = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  run.seconds = elapsed();
  run.peak_MB = static_cast<double>(used.ru_maxrss) / 1024; // Linux counts in KiB
  if (ended) {
    run.failed =
        stop.stop_requested() ? "cancelled" : "ended after " + std::to_string(static_cast<int>(limit_s)) + " s";
    return run;
  }
  const std::filesystem::path results = folder.path() / "job.frd";
  if (std::filesystem::exists(results)) run.displacements_mm = frdDisplacements(readFile(results), mesh.nodeCount());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || run.displacements_mm.size() == 0)
    run.failed = "CalculiX ended without displacements";
  return run;
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
      result = Eigen::Matrix3Xd::Zero(3, nodes); // the last step's stands
    } else if (line.rfind(" -3", 0) == 0) {
      inside = false;
    }
    if (!inside || line.rfind(" -1", 0) != 0 || line.size() < kNodeAt + kNodeWidth + 3 * kValueWidth) continue;
    const int node = std::stoi(line.substr(kNodeAt, kNodeWidth)) - 1;
    if (node < 0 || node >= nodes) return {};
    for (std::size_t axis = 0; axis < 3; ++axis)
      result(static_cast<Eigen::Index>(axis), node) =
          std::stod(line.substr(kNodeAt + kNodeWidth + axis * kValueWidth, kValueWidth));
  }
  return result;
}

} // namespace palp
