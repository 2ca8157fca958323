#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace palp {

/// A line on standard error with the share done and the time left; silent where that is not a terminal.
class ProgressBar {
public:
  ProgressBar(std::string what, std::size_t total);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// `now`: what is being done, for a program that reads lines.
  void show(std::size_t done, const std::string& now = {});

private:
  std::string what_;
  std::size_t total_;
  bool terminal_;
  bool lines_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
};

} // namespace palp
