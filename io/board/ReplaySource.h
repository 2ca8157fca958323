#pragma once

#include "io/board/Recording.h"

#include <atomic>
#include <memory>

namespace palp {

/// How a recording is played; may be changed from another thread while it plays.
struct ReplayControl {
  std::atomic<double> speed{1}; ///< times as fast as it was; 0 as fast as it can be read
  std::atomic<bool> paused{false};
  std::atomic<int> steps{0}; ///< frames to go on while paused; the session counts them down
};

/// A recording as if it came from the board again: the same decoder takes it.
class ReplaySource : public ReportSource {
public:
  ReplaySource(const std::filesystem::path& path, std::shared_ptr<ReplayControl> control);

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] const BoardInfo& info() const override { return reader_.head().info; }
  [[nodiscard]] const BoardConfiguration& configuration() const override { return configuration_; }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override;
  [[nodiscard]] std::string reason() const override;
  /// Text of the last mark that was passed; empty before the first.
  [[nodiscard]] const std::string& mark() const { return mark_; }

private:
  void take(const RecordingEntry& entry);

  std::filesystem::path path_;
  RecordingReader reader_;
  std::shared_ptr<ReplayControl> control_;
  BoardConfiguration configuration_;
  std::optional<RecordingEntry> next_;
  std::string mark_;
  double playedTo_s_ = 0; ///< host time of the recording that is reached
  double asked_s_ = 0;    ///< host clock when that was
  bool started_ = false;
};

} // namespace palp
