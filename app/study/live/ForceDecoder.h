#pragma once

#include "app/study/decoding/PartialPredictor.h"
#include "app/study/live/NoiseMeter.h"
#include "app/study/live/Plausibility.h"
#include "io/board/BoardFrame.h"
#include "io/board/Tare.h"
#include "model/SensorDesign.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palp {

/// Forces of one frame of a board.
struct DecodedForces {
  bool valid = false;        ///< false: there are no forces, for the given `reason`
  std::string reason;        ///< why the frame is not valid: bad wires, an incomplete frame
  int readings = 0;          ///< number that the decoder takes
  int missingReadings = 0;   ///< of these; the force is found without them, with larger deviations
  Eigen::Matrix3Xd forces_N; ///< 3 x 1, of the touched area; `together`: 3 x areas
  /// Of each force: from the noise of frame and tare, the training error, the error at rest, and the error that a
  /// calibration left.
  Eigen::Matrix3Xd standardDeviation_N;
  /// Whether the decoder gives each component; the others are 0 with a deviation of 0. Empty: all.
  Eigen::Array<bool, 3, Eigen::Dynamic> measured;
  std::vector<bool> shown; ///< per column: whether the force exceeds the noise
  std::optional<int> area; ///< most likely touched area, if the decoder determines it
  double areaConfidence = 0;
  /// Position of the touch on the top face and its deviations, if the decoder gives it and the force exceeds the noise.
  std::optional<Eigen::Vector2d> place_mm, placeDeviation_mm;
  std::optional<double> indenterSize_mm; ///< of that touch, if the decoder determines it
  bool outsideTrainingRange = false;     ///< of the forces, or without a forward model of the readings
  std::optional<double> misfit;          ///< Plausibility::Verdict::misfit
  bool doubted = false;                  ///< the forces of this frame are implausible
  std::string doubt;                     ///< why recent forces are implausible; empty if they are plausible
  Eigen::MatrixXd resistances_ohm;       ///< tared, row-wires x column-wires; valid in the rows that the decoder reads

  /// Whether the decoder gives this component.
  [[nodiscard]] bool measures(Eigen::Index axis, Eigen::Index column) const {
    return measured.size() == 0 || measured(axis, column);
  }
  /// Returns `values` (forces_N or standardDeviation_N) for display or storage, with NaN for components not measured.
  [[nodiscard]] Eigen::Matrix3Xd measuredAlone(const Eigen::Matrix3Xd& values) const;
};

/// Computes forces from the frames of a board. Bad readings do not reach the decoder: if readings are missing (a wire
/// is broken, a report is lost), the others give the force, with larger deviations, as long as they are at least half
/// of all. The tare is computed here, not on the board: each resistance is scaled so that the board at rest has the
/// readings of the design at rest.
class ForceDecoder {
public:
  /// `design` gives the resistances at rest for the tare; nullopt: those of the paper's design, if the decoder was
  /// trained for it. Throws Error if the decoder cannot read this board.
  ForceDecoder(Decoder decoder, const BoardInfo& info, std::optional<SensorDesign> design = {});

  [[nodiscard]] DecodedForces decode(const BoardFrame& frame);

  /// Starts to average the good readings of the next `frames` frames that give forces; restarts while the readings
  /// move. Throws Error if the resistances of the design at rest are unknown.
  void startTare(int frames);
  [[nodiscard]] bool taring() const { return tareLeft_ > 0; }
  [[nodiscard]] bool tared() const { return tared_; }
  /// Number of finished tares.
  [[nodiscard]] int tares() const { return tares_; }
  /// The tare in use.
  [[nodiscard]] const Tare& tare() const { return tare_; }
  /// Uses an earlier tare, also one made with another network. Ignored if its size is not that of the design at rest.
  void setTare(const Tare& tare);
  void clearTare();
  /// Returns why taring is impossible; empty if it is possible.
  [[nodiscard]] std::string tareProblem() const;

  /// Returns the force [N] that a sensor at rest appears to have after all readings have changed by the share
  /// `relative`; 0 if the resistances at rest are unknown, or if the network gives several forces together.
  [[nodiscard]] Eigen::Vector3d drifted_N(double relative) const;

  /// Relative noise of the readings: measured by the tare; before the first tare from frame to frame, but not below the
  /// noise that the decoder was trained for.
  [[nodiscard]] double noise() const { return noise_; }
  [[nodiscard]] const Decoder& decoder() const { return *decoder_; }
  /// Width of the largest force range in training.
  [[nodiscard]] double range_N() const { return (decoder_->high_N - decoder_->low_N).maxCoeff(); }
  /// Of the design, row-wires x column-wires; empty if unknown.
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
  std::optional<Predictor> predictor_; ///< for the present noise
  PredictOptions predictorOptions_;
  std::unique_ptr<PartialPredictor> fewer_; ///< the same for missing readings; made when first needed
  std::optional<MemoryStates> memory_;      ///< if the decoder has a memory
  std::uint64_t memoryFrames_ = 0;          ///< that it has seen, its clock where rows are the clock
  Eigen::Matrix3Xd restError_N_;            ///< prediction for the design at rest, where the true force is zero
  Eigen::Array<bool, 3, Eigen::Dynamic> measured_;
  Eigen::Matrix3Xd calibrationError_N_;
  NoiseMeter meter_;
  std::optional<Plausibility> plausibility_;
  double predictedNoise_ = 0; ///< used by the predictor
  Eigen::MatrixXd rest_ohm_;  ///< of the design, row-wires x column-wires; empty: unknown
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
