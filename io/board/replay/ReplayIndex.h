#pragma once

#include "io/board/replay/ReplayCursor.h"

#include <algorithm>

namespace palp {

/// Places of a recording from which it can be read on, one every few thousand reports. Made by reading it once, piece
/// by piece.
class ReplayIndex {
public:
  explicit ReplayIndex(const std::filesystem::path& path);

  /// Reads `reports` more reports, fewer at the end.
  void measure(std::size_t reports);
  [[nodiscard]] bool complete() const { return complete_; }
  /// Host time of the first report; 0 where there is none.
  [[nodiscard]] double first_s() const { return first_s_; }
  /// Latest host time of the reports read so far.
  [[nodiscard]] double measuredTo_s() const { return std::max(cursor_.here().latest_s, first_s_); }
  /// From the first report to the last; before it is complete by the last one's time as it was recorded.
  [[nodiscard]] double length_s() const {
    return std::max(0.0, (complete_ ? last_s_ : std::max(end_s_, measuredTo_s())) - first_s_);
  }
  /// Share of the file that was read.
  [[nodiscard]] double share() const;
  /// Those read so far.
  [[nodiscard]] std::vector<ReplayMark> marks() const;
  [[nodiscard]] std::size_t markCount() const { return marks_.size(); }
  /// Bytes outside of entries, so far.
  [[nodiscard]] std::uint64_t spoiltBytes() const { return spoilt_; }
  [[nodiscard]] bool cutOff() const { return cutOff_; }

  /// The last place at which all reports so far were before this time; that many places earlier.
  [[nodiscard]] const ReplayPlace& before(double hostTime_s, std::size_t earlier = 0) const;
  /// The last place with at most `reports` reports before it.
  [[nodiscard]] const ReplayPlace& before(std::size_t reports) const;
  [[nodiscard]] const ReplayPlace& begin() const { return places_.front(); }

private:
  void finish();
  void estimateEnd(const std::filesystem::path& path);

  ReplayCursor cursor_;
  std::vector<ReplayPlace> places_;
  std::vector<ReplayMark> marks_; ///< with their host times
  std::uint64_t size_ = 0;        ///< bytes of the file
  std::uint64_t spoilt_ = 0;
  double first_s_ = 0, last_s_ = 0;
  double end_s_ = 0; ///< host time of the last report, as it was recorded
  bool complete_ = false, cutOff_ = false;
};

} // namespace palp
