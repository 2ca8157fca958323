#pragma once

#include "io/Decoder.h"

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// What is to be judged of one frame.
struct PlausibilityInput {
  Eigen::VectorXd readings_ohm;            ///< what the decoder reads, tared
  std::vector<Eigen::Index> present;       ///< those of them that came; empty: all
  Eigen::VectorXd forces_N;                ///< decoded
  Eigen::VectorXd standardDeviation_N;     ///< of each
  std::optional<double> chiSquare;         ///< Prediction::chiSquare; none without a forward model
  std::optional<Eigen::VectorXd> likely_N; ///< Prediction::likely_N
  bool outsideInputs = false;              ///< Prediction::outsideTrainingRange
  double predictedNoise = 0;               ///< relative, that chiSquare counts with
  double noise = 0;                        ///< relative, of these readings; 0: not known yet
  double noiseUncertainty = 0;             ///< of it, relative
  double time_s = 0;                       ///< of the frame, on any clock
};

/// Whether a decoded force can be true: the readings are compared with those of the most likely single touch, the force
/// with the range of the training, and the network with that touch. One frame in a hundred of good readings is
/// doubted; only doubts that last are reported.
class Plausibility {
public:
  struct Verdict {
    /// rms of what the most likely touch leaves of the readings, in standard deviations of noise and model: 1 where
    /// they fit; none without a forward model or before the noise is known.
    std::optional<double> misfit;
    bool doubted = false; ///< this frame
    bool outside = false; ///< this frame's force lies outside of the training
    std::string reason;   ///< why forces are doubted for a while now; empty where they are not
  };

  explicit Plausibility(const Decoder& decoder);

  [[nodiscard]] Verdict judge(const PlausibilityInput& input);
  void restart();

  /// The share of good frames whose misfit lies above the limit.
  static constexpr double kFalseAlarms = 0.01;
  /// The limit of the misfit for this many readings (0.01 quantile of chi-square, Wilson and Hilferty 1931), widened by
  /// what is not known of the noise.
  [[nodiscard]] static double limit(Eigen::Index readings, double noiseUncertainty);

private:
  enum class Doubt { None, Foreign, Outside, Disagrees };
  [[nodiscard]] std::optional<double> misfit(const PlausibilityInput& input) const;
  void follow(Doubt doubt, double time_s);
  [[nodiscard]] std::string outsideWords(const PlausibilityInput& input) const;

  [[nodiscard]] double limitFor(const PlausibilityInput& input) const;

  /// Of each reading [ohm^2], or where touches were learned of each component of them [variances of the noise].
  Eigen::VectorXd noiseSquare_;     ///< variance as training counts it, over the square of the relative noise
  Eigen::VectorXd modelVariance_;   ///< by the forward model alone; empty: no such model
  double leftByOne_ = 0;            ///< KernelForwardModel::leftByOne; 0: the readings follow chi-square
  Eigen::VectorXd low_N_, range_N_; ///< of the training
  double trainedNoise_ = 0;
  double share_ = 0; ///< of the frames lately that were doubted
  double last_s_ = 0;
  bool held_ = false;
  Doubt heldDoubt_ = Doubt::None;
  double heldMisfit_ = 0;
  std::string heldOutside_; ///< which force, and its range
};

} // namespace palp
