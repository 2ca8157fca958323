#pragma once

#include "app/cli/Cli.h"
#include "app/study/decoding/Calibration.h"
#include "app/study/live/LiveSession.h"

namespace palp {

/// --label, --append and --average, as given.
struct LabelArguments {
  std::string label, append, average = "50";
  void declare(Command command);
};

/// A known load on the sensor, under which frames are averaged to one labelled frame.
class LabelledMean {
public:
  /// Throws UsageError.
  LabelledMean(const LabelArguments& arguments, const Decoder& decoder, const SensorDesign& design);

  void add(const DecodedForces& forces);
  [[nodiscard]] bool done() const { return mean_.count() >= wanted_; }
  /// Adds the mean to the file; false where there was no frame with a force. Throws Error where the label can hardly be
  /// the load that was on the sensor, but with `anyway`.
  [[nodiscard]] bool append(Session& session, bool anyway) const;

private:
  [[nodiscard]] std::string doubt() const;

  std::string label_, file_;
  int wanted_ = 0;
  Decoder decoder_;
  KnownTouch touch_;
  FrameAverage mean_;
  DecodedForces last_;
};

/// None without --label. Throws UsageError.
std::optional<LabelledMean> labelledMean(const LabelArguments& arguments, const LiveOptions& options);

/// The frames that --tare averages: whether a load rests on the sensor in them. The last one is tared already.
class TareQuestion {
public:
  explicit TareQuestion(int frames) : wanted_(frames - 1) {}
  /// The next frame. Throws Error with the last one, where a plausible steady force exceeds the noise.
  void add(const DecodedForces& forces);

private:
  int wanted_ = 0, seen_ = 0, held_ = 0;
  double least_N_ = 0, most_N_ = 0;
};

} // namespace palp
