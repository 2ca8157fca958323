#pragma once

#include "app/study/live/ForceDecoder.h"
#include "model/LoadCase.h"

#include <filesystem>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Labelled frames that a calibration takes at least: 4 unknowns for each force, and as many again to judge them by.
inline constexpr Eigen::Index kFewestCalibrationFrames = 8;

/// Places of the labels against those of a network that gives them, along x and y.
struct PlaceCalibration {
  Eigen::Vector2d rmseBefore_mm, rmseAfter_mm; ///< after: each sample judged by a fit without it
  bool improved = false;                       ///< the refined network is better on samples that it has not seen
};

/// What is known of labelled frames as a training set for a network.
struct CalibrationReport {
  Eigen::Index samples = 0;
  std::vector<int> samplesPerArea;
  Eigen::Vector3d lowest_N, highest_N;       ///< of the labels
  Eigen::Vector3d coverage_percent;          ///< of the network's force range
  Eigen::Vector3d rmseBefore_N, rmseAfter_N; ///< after: each sample judged by a fit without it
  Eigen::Vector3d rmseAfter_percentOfRange;
  Eigen::Index worstSample = 0;
  double worstError_N = 0; ///< |F' - F| of it, by a fit without it
  /// How far the change of R that the network's design gives under each label is from the frame's, as share of the
  /// frame's: median over the frames under load. None without a forward model.
  std::optional<double> modelMismatch;
  std::string opposed;   ///< components ("z") whose labels have the opposite sign of what the network reads
  bool improved = false; ///< the refined network is better on samples that it has not seen
  std::optional<PlaceCalibration> place; ///< where both network and frames have places
};

/// Why the labels can hardly belong to the frames, or the fit is of no use; empty where all is well.
std::vector<std::string> warningsOf(const CalibrationReport& report);

struct Calibration {
  Decoder decoder; ///< refined
  CalibrationReport report;
};

/// Refines a network with labelled frames of a real board: recursive least squares for F = A N(R) + b from A = 1, b =
/// 0, which an RBF network takes into its weights and the polynomials of maximum likelihood into their arguments; that
/// of touches and that of measured rows keep it as a correction of their answers. Places, where both have them, are
/// refined alike. Throws Error where the network is another one, the frames are of other wires or too few, and
/// Cancelled.
Calibration calibrate(const Decoder& decoder, const SampleSet& frames, const std::stop_token& stop = {});

/// A known load on the board: on an area, or by a touch at a place, whose area is the one under it.
struct KnownTouch {
  AreaLoad load;
  std::optional<Eigen::Vector2d> place_mm = {};
};
/// A touch at this place. Throws Error where it lies off the face.
KnownTouch knownTouch(const SensorDesign& design, const Eigen::Vector2d& place_mm, const Eigen::Vector3d& force_N);

/// Mean of frames under one known load: one labelled frame for `calibrate`.
class FrameAverage {
public:
  FrameAverage(const Decoder& decoder, const SensorDesign& design, const KnownTouch& label);
  /// Takes the frame where it is valid.
  void add(const DecodedForces& forces);
  [[nodiscard]] int count() const { return count_; }
  /// Mean of the forces predicted from the frames [N]; NaN before the first.
  [[nodiscard]] Eigen::Vector3d predicted_N() const;
  /// Which force changed between the frames, from where to where, as text; empty if the load was constant.
  [[nodiscard]] std::string moved() const;
  /// That the network predicts the load on another area than the label has, as text; empty if not, or if it cannot.
  [[nodiscard]] std::string onAnotherArea() const;
  /// The mean so far.
  [[nodiscard]] SampleSet sample() const;

private:
  SampleSet set_;
  Eigen::MatrixXd sum_;
  Eigen::Vector3d range_N_; ///< of the network
  std::vector<Eigen::Vector3d> predicted_N_;
  std::map<int, int> seenOn_; ///< frames that the network is sure of, by area
  int count_ = 0;
};

/// Adds labelled frames to a file, which is made where it is not there. Throws Error where its frames are of another
/// design.
void appendFrames(const std::filesystem::path& path, const SampleSet& frames);

} // namespace palp
