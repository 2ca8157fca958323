#include "tests/app/cli/Process.h"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace palp::test {

namespace {

struct Running {
  pid_t pid;
  std::filesystem::path output, errors;
};

Running start(const std::vector<std::string>& arguments) {
  static int count = 0;
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string stem = "palp-test-" + std::to_string(getpid()) + "-" + std::to_string(count++);
  Running running{-1, folder / (stem + ".out"), folder / (stem + ".err")};
  std::vector<std::string> words{PALP_BINARY};
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

} // namespace

Outcome palp(const std::vector<std::string>& arguments) {
  return finish(start(arguments));
}

Outcome palpInterrupted(const std::vector<std::string>& arguments, const std::filesystem::path& file,
                        std::uintmax_t bytes) {
  const Running running = start(arguments);
  for (int i = 0; i < 60000; ++i) {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    if (!missing && size > bytes) break;
    if (kill(running.pid, 0) != 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(running.pid, SIGINT);
  return finish(running);
}

std::string readAll(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void writeAll(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

} // namespace palp::test
