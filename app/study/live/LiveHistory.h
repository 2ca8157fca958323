#pragma once

#include "app/study/live/LiveSession.h"

#include <deque>
#include <filesystem>

namespace palp {

/// The frames of the last while, on one time axis: of a recording those since it was taken up at another place.
class LiveHistory {
public:
  struct Entry {
    /// Device clock, brought to the host's at each connection and restart: never the time of arrival, which jitters.
    double t_s = 0;
    std::shared_ptr<const LiveFrame> frame;
    bool gap = false;     ///< frames are missing before it: the board was out, held or silent
    bool newMark = false; ///< its mark begins here, also where it is the first frame that came
  };

  void add(std::shared_ptr<const LiveFrame> frame);
  void clear();
  [[nodiscard]] const std::deque<Entry>& entries() const { return entries_; }
  [[nodiscard]] const LiveFrame* last() const { return entries_.empty() ? nullptr : entries_.back().frame.get(); }
  /// The last frame that gave forces; null where there was none.
  [[nodiscard]] const LiveFrame* lastValid() const { return lastValid_.get(); }

  static constexpr std::size_t kMostFrames = 4000;
  static constexpr double kLongest_s = 60;

private:
  std::deque<Entry> entries_;
  std::shared_ptr<const LiveFrame> lastValid_;
  double period_s_ = 0; ///< between the last two frames; 0: there were none
  double offset_s_ = 0; ///< host's clock minus the device's
};

/// The entries as CSV: time as in Entry (it never jumps back), the board's own clock, frame, forces with deviations,
/// latency, lost reports, misfit, a mark at the frame it begins with, why there are no forces or why they are doubted,
/// and the change of every reading. `head`: complete lines before all that. Throws Error where the file cannot be
/// written.
void writeLiveCsv(const std::filesystem::path& path, const LiveHistory& history, const std::string& head = {});

} // namespace palp
