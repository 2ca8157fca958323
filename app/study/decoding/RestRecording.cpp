#include "app/study/decoding/RestRecording.h"

#include "io/board/FrameAssembler.h"
#include "io/board/RecordingReader.h"
#include "model/base/Error.h"
#include "model/base/Text.h"

#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr int kFewestFrames = 10;
constexpr double kNotAtRest = 2.5; // times what neighbours in time differ by: as a tare has it

/// Sums about the first good reading, because the scatter is 1e-6 of the mean.
class RestSums {
public:
  void add(const BoardFrame& frame) {
    if (!frame.complete) return;
    const Eigen::ArrayXXd good = (frame.state.array() == ReadingState::Good).cast<double>();
    if (frames_++ == 0) {
      first_ohm_ = last_ = sum_ = squares_ = steps_ = counts_ = pairs_ =
          Eigen::ArrayXXd::Zero(good.rows(), good.cols());
      lastGood_ = Eigen::ArrayXXd::Zero(good.rows(), good.cols());
    }
    first_ohm_ = (first_ohm_ > 0).select(first_ohm_, good * frame.resistances_ohm.array());
    const Eigen::ArrayXXd now =
        (good > 0).select(frame.resistances_ohm.array() / (first_ohm_ > 0).select(first_ohm_, 1.0) - 1, 0.0);
    counts_ += good;
    sum_ += now;
    squares_ += now.square();
    const Eigen::ArrayXXd both = good * lastGood_;
    steps_ += both * (now - last_).square();
    pairs_ += both;
    last_ = now;
    lastGood_ = good;
    faults_ = wireFaults(frame);
  }

  void finish(RestRecording& rest, const std::string& file) const {
    if (frames_ < kFewestFrames)
      throw Error(file + ": " + std::to_string(frames_) + " complete frames; at least " +
                  std::to_string(kFewestFrames) + " at rest are needed");
    const Eigen::ArrayXXd mean = sum_ / counts_.max(1);
    rest.resistances_ohm =
        (2 * counts_ > frames_).select(first_ohm_ * (1 + mean), std::numeric_limits<double>::quiet_NaN());
    const double readings = counts_.sum();
    const double scatter = std::sqrt((squares_ - counts_ * mean.square()).max(0).sum() / std::max(readings, 1.0));
    const double neighbours = std::sqrt(steps_.sum() / (2 * std::max(pairs_.sum(), 1.0)));
    if (scatter > kNotAtRest * neighbours && neighbours > 0)
      throw Error(file + ": the sensor is not at rest there: its readings scatter by " + text(scatter) +
                  " of R, neighbours in time by " + text(neighbours));
    rest.noise = scatter / std::sqrt(frames_);
    rest.frames = frames_;
    rest.faults = faults_;
  }

private:
  int frames_ = 0;
  Eigen::ArrayXXd first_ohm_, last_, lastGood_, sum_, squares_, steps_, counts_, pairs_;
  std::vector<std::string> faults_;
};

} // namespace

RestRecording readRest(const std::filesystem::path& recording) {
  RecordingReader reader(recording);
  RestRecording rest;
  rest.info = reader.head().info;
  FrameAssembler assembler(rest.info, reader.head().configuration);
  RestSums sums;
  while (const auto entry = reader.next()) {
    if (entry->kind == RecordingEntry::Kind::Raw)
      assembler.add(entry->bytes, entry->hostTime_s, [&](const BoardFrame& frame) { sums.add(frame); });
    if (entry->kind == RecordingEntry::Kind::Configuration)
      if (const auto changed = decodeConfiguration(entry->bytes); std::holds_alternative<BoardConfiguration>(changed))
        assembler.setConfiguration(std::get<BoardConfiguration>(changed));
    if (entry->kind != RecordingEntry::Kind::Connected) continue;
    const auto board = decodeInfo(entry->bytes);
    if (!std::holds_alternative<BoardInfo>(board) || !(std::get<BoardInfo>(board) == rest.info))
      throw Error(recording.string() + ": is of more than one board");
    assembler.restart();
  }
  sums.finish(rest, recording.string());
  return rest;
}

} // namespace palp
