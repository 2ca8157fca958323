#pragma once

#include "io/board/BoardFrame.h"

#include <functional>

namespace palp {

/// What became of the reports.
struct ReportCounts {
  std::uint64_t reports = 0; ///< that arrived, good or bad
  std::uint64_t lost = 0;    ///< missing in the sequence
  std::uint64_t bad = 0;     ///< wrong length, ID, checksum or range
  std::uint64_t duplicates = 0;
  std::uint64_t backwards = 0; ///< older than the one before
  std::uint64_t stale = 0;     ///< of another configuration than the one in force
  std::uint64_t restarts = 0;  ///< of the board
  std::uint64_t frames = 0;
  std::uint64_t incompleteFrames = 0;
};

/// Puts frames together from readings: never of two scans, never interpolated. A pure function of what it was given.
class FrameAssembler {
public:
  using TakeFrame = std::function<void(const BoardFrame&)>;

  FrameAssembler(BoardInfo info, const BoardConfiguration& configuration);

  /// Takes one report as it came; `take` gets each frame that it ends, complete or not. The frame is the assembler's.
  /// Returns what was in the report.
  std::variant<Readings, BoardEvent, ReportFault> add(std::span<const std::uint8_t> report, double hostTime_s,
                                                      const TakeFrame& take);
  /// The board's configuration is now another one; reports of older ones are stale.
  void setConfiguration(const BoardConfiguration& configuration);
  /// Forgets the sequence and the half frame, not the counts: after a pause, or at another place of a recording. A
  /// frame that is joined in its middle is left out then: nothing of it is lost.
  void restart();

  [[nodiscard]] const ReportCounts& counts() const { return counts_; }
  [[nodiscard]] const BoardInfo& info() const { return info_; }
  [[nodiscard]] const BoardConfiguration& configuration() const { return configuration_; }
  /// Stale reports since the last good one: many of them mean that the configuration must be read again.
  [[nodiscard]] int staleInARow() const { return staleInARow_; }

private:
  bool follows(const Readings& readings, double hostTime_s);
  void addReadings(const Readings& readings, double hostTime_s, const TakeFrame& take);
  void forget();
  /// It belongs to a frame whose begin was not seen, after a restart().
  bool belongsToHalf(const Readings& readings);
  void beginFrame(const Readings& readings);
  void endFrame(const TakeFrame& take);
  void place(const Readings& readings);

  BoardInfo info_;
  BoardConfiguration configuration_;
  ReportCounts counts_;
  BoardFrame frame_;
  bool open_ = false; ///< a frame is being filled
  bool restarted_ = false;
  bool joins_ = false;                  ///< until a frame is seen from its begin
  std::optional<std::uint16_t> joined_; ///< the frame that was joined in its middle
  int missingReports_ = 0;              ///< of the open frame
  std::vector<bool> placed_;            ///< reports of the open frame
  std::optional<Readings> last_;
  std::optional<double> lastHostTime_s_;
  std::uint64_t clock_us_ = 0; ///< of the last report, unwrapped
  int staleInARow_ = 0;
};

} // namespace palp
