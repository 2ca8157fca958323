#include "io/board/ReplaySource.h"

#include "io/board/Protocol.h"

#include <algorithm>
#include <thread>

namespace palp {

namespace {

constexpr double kLongestGap_s = 1;  // longer pauses of the recording are cut to this
constexpr double kSameTime_s = 1e-6; // a time in the recording and back loses less

} // namespace

ReplaySource::ReplaySource(const std::filesystem::path& path, std::shared_ptr<ReplayControl> control)
    : path_(path), reader_(path), control_(std::move(control)), configuration_(reader_.head().configuration) {
  measure();
  advance();
}

/// The next entry, at the time that it was measured at.
void ReplaySource::advance() {
  next_ = reader_.next();
  if (next_) next_->hostTime_s = clock_.timeOf(*next_, info());
}

/// Its length and its marks, by reading it once: millions of reports a second.
void ReplaySource::measure() {
  RecordingReader all(path_);
  ReplayClock clock;
  bool any = false;
  std::vector<ReplayMark> marks;
  while (std::optional<RecordingEntry> entry = all.next()) {
    entry->hostTime_s = clock.timeOf(*entry, info());
    if (entry->kind == RecordingEntry::Kind::Mark)
      marks.push_back({entry->hostTime_s, {entry->bytes.begin(), entry->bytes.end()}});
    if (entry->kind != RecordingEntry::Kind::Raw) continue;
    if (!std::exchange(any, true)) first_s_ = entry->hostTime_s;
    last_s_ = entry->hostTime_s;
  }
  control_->begin_s = first_s_;
  control_->length_s = std::max(0.0, last_s_ - first_s_);
  for (ReplayMark& mark : marks) mark.at_s = std::clamp<double>(mark.at_s - first_s_, 0, control_->length_s);
  const std::lock_guard lock(control_->mutex_);
  control_->marks_ = std::move(marks);
}

void ReplaySource::skipToReport() {
  while (next_ && next_->kind != RecordingEntry::Kind::Raw) {
    take(*next_);
    advance();
  }
}

/// How many reports came before this host time.
std::size_t ReplaySource::reportAt(double hostTime_s) {
  rewind();
  for (skipToReport(); next_ && next_->hostTime_s < hostTime_s; skipToReport()) skip(1);
  return report_;
}

void ReplaySource::skip(std::size_t reports) {
  for (skipToReport(); next_ && reports > 0; skipToReport(), --reports, ++report_) advance();
}

/// On from the first report at or after this time.
void ReplaySource::goTo(double to_s, double past_s) {
  const double hostTime_s = first_s_ + to_s;
  goTo(reportAt(hostTime_s), hostTime_s, past_s);
}

/// On from this report, with what came before it; marks and configurations on the way count.
void ReplaySource::goTo(std::size_t report, double hostTime_s, double past_s) {
  const double from_s = std::max(first_s_, hostTime_s - past_s);
  if (past_s > 0) {
    static_cast<void>(reportAt(from_s));
  } else {
    rewind();
    skip(report);
  }
  goOnFrom(past_s > 0 ? from_s : hostTime_s);
  target_ = report;
  target_s_ = hostTime_s;
  control_->position_s = hostTime_s - first_s_;
}

/// By the frames' numbers, not by their length: on a busy host many reports come at once and others late.
void ReplaySource::goToFrameBefore(double end_s) {
  rewind();
  std::size_t begin = 0, before = 0;
  std::optional<std::uint16_t> frame;
  for (skipToReport(); next_ && next_->hostTime_s <= end_s; skip(1)) {
    const auto decoded = decodeInput(next_->bytes, info());
    if (const auto* readings = std::get_if<Readings>(&decoded); readings && frame != readings->frame) {
      frame = readings->frame;
      before = std::exchange(begin, report_);
    }
  }
  rewind();
  skip(before);
  goTo(before, next_ ? next_->hostTime_s : first_s_, control_->past_s);
}

void ReplaySource::rewind() {
  reader_ = RecordingReader(path_);
  clock_ = {};
  configuration_ = reader_.head().configuration;
  mark_.clear();
  tare_.reset();
  report_ = target_ = 0;
  target_s_ = first_s_;
  advance();
}

void ReplaySource::goOnFrom(double hostTime_s) {
  takenUp_s_ = hostTime_s - kSameTime_s;
  started_ = false;
  jumped_ = true;
  if (control_->paused) control_->steps = 1; // so that one sees where one is
}

/// What was asked for since: another place, or the loop's begin.
void ReplaySource::follow() {
  const double sought_s = control_->seek_s_.exchange(-1);
  if (sought_s >= 0) return goTo(std::min<double>(sought_s, control_->length_s), control_->past_s);
  const double frameEnd_s = control_->frameEnd_s_.exchange(-1);
  if (frameEnd_s >= 0) return goToFrameBefore(frameEnd_s);
  const double from_s = control_->loopFrom_s, to_s = control_->loopTo_s;
  if (!control_->loop || !(to_s > from_s) || control_->paused) return;
  const bool over = !next_ || next_->hostTime_s - first_s_ > to_s;
  if (over && from_s < control_->length_s) goTo(from_s, 0);
}

std::string ReplaySource::name() const {
  return "recording " + path_.filename().string() + " of " + reader_.head().source;
}

std::string ReplaySource::reason() const {
  return reader_.cutOff() ? path_.string() + ": is cut off; played to its last whole report" : "";
}

/// Entries between the reports.
void ReplaySource::take(const RecordingEntry& entry) {
  if (entry.kind == RecordingEntry::Kind::Mark) {
    mark_.assign(entry.bytes.begin(), entry.bytes.end());
    markTime_s_ = entry.hostTime_s;
  }
  if (entry.kind == RecordingEntry::Kind::Tare) {
    auto tare = decodeTare(entry.bytes, info().rowWires, info().columnWires);
    tare_ = tare ? std::make_shared<const Tare>(std::move(*tare)) : nullptr;
  }
  if (entry.kind != RecordingEntry::Kind::Configuration) return;
  const auto decoded = decodeConfiguration(entry.bytes);
  if (const auto* configuration = std::get_if<BoardConfiguration>(&decoded)) configuration_ = *configuration;
}

ReportSource::Outcome ReplaySource::read(RawReport& report, std::chrono::milliseconds timeout) {
  skipToReport();
  follow();
  if (!next_) return Outcome::End;
  const bool stepping = control_->paused && control_->steps > 0;
  const bool past = report_ < target_;
  if (control_->paused && !stepping && !past) {
    std::this_thread::sleep_for(std::min(timeout, std::chrono::milliseconds(20)));
    asked_s_ = hostClock_s();
    return Outcome::Nothing;
  }
  const double speed = control_->speed;
  const double now_s = hostClock_s();
  if (!started_) playedTo_s_ = next_->hostTime_s;
  playedTo_s_ = std::max(playedTo_s_, next_->hostTime_s - kLongestGap_s);
  if (started_ && speed > 0) playedTo_s_ += (now_s - asked_s_) * speed;
  started_ = !past;
  asked_s_ = now_s;
  const double wait_s = speed > 0 && !stepping && !past ? (next_->hostTime_s - playedTo_s_) / speed : 0;
  if (wait_s > 0) {
    const auto wait = std::min<std::chrono::duration<double>>(std::chrono::duration<double>(wait_s), timeout);
    std::this_thread::sleep_for(wait);
    if (wait_s > std::chrono::duration<double>(timeout).count()) return Outcome::Nothing;
  }
  report.hostTime_s = next_->hostTime_s;
  if (!past) control_->position_s = next_->hostTime_s - first_s_;
  ++report_;
  std::swap(report.bytes, next_->bytes);
  advance();
  return Outcome::Read;
}

} // namespace palp
