#include "app/study/ChildProcess.h"

#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace palp {

namespace {

constexpr const char* kOutput = "output.txt";
constexpr const char* kErrors = "errors.txt";
constexpr std::chrono::milliseconds kLookEvery{2};

std::string nameOf(const std::string& variable) {
  return variable.substr(0, variable.find('=') + 1);
}

std::vector<std::string> environmentWith(const std::vector<std::string>& ours) {
  std::vector<std::string> all = ours;
  for (char** entry = environ; *entry; ++entry)
    if (std::none_of(ours.begin(), ours.end(), [&](const auto& o) { return nameOf(o) == nameOf(*entry); }))
      all.emplace_back(*entry);
  return all;
}

/// Pointers to the words, and the null that ends them.
std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

pid_t start(const ChildOrder& order) {
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, order.folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, kOutput, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, kErrors, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::vector<std::string> words{order.program.string()}, environment = environmentWith(order.environment);
  words.insert(words.end(), order.arguments.begin(), order.arguments.end());
  pid_t child = 0;
  const int failed = posix_spawn(&child, order.program.c_str(), &actions, nullptr, pointersTo(words).data(),
                                 pointersTo(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw Error(order.program.string() + ": cannot be started");
  return child;
}

/// The most that a process that still runs has held [MB]; 0 once it has ended. Not rusage's ru_maxrss: a child takes
/// over its parent's, and ours may be far more than its own.
double heldAtMost_MB(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    double value_kB = 0;
    if (word == "VmHWM:" && status >> value_kB) return value_kB / 1024;
  }
  return 0;
}

std::string lastLine(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return last;
}

/// The end of a process that could not be waited for, as where the signal of its end is ignored; what it did is
/// unknown.
std::string unknownEnd() {
  return std::string("its exit status is unknown: ") + std::strerror(errno); // NOLINT(concurrency-mt-unsafe)
}

/// Why a process failed, from its exit status; empty if it succeeded.
std::string failure(int status, const std::filesystem::path& errors) {
  if (WIFSIGNALED(status)) return "ended by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) == 0) return {};
  const std::string words = lastLine(readFile(errors));
  return "status " + std::to_string(WEXITSTATUS(status)) + (words.empty() ? "" : ": " + words);
}

} // namespace

ChildRun runChild(const ChildOrder& order, const std::stop_token& stop) {
  ChildRun run;
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  const pid_t child = start(order);
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(child, &status, WNOHANG)) == 0 || (ended < 0 && errno == EINTR)) {
    run.peak_MB = std::max(run.peak_MB, heldAtMost_MB(child));
    if (run.failed.empty() && stop.stop_requested()) run.failed = "cancelled";
    if (run.failed.empty() && elapsed() > order.limit_s)
      run.failed = "ended after " + std::to_string(static_cast<int>(order.limit_s)) + " s";
    if (!run.failed.empty()) kill(child, SIGKILL);
    std::this_thread::sleep_for(kLookEvery);
  }
  if (ended < 0 && run.failed.empty()) run.failed = unknownEnd();
  run.seconds = elapsed();
  if (run.failed.empty()) run.failed = failure(status, order.folder / kErrors);
  run.output = readFile(order.folder / kOutput);
  return run;
}

std::optional<std::filesystem::path> programInPath(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder) / name;
    if (access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "palp-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw Error(pattern + ": the folder cannot be created");
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored; // what stays is a temporary file
  std::filesystem::remove_all(path_, ignored);
}

} // namespace palp
