#pragma once

#include "io/board/ReportSource.h"
#include "io/board/replay/ReplayIndex.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace palp {

/// How a recording is played; may be changed from another thread while it plays.
struct ReplayControl {
  std::atomic<double> speed{1}; ///< times as fast as it was; 0 as fast as it can be read
  std::atomic<bool> paused{false};
  std::atomic<int> steps{0};         ///< frames to go on while paused; the session counts them down
  std::atomic<double> length_s{0};   ///< of the recording, from its first report to its last; set by the source
  std::atomic<double> begin_s{0};    ///< host time of its first report; set by the source
  std::atomic<double> position_s{0}; ///< that is reached; set by the source
  std::atomic<bool> loop{false};     ///< between the next two, again and again
  std::atomic<double> loopFrom_s{0}, loopTo_s{0};
  /// That is read first, as fast as it can be, from before a place that is gone to; its frames are LiveFrame::past.
  std::atomic<double> past_s{0};

  /// Continues from this time of the recording; while paused, to the end of the first frame there.
  void seek(double to_s) { seek_s_ = to_s; }
  /// The same from the begin of the frame before the one whose last report came at this host time; the first has none
  /// before it and is gone to itself.
  void seekFrameBefore(double end_s) { frameEnd_s_ = end_s; }
  /// A seek waits to be followed.
  [[nodiscard]] bool sought() const { return seek_s_ >= 0 || frameEnd_s_ >= 0; }
  /// All marks of the recording; empty before it was opened.
  [[nodiscard]] std::vector<ReplayMark> marks() const {
    const std::lock_guard lock(mutex_);
    return marks_;
  }

private:
  friend class ReplaySource;
  mutable std::mutex mutex_;
  std::vector<ReplayMark> marks_;
  std::atomic<double> seek_s_{-1};     ///< below 0: none
  std::atomic<double> frameEnd_s_{-1}; ///< below 0: none
};

/// A recording as if it came from the board again: the same decoder takes it. Times are those of ReplayClock, so that
/// the place in the recording and the curves, which go by the board's clock, say the same. A long one is played while
/// it is still measured; going to a place that was not reached yet waits for that.
class ReplaySource : public ReportSource {
public:
  /// Number of reports that are measured before it returns: a fraction of a second.
  static constexpr std::size_t kMeasuredAtOnce = 1 << 18;

  ReplaySource(const std::filesystem::path& path, std::shared_ptr<ReplayControl> control,
               std::size_t measuredAtOnce = kMeasuredAtOnce);

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] const BoardInfo& info() const override { return cursor_.head().info; }
  /// In force for the report that was read last.
  [[nodiscard]] const BoardConfiguration& configuration() const override { return here().configuration; }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override;
  /// At the end what of the file could not be read; before it why nothing comes. Empty where all is well.
  [[nodiscard]] std::string reason() const override;
  /// Text of the last mark that was passed or set; empty before the first.
  [[nodiscard]] const std::string& mark() const { return here().mark; }
  /// A mark of the one who looks on, at the report that was read last; it holds until the recording's next or a jump.
  void setMark(const std::string& text, double hostTime_s) {
    cursor_.here().mark = text;
    cursor_.here().markTime_s = hostTime_s;
  }
  /// That mark is where the recording last continued, or after that place: not before it.
  [[nodiscard]] bool markFollowsJump() const { return here().markTime_s >= takenUp_s_; }
  /// The tare that held at this place when it was recorded; null: none.
  [[nodiscard]] const std::shared_ptr<const Tare>& tare() const { return here().tare; }
  /// A frame that ended at this host time, with the last report, lies before the place that was gone to.
  [[nodiscard]] bool past(double hostTime_s) const { return here().reports <= target_ || hostTime_s < target_s_; }
  /// The last report was from before the place that was gone to.
  [[nodiscard]] bool inPast() const { return here().reports <= target_; }
  /// Since the last call it went to another place of the recording.
  [[nodiscard]] bool jumped() { return std::exchange(jumped_, false); }

private:
  [[nodiscard]] const ReplayPlace& here() const { return cursor_.here(); }
  void measure(std::size_t reports);
  void wait(std::chrono::duration<double> time);
  bool follow();
  void goTo(std::size_t report, double hostTime_s, double past_s);
  [[nodiscard]] std::size_t reportAt(double hostTime_s);
  void skipTo(std::size_t report);
  void goToFrameBefore(double end_s);
  bool goToFrameBefore(double end_s, const ReplayPlace& from);
  void goOnFrom(double hostTime_s);

  std::filesystem::path path_;
  ReplayIndex index_;
  ReplayCursor cursor_;
  std::shared_ptr<ReplayControl> control_;
  std::size_t marks_ = 0;                       ///< that the control has
  double takenUp_s_ = 0;                        ///< host time from which it was read on last
  std::size_t target_ = 0;                      ///< reports before the place that was gone to last
  double target_s_ = 0;                         ///< host time of that place
  double playedTo_s_ = 0;                       ///< host time of the recording that is reached
  double requested_s_ = 0;                      ///< host clock when that was
  std::pair<double, double> emptyLoop_{-1, -1}; ///< begin and end of a loop that holds no report: it is played on
  bool started_ = false;
  bool jumped_ = false;
  bool ended_ = false;
  bool waits_ = false; ///< for the index, to go to a place
};

} // namespace palp
