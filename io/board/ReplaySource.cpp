#include "io/board/ReplaySource.h"

#include "io/board/Protocol.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace palp {

namespace {

constexpr double kLongestGap_s = 1;  // longer pauses of the recording are cut to this
constexpr double kSameTime_s = 1e-6; // a time in the recording and back loses less
constexpr int kFramesToGoBack = 3;   // that must begin to know where the last but one began

constexpr std::size_t kMeasuredPerReport = 64; // reports that are measured with each that is played,
constexpr std::size_t kMeanwhile = 1 << 10;    // and at a time while one waits

} // namespace

ReplaySource::ReplaySource(const std::filesystem::path& path, std::shared_ptr<ReplayControl> control,
                           std::size_t measuredAtOnce)
    : path_(path), index_(path), cursor_(path), control_(std::move(control)), target_s_(index_.first_s()) {
  control_->begin_s = index_.first_s();
  measure(measuredAtOnce);
}

void ReplaySource::measure(std::size_t reports) {
  index_.measure(reports);
  control_->length_s = index_.length_s();
  if (!index_.complete() && index_.markCount() == marks_) return;
  marks_ = index_.markCount();
  const std::lock_guard lock(control_->mutex_);
  control_->marks_ = index_.marks();
}

/// Waits, and continues measuring meanwhile.
void ReplaySource::wait(std::chrono::duration<double> time) {
  const double until_s = hostClock_s() + time.count();
  while (!index_.complete() && hostClock_s() < until_s) measure(kMeanwhile);
  std::this_thread::sleep_for(std::chrono::duration<double>(std::max(0.0, until_s - hostClock_s())));
}

/// How many reports came before this host time.
std::size_t ReplaySource::reportAt(double hostTime_s) {
  cursor_.goTo(index_.before(hostTime_s));
  for (const RecordingEntry* next = cursor_.report(); next != nullptr && next->hostTime_s < hostTime_s;
       next = cursor_.report())
    cursor_.pass();
  return here().reports;
}

void ReplaySource::skipTo(std::size_t report) {
  cursor_.goTo(index_.before(report));
  while (cursor_.report() != nullptr && here().reports < report) cursor_.pass();
}

/// On from this report, with what came before it; marks and configurations on the way count.
void ReplaySource::goTo(std::size_t report, double hostTime_s, double past_s) {
  const double from_s = std::max(index_.first_s(), hostTime_s - past_s);
  if (past_s > 0) {
    static_cast<void>(reportAt(from_s));
  } else {
    skipTo(report);
  }
  goOnFrom(past_s > 0 ? from_s : hostTime_s);
  target_ = report;
  target_s_ = hostTime_s;
  control_->position_s = hostTime_s - index_.first_s();
}

void ReplaySource::goToFrameBefore(double end_s) {
  for (std::size_t earlier = 0; !goToFrameBefore(end_s, index_.before(end_s, earlier));) ++earlier;
}

/// By the frames' numbers, not by their length: on a busy host many reports come together and others late. False where
/// too few frames begin behind `from`.
bool ReplaySource::goToFrameBefore(double end_s, const ReplayPlace& from) {
  cursor_.goTo(from);
  std::size_t begin = from.reports, before = from.reports;
  int begun = from.reports == 0 ? kFramesToGoBack : 0;
  std::optional<std::uint16_t> frame;
  for (const RecordingEntry* next = cursor_.report(); next != nullptr && next->hostTime_s <= end_s;
       next = cursor_.report()) {
    const auto decoded = decodeInput(next->bytes, info());
    if (const auto* readings = std::get_if<Readings>(&decoded); readings && frame != readings->frame) {
      frame = readings->frame;
      before = std::exchange(begin, here().reports);
      ++begun;
    }
    cursor_.pass();
  }
  if (begun < kFramesToGoBack) return false;
  skipTo(before);
  const RecordingEntry* next = cursor_.report();
  goTo(before, next != nullptr ? next->hostTime_s : index_.first_s(), control_->past_s);
  return true;
}

void ReplaySource::goOnFrom(double hostTime_s) {
  takenUp_s_ = hostTime_s - kSameTime_s;
  started_ = false;
  jumped_ = true;
  if (control_->paused) control_->steps = 1; // so that one sees where one is
}

/// What was requested since: another place, or the loop's begin. False while that is not measured yet.
bool ReplaySource::follow() {
  double sought_s = control_->seek_s_;
  if (sought_s >= 0) {
    const double hostTime_s = index_.first_s() + std::min<double>(sought_s, control_->length_s);
    if (!index_.complete() && hostTime_s > index_.measuredTo_s()) return false;
    control_->seek_s_.compare_exchange_strong(sought_s, -1); // else another place is wanted by now
    goTo(reportAt(hostTime_s), hostTime_s, control_->past_s);
    return true;
  }
  const double frameEnd_s = control_->frameEnd_s_.exchange(-1);
  if (frameEnd_s >= 0) {
    goToFrameBefore(frameEnd_s);
    return true;
  }
  const double from_s = control_->loopFrom_s, to_s = control_->loopTo_s;
  if (!control_->loop || !(to_s > from_s) || control_->paused) return true;
  const RecordingEntry* next = cursor_.report();
  const bool over = next == nullptr || next->hostTime_s - index_.first_s() > to_s;
  const std::pair loop{from_s, to_s};
  if (!over || from_s >= control_->length_s || loop == emptyLoop_) return true;
  const double hostTime_s = index_.first_s() + from_s;
  goTo(reportAt(hostTime_s), hostTime_s, 0);
  next = cursor_.report();
  if (next == nullptr || next->hostTime_s - index_.first_s() > to_s) emptyLoop_ = loop;
  return true;
}

std::string ReplaySource::name() const {
  return "recording " + path_.filename().string() + " of " + cursor_.head().source;
}

std::string ReplaySource::reason() const {
  if (waits_)
    return path_.string() + ": seeking the position; " + std::to_string(std::lround(100 * index_.share())) +
           " % are read";
  std::string words;
  if (!ended_) return words;
  if (index_.spoiltBytes() > 0)
    words = path_.string() + ": " + std::to_string(index_.spoiltBytes()) + " bytes are damaged and were skipped";
  if (index_.cutOff())
    words += (words.empty() ? path_.string() + ": " : "; it ") + "is cut off; played to its last complete report";
  return words;
}

ReportSource::Outcome ReplaySource::read(RawReport& report, std::chrono::milliseconds timeout) {
  if (!index_.complete()) measure(kMeasuredPerReport);
  waits_ = !follow();
  if (waits_) {
    wait(std::min(timeout, std::chrono::milliseconds(20)));
    requested_s_ = hostClock_s();
    return Outcome::Nothing;
  }
  RecordingEntry* next = cursor_.report(); // with what lies before it
  ended_ = next == nullptr;
  if (ended_) return Outcome::End;
  const bool stepping = control_->paused && control_->steps > 0;
  const bool past = here().reports < target_;
  if (control_->paused && !stepping && !past) {
    wait(std::min(timeout, std::chrono::milliseconds(20)));
    requested_s_ = hostClock_s();
    return Outcome::Nothing;
  }
  const double speed = control_->speed;
  const double now_s = hostClock_s();
  if (!started_) playedTo_s_ = next->hostTime_s;
  playedTo_s_ = std::max(playedTo_s_, next->hostTime_s - kLongestGap_s);
  if (started_ && speed > 0) playedTo_s_ += (now_s - requested_s_) * speed;
  started_ = !past;
  requested_s_ = now_s;
  const double wait_s = speed > 0 && !stepping && !past ? (next->hostTime_s - playedTo_s_) / speed : 0;
  if (wait_s > 0) {
    wait(std::min<std::chrono::duration<double>>(std::chrono::duration<double>(wait_s), timeout));
    if (wait_s > std::chrono::duration<double>(timeout).count()) return Outcome::Nothing;
  }
  report.hostTime_s = next->hostTime_s;
  if (!past) control_->position_s = next->hostTime_s - index_.first_s();
  std::swap(report.bytes, next->bytes);
  cursor_.pass();
  return Outcome::Read;
}

} // namespace palp
