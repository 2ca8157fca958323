#include "io/board/replay/ReplayIndex.h"

#include "io/board/RecordingReader.h"

#include <algorithm>

namespace palp {

namespace {

constexpr std::size_t kBetweenPlaces = 1 << 14; ///< reports: two seconds of the fastest board
constexpr std::uint64_t kTail = 1 << 20;        ///< bytes in which a recording's last report is looked for

} // namespace

ReplayIndex::ReplayIndex(const std::filesystem::path& path)
    : cursor_(path), places_{cursor_.here()}, size_(cursor_.reader().size()) {
  cursor_.collectMarks(&marks_);
  if (const RecordingEntry* first = cursor_.report()) first_s_ = last_s_ = end_s_ = first->hostTime_s;
  estimateEnd(path);
}

void ReplayIndex::estimateEnd(const std::filesystem::path& path) {
  RecordingReader tail(path);
  if (size_ > tail.place() + kTail) tail.goTo(size_ - kTail);
  for (RecordingEntry entry; tail.next(entry);)
    if (entry.kind == RecordingEntry::Kind::Raw) end_s_ = entry.hostTime_s;
}

void ReplayIndex::measure(std::size_t reports) {
  for (; !complete_ && reports > 0; --reports) {
    const RecordingEntry* report = cursor_.report();
    if (report == nullptr) return finish();
    last_s_ = report->hostTime_s;
    cursor_.pass();
    if (cursor_.here().reports % kBetweenPlaces == 0) places_.push_back(cursor_.here());
  }
}

void ReplayIndex::finish() {
  complete_ = true;
  spoilt_ = cursor_.reader().spoiltBytes();
  cutOff_ = cursor_.reader().cutOff();
}

double ReplayIndex::share() const {
  return size_ > 0 ? std::min(1.0, static_cast<double>(cursor_.here().offset) / static_cast<double>(size_)) : 1;
}

std::vector<ReplayMark> ReplayIndex::marks() const {
  std::vector<ReplayMark> marks = marks_;
  for (ReplayMark& mark : marks) mark.at_s = std::clamp<double>(mark.at_s - first_s_, 0, length_s());
  return marks;
}

const ReplayPlace& ReplayIndex::before(double hostTime_s, std::size_t earlier) const {
  const auto behind = std::partition_point(places_.begin(), places_.end(),
                                           [&](const ReplayPlace& place) { return place.latest_s < hostTime_s; });
  const auto place = static_cast<std::size_t>(behind - places_.begin());
  return places_[place > earlier + 1 ? place - earlier - 1 : 0];
}

const ReplayPlace& ReplayIndex::before(std::size_t reports) const {
  const auto behind = std::partition_point(places_.begin(), places_.end(),
                                           [&](const ReplayPlace& place) { return place.reports <= reports; });
  return places_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(behind - places_.begin(), 1) - 1)];
}

} // namespace palp
