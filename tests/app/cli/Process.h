#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace palp::test {

/// What a finished process left.
struct Outcome {
  int exit = -1;
  std::string output; ///< standard output
  std::string errors; ///< standard error

  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(output); }
};

/// Runs the palp binary without a terminal.
Outcome palp(const std::vector<std::string>& arguments);

/// Runs another copy of it.
Outcome palpAt(const std::filesystem::path& program, const std::vector<std::string>& arguments);

/// Where it lies.
std::filesystem::path palpProgram();

/// Runs it where no file can grow above so many bytes, as on a full disk.
Outcome palpOnAFullDisk(const std::vector<std::string>& arguments, std::uintmax_t largestFile_bytes);

/// Starts it, sends SIGINT once its progress has reached this share, and waits for the end.
Outcome palpInterruptedAt(const std::vector<std::string>& arguments, double share);

/// Starts it, sends SIGINT so many milliseconds after its command began, and waits for the end.
Outcome palpInterruptedAfter(const std::vector<std::string>& arguments, int milliseconds);

/// Starts it, sends SIGINT once `file` has grown above `bytes`, and waits for the end.
Outcome palpInterrupted(const std::vector<std::string>& arguments, const std::filesystem::path& file,
                        std::uintmax_t bytes);

std::string readAll(const std::filesystem::path& file);
void writeAll(const std::filesystem::path& file, const std::string& content);

} // namespace palp::test
