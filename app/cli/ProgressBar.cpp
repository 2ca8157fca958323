#include "app/cli/ProgressBar.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

namespace palp {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int kWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};
/// Set by a program that shows the progress itself: "progress DONE TOTAL WHAT" a line.
constexpr const char* kLinesWanted = "PALP_PROGRESS_LINES";

} // namespace

ProgressBar::ProgressBar(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), terminal_(isatty(STDERR_FILENO) == 1),
      lines_(std::getenv(kLinesWanted) != nullptr), start_(Clock::now()), last_(start_) {}

ProgressBar::~ProgressBar() {
  if (drawn_ && !lines_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(std::size_t done, const std::string& now) {
  const Clock::time_point time = Clock::now();
  if ((!terminal_ && !lines_) || total_ == 0 || (drawn_ && time - last_ < kRedraw)) return;
  last_ = time;
  drawn_ = true;
  if (lines_) {
    std::fprintf(stderr, "progress %zu %zu%s%s\n", done, total_, now.empty() ? "" : " ", now.c_str());
    std::fflush(stderr);
    return;
  }
  const double share = static_cast<double>(done) / static_cast<double>(total_);
  const double spent = std::chrono::duration<double>(time - start_).count();
  const int filled = static_cast<int>(share * kWidth);
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "\r\033[K%s [%s] %zu of %zu", what_.c_str(), bar.c_str(), done, total_);
  if (done > 0) std::fprintf(stderr, ", %ld s left", std::lround(std::ceil(spent * (1 - share) / share)));
  std::fflush(stderr);
}

} // namespace palp
