// What LiveHost does with recordings: plays them at any place, and makes them.

#include "app/gui/live/LiveHost.h"
#include "model/base/Error.h"

#include <algorithm>

namespace palp {

void LiveHost::seek(double to_s) {
  if (replay_) replay_->seek(to_s);
}

/// What is read of the past after a jump is shown with the place that was gone to, not before it.
void LiveHost::drain() {
  for (auto& frame : session_->drain()) waiting_.push_back(std::move(frame));
  auto end = waiting_.end();
  if (!waiting_.empty() && waiting_.back()->past && status_.state != LiveState::Ended)
    end = std::find_if(waiting_.begin(), waiting_.end(),
                       [&](const auto& frame) { return frame->jumps == waiting_.back()->jumps; });
  fresh_.assign(waiting_.begin(), end);
  waiting_.erase(waiting_.begin(), end);
}

void LiveHost::step(int frames) {
  if (!replay_) return;
  setPaused(true);
  if (frames > 0) {
    replay_->steps += frames;
    return;
  }
  if (const LiveFrame* last = history_.last()) replay_->seekFrameBefore(last->frame.hostTime_s);
}

void LiveHost::startRecording(const std::filesystem::path& path, bool replace) {
  if (!session_) throw Error(path.string() + ": cannot record, as no source is open");
  if (replay_ && std::filesystem::weakly_canonical(path) == std::filesystem::weakly_canonical(settings_.recording))
    throw Error(path.string() + ": is being played; record to another file");
  session_->startRecording(path, network_.fingerprint, replace);
  recordingFile_ = path;
  recordedBefore_s_ = 0;
  recordsSince_s_.reset();
  recordingEnds_ = false;
}

/// The clock of a recording stops while nothing arrives that could be recorded.
void LiveHost::timeRecording() {
  const bool goesOn = status_.recording && !recordingEnds_;
  if (goesOn == recordsSince_s_.has_value()) return;
  if (goesOn) {
    recordsSince_s_ = hostClock_s();
  } else {
    recordedBefore_s_ = recorded_s();
    recordsSince_s_.reset();
  }
}

double LiveHost::recorded_s() const {
  return recordedBefore_s_ + (recordsSince_s_ ? hostClock_s() - *recordsSince_s_ : 0);
}

void LiveHost::stopRecording() {
  recordingEnds_ = true;
  timeRecording();
  if (session_) session_->stopRecording();
}

} // namespace palp
