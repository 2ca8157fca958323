#pragma once

#include "io/board/RecordingReader.h"
#include "io/board/Tare.h"
#include "io/board/replay/ReplayClock.h"

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace palp {

/// An event mark of a recording.
struct ReplayMark {
  double at_s = 0; ///< from the recording's first report
  std::string text;

  bool operator==(const ReplayMark&) const = default;
};

/// A place of a recording between two entries, with all that is known there of what lies before it.
struct ReplayPlace {
  std::uint64_t offset = 0;                                   ///< bytes in the file
  std::size_t reports = 0;                                    ///< before it
  double latest_s = -std::numeric_limits<double>::infinity(); ///< latest host time of these
  ReplayClock clock;
  BoardConfiguration configuration; ///< in force
  std::string mark;                 ///< the last one; empty before the first
  double markTime_s = 0;            ///< host time of that
  std::shared_ptr<const Tare> tare; ///< that holds; null: none
};

/// Goes through a recording report by report; host times are those of ReplayClock.
class ReplayCursor {
public:
  /// At the begin. Throws Error where the file is not a recording.
  explicit ReplayCursor(const std::filesystem::path& path);

  /// The next report, with what lies before it taken into here(); null at the end. Its bytes may be moved from.
  [[nodiscard]] RecordingEntry* report();
  /// Goes behind it.
  void pass();
  void goTo(const ReplayPlace& place);
  /// What is known at this place. Only behind a report, or at the begin, can it be gone to.
  [[nodiscard]] ReplayPlace& here() { return here_; }
  [[nodiscard]] const ReplayPlace& here() const { return here_; }
  [[nodiscard]] RecordingReader& reader() { return reader_; }
  [[nodiscard]] const RecordingHead& head() const { return reader_.head(); }
  /// Marks are added there as they are passed, with their host times.
  void collectMarks(std::vector<ReplayMark>* marks) { marks_ = marks; }

private:
  void take();

  RecordingReader reader_;
  ReplayPlace here_;
  RecordingEntry entry_;
  bool read_ = false; ///< entry_ is the next report
  std::vector<ReplayMark>* marks_ = nullptr;
};

} // namespace palp
