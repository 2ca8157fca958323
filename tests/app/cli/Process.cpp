#include "tests/app/cli/Process.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace palp::test {

namespace {

struct Running {
  pid_t pid;
  std::filesystem::path output, errors;
};

/// What the process finds beside its arguments.
struct Surroundings {
  bool progressLines = false; ///< "progress DONE TOTAL" on standard error
  rlim_t largestFile_bytes = RLIM_INFINITY;
  std::string program = PALP_BINARY;
};

Running start(const std::vector<std::string>& arguments, const Surroundings& surroundings = {}) {
  static int count = 0;
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string stem = "palp-test-" + std::to_string(getpid()) + "-" + std::to_string(count++);
  Running running{-1, folder / (stem + ".out"), folder / (stem + ".err")};
  std::vector<std::string> words{surroundings.program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> raw;
  for (std::string& word : words) raw.push_back(word.data());
  raw.push_back(nullptr);
  running.pid = fork();
  if (running.pid < 0) throw std::runtime_error("fork failed");
  if (running.pid > 0) return running;
  const int nothing = open("/dev/null", O_RDONLY);
  const int out = open(running.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err = open(running.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(nothing, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  if (surroundings.progressLines) setenv("PALP_PROGRESS_LINES", "1", 1);
  if (surroundings.largestFile_bytes != RLIM_INFINITY) {
    const rlimit limit{surroundings.largestFile_bytes, surroundings.largestFile_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  execv(raw[0], raw.data());
  _exit(127);
}

Outcome finish(const Running& running) {
  int status = 0;
  waitpid(running.pid, &status, 0);
  Outcome outcome;
  outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  outcome.output = readAll(running.output);
  outcome.errors = readAll(running.errors);
  std::filesystem::remove(running.output);
  std::filesystem::remove(running.errors);
  return outcome;
}

/// The share of the work in the last line of progress; 0 before the first one.
double progressOf(const std::filesystem::path& errors) {
  std::ifstream stream(errors);
  double share = 0;
  for (std::string line; std::getline(stream, line);) {
    unsigned long long done = 0, total = 0;
    if (std::sscanf(line.c_str(), "progress %llu %llu", &done, &total) == 2 && total > 0)
      share = static_cast<double>(done) / static_cast<double>(total);
  }
  return share;
}

/// The process has its own handler of SIGINT: its command has begun, all libraries are loaded.
bool catchesInterrupts(pid_t pid) {
  std::ifstream stream("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(stream, line);)
    if (line.rfind("SigCgt:", 0) == 0) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1U) != 0;
  return false;
}

constexpr int kPatience_ms = 60000;

/// Sends SIGINT once the condition holds, or after all patience; not where the process has ended by itself.
template <class Condition> Outcome interruptOnce(const Running& running, const Condition& condition) {
  siginfo_t ended{};
  for (int i = 0; i < kPatience_ms && !condition(); ++i) {
    if (waitid(P_PID, static_cast<id_t>(running.pid), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid != 0)
      return finish(running);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(running.pid, SIGINT);
  return finish(running);
}

} // namespace

Outcome palpAt(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  Surroundings surroundings;
  surroundings.program = program.string();
  return finish(start(arguments, surroundings));
}

std::filesystem::path palpProgram() {
  return PALP_BINARY;
}

Outcome palpOnAFullDisk(const std::vector<std::string>& arguments, std::uintmax_t largestFile_bytes) {
  return finish(start(arguments, {.largestFile_bytes = largestFile_bytes}));
}

Outcome palpInterruptedAt(const std::vector<std::string>& arguments, double share) {
  const Running running = start(arguments, {.progressLines = true});
  return interruptOnce(running, [&] { return progressOf(running.errors) >= share; });
}

Outcome palpInterruptedAfter(const std::vector<std::string>& arguments, int milliseconds) {
  const Running running = start(arguments);
  std::optional<std::chrono::steady_clock::time_point> end;
  return interruptOnce(running, [&] {
    const auto now = std::chrono::steady_clock::now();
    if (!end && catchesInterrupts(running.pid)) end = now + std::chrono::milliseconds(milliseconds);
    return end && now >= *end;
  });
}

Outcome palp(const std::vector<std::string>& arguments) {
  return finish(start(arguments));
}

Outcome palpInterrupted(const std::vector<std::string>& arguments, const std::filesystem::path& file,
                        std::uintmax_t bytes) {
  return interruptOnce(start(arguments), [&] {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    return !missing && size > bytes;
  });
}

std::string readAll(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void writeAll(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

} // namespace palp::test
