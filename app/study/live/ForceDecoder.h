#pragma once

#include "app/study/decoding/PartialPredictor.h"
#include "app/study/live/NoiseMeter.h"
#include "app/study/live/Plausibility.h"
#include "io/board/BoardFrame.h"
#include "io/board/Tare.h"
#include "model/SensorDesign.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palp {

/// Forces of one frame of a board.
struct DecodedForces {
  bool valid = false;        ///< false: for the `reason`, and there are no forces
  std::string reason;        ///< which wires are bad, or that the frame is incomplete
  int readings = 0;          ///< that the decoder takes
  int missingReadings = 0;   ///< of them; the force was found without, and its deviations are wider
  Eigen::Matrix3Xd forces_N; ///< 3 x 1, of the touched area; `together`: 3 x areas
  /// Of each: noise of frame and tare, error of the training, at rest, and what a calibration left.
  Eigen::Matrix3Xd standardDeviation_N;
  /// Of each, whether the decoder gives it: the others are 0 with a deviation of 0. Empty: all.
  Eigen::Array<bool, 3, Eigen::Dynamic> measured;
  std::vector<bool> shown; ///< of the columns: exceeds the noise
  std::optional<int> area; ///< most likely touched, where the decoder determines it
  double areaConfidence = 0;
  /// Of the touch on the top face and its deviations, where the decoder gives it and the force exceeds the noise.
  std::optional<Eigen::Vector2d> place_mm, placeDeviation_mm;
  std::optional<double> indenterSize_mm; ///< of that touch, where the decoder finds it
  bool outsideTrainingRange = false;     ///< of the forces; of the readings where there is no forward model
  std::optional<double> misfit;          ///< Plausibility::Verdict::misfit
  bool doubted = false;                  ///< the forces of this frame can hardly be true
  std::string doubt;                     ///< why forces are doubted for a while now; empty where they are not
  Eigen::MatrixXd resistances_ohm; ///< tared, row-wires x column-wires; meaningful in the rows that the decoder reads

  /// Whether the decoder gives this component.
  [[nodiscard]] bool measures(Eigen::Index axis, Eigen::Index column) const {
    return measured.size() == 0 || measured(axis, column);
  }
  /// For who shows or keeps forces_N or standardDeviation_N: NaN where a component is not measured.
  [[nodiscard]] Eigen::Matrix3Xd measuredAlone(const Eigen::Matrix3Xd& values) const;
};

/// Resistances of a board's frames to forces. No bad reading reaches the decoder: where readings are missing (a wire is
/// broken, a report is lost) the others give the force, with wider deviations, as long as they are half of all. Tare is
/// the host's: each resistance is scaled so that the board at rest reads as the design at rest does.
class ForceDecoder {
public:
  /// `design` gives the resistances at rest for tare; none: the paper's where the decoder is of it. Throws Error where
  /// the decoder cannot read this board, in a sentence.
  ForceDecoder(Decoder decoder, const BoardInfo& info, std::optional<SensorDesign> design = {});

  [[nodiscard]] DecodedForces decode(const BoardFrame& frame);

  /// Averages the good readings of the next frames that give forces, and starts over while the sensor moves; throws
  /// Error where the design at rest is not known.
  void startTare(int frames);
  [[nodiscard]] bool taring() const { return tareLeft_ > 0; }
  [[nodiscard]] bool tared() const { return tared_; }
  /// How many were finished.
  [[nodiscard]] int tares() const { return tares_; }
  /// The one that holds.
  [[nodiscard]] const Tare& tare() const { return tare_; }
  /// One that was made before, also with another network; passed over where rest is not known.
  void setTare(const Tare& tare);
  void clearTare();
  /// Why taring is impossible; empty where it is possible.
  [[nodiscard]] std::string tareProblem() const;

  /// What a sensor at rest reads as where all its readings have gone by this factor since [N]; 0 where rest is not
  /// known, or where the network gives several forces together.
  [[nodiscard]] Eigen::Vector3d drifted_N(double relative) const;

  /// Relative noise of the readings: measured while taring, before that from frame to frame, and then no less than the
  /// decoder was trained for.
  [[nodiscard]] double noise() const { return noise_; }
  [[nodiscard]] const Decoder& decoder() const { return *decoder_; }
  /// The largest range of the forces that it was trained for.
  [[nodiscard]] double range_N() const { return (decoder_->high_N - decoder_->low_N).maxCoeff(); }
  /// Of the design, row-wires x column-wires [ohm]; empty where it is not known.
  [[nodiscard]] const Eigen::MatrixXd& restResistances_ohm() const { return rest_ohm_; }

private:
  [[nodiscard]] PresentReadings presentIn(const BoardFrame& frame) const;
  [[nodiscard]] std::string reasonAgainst(const BoardFrame& frame, const PresentReadings& readings) const;
  [[nodiscard]] Prediction predicted(double time_s, const Eigen::VectorXd& readings_ohm,
                                     const PresentReadings& readings);
  void addToTare(const BoardFrame& frame);
  void followNoise(const Eigen::VectorXd& raw_ohm);
  void setNoise(double noise);
  void addRestError(DecodedForces& decoded) const;
  [[nodiscard]] Eigen::Matrix3Xd withoutCalibration_N(const DecodedForces& decoded) const;
  void threshold(DecodedForces& decoded);
  void judge(const BoardFrame& frame, const Prediction& prediction, const Eigen::VectorXd& readings_ohm,
             const PresentReadings& readings, DecodedForces& decoded);

  std::unique_ptr<const Decoder> decoder_;
  std::optional<Predictor> predictor_; ///< for the noise now
  PredictOptions predictorOptions_;
  std::unique_ptr<PartialPredictor> fewer_; ///< the same where readings are missing; made when first needed
  std::optional<MemoryStates> memory_;      ///< of a decoder with one
  Eigen::Matrix3Xd restError_N_; ///< prediction of the decoder for the design at rest: there the truth is zero
  Eigen::Array<bool, 3, Eigen::Dynamic> measured_;
  Eigen::Matrix3Xd calibrationError_N_;
  NoiseMeter meter_;
  std::optional<Plausibility> plausibility_;
  double predictedNoise_ = 0; ///< that the predictor counts with
  Eigen::MatrixXd rest_ohm_;  ///< of the design, row-wires x column-wires; empty: not known
  Eigen::MatrixXd factor_;    ///< by which each raw resistance is scaled
  Eigen::MatrixXd tareFirst_, tareSum_, tareSquares_, tareCounts_;
  Tare tare_;
  int tareFrames_ = 0;
  int tareLeft_ = 0;
  int tares_ = 0;
  bool tared_ = false;
  double noise_ = 0;
  std::vector<bool> shown_;
};

} // namespace palp
