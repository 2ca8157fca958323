#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// A program to be run in a process of its own.
struct ChildOrder {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::filesystem::path folder;         ///< it works there; its messages go into output.txt and errors.txt
  std::vector<std::string> environment; ///< NAME=VALUE, in place of ours of that name
  double limit_s = 300;
};

/// A process that has ended, and what it cost.
struct ChildRun {
  std::string output; ///< standard output
  double seconds = 0; ///< wall time
  double peak_MB = 0; ///< most memory that it held
  std::string failed; ///< why it has no result, in a sentence; empty where it ended with status 0
};

/// Runs it to its end. Ended after its limit and, within a few milliseconds, on a stop request. Throws Error where the
/// program cannot be started.
ChildRun runChild(const ChildOrder& order, const std::stop_token& stop);

/// Where a program lies in PATH, or nothing.
std::optional<std::filesystem::path> programInPath(const std::string& name);

/// A new folder for temporary files; gone with the object.
class ScratchFolder {
public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace palp
