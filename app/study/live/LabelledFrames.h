#pragma once

#include "app/study/decoding/Calibration.h"

#include <filesystem>
#include <optional>

namespace palp {

/// "(0.10, 0.00, -3.00) N".
std::string inNewton(const Eigen::Vector3d& force_N);

/// Why the label can hardly be the load on the sensor now, as text: it presses and the network reads rest, or the
/// other way round; it has another sign than what is read, or another size by far; empty where both may be true. Gains
/// and offsets that calibration removes do not count.
std::string labelAgainstReading(const Eigen::Vector3d& label_N, const DecodedForces& reads, int area,
                                const Decoder& decoder);

/// Labelled frames of a board as they are collected: each the mean of some frames under one known load.
class LabelledFrames {
public:
  /// Begins to average under a load; what was being averaged is dropped. Throws Error where the load is none of the
  /// design's.
  void begin(const Decoder& decoder, const SensorDesign& design, const KnownTouch& label, int frames);
  void stop() { average_.reset(); }
  /// Takes a frame while one is collected; true where it was the last one. Throws Error where the load moved meanwhile:
  /// then nothing is added.
  bool add(const DecodedForces& forces);
  /// Why the frame that was collected last may have a wrong label, as text; empty if it seems right.
  [[nodiscard]] const std::string& doubt() const { return doubt_; }
  [[nodiscard]] bool collecting() const { return average_.has_value(); }
  [[nodiscard]] int collected() const { return average_ ? average_->count() : 0; }
  [[nodiscard]] int wanted() const { return wanted_; }

  [[nodiscard]] const SampleSet& samples() const { return samples_; }
  void remove(Eigen::Index sample);
  void clear();
  /// Other frames in place of those that are here, and what the network in use gave for each.
  void replace(const SampleSet& samples, const Eigen::Matrix3Xd& predicted_N);
  /// Adds the frames of a file (palp listen --append). Throws Error where they are of another design.
  void load(const std::filesystem::path& path);
  /// Adds frames that were read from there. Throws Error where they are of another design.
  void append(const SampleSet& frames, const std::string& from);
  /// Forces predicted from each frame when it was collected [N]; NaN for those of a file.
  [[nodiscard]] const Eigen::Matrix3Xd& predicted_N() const { return predicted_N_; }
  /// Throws Error.
  void save(const std::filesystem::path& path) const;

private:
  std::optional<FrameAverage> average_;
  int wanted_ = 0;
  SampleSet samples_;
  Eigen::Matrix3Xd predicted_N_;
  std::string doubt_;
};

} // namespace palp
