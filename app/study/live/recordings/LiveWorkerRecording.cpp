// What the session's thread writes into a recording.

#include "app/study/live/LiveWorker.h"
#include "io/board/RecordingWriter.h"

#include <utility>

namespace palp {

namespace {

std::span<const std::uint8_t> bytesOf(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

} // namespace

void LiveWorker::recordConfiguration() {
  if (writer_) writer_->append(RecordingEntry::Kind::Configuration, recordedTime_s(), encode(source_->configuration()));
}

/// The time of what is recorded between two reports: the times of a recording that is played are its own.
double LiveWorker::recordedTime_s() const {
  return options_.replay ? report_.hostTime_s : hostClock_s();
}

void LiveWorker::recordTare() {
  if (writer_)
    writer_->append(RecordingEntry::Kind::Tare, recordedTime_s(), tare_ ? encode(*tare_) : std::vector<std::uint8_t>{});
}

void LiveWorker::mark(const std::string& text) {
  mark_ = text;
  const double time_s = recordedTime_s();
  if (replay() != nullptr) replay()->setMark(text, time_s);
  if (writer_) writer_->append(RecordingEntry::Kind::Mark, time_s, bytesOf(text));
}

void LiveWorker::statusOfRecording() {
  status_.recordedReports = writer_->reports();
  status_.recordingDropped = writer_->dropped();
  status_.recordingFailure = writer_->failure();
}

void LiveWorker::endRecording() {
  if (!writer_) return;
  writer_->finish(); // its last half second may fail too
  statusOfRecording();
  writer_.reset();
}

void LiveWorker::setWriter(std::shared_ptr<RecordingWriter> writer) {
  endRecording();
  if (!writer) return;
  writer_ = std::move(writer);
  options_.waitForRecording = false;
  status_.recordingFailure.clear();
  if (source_) recordConfiguration(); // it may have changed since the head was written
  if (tare_) recordTare();
}

} // namespace palp
