#pragma once

#include "io/board/VirtualBoard.h"
#include "model/SampleSet.h"
#include "nn/baselines/ForwardModel.h"

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace palp {

class TouchHand;

/// A finger that presses one load area after the other: the resistances that the solver gives for it, by a polynomial
/// an area through solved samples, so that nothing is solved while the board is simulated.
class SimulatedTouch {
public:
  struct Truth {
    int area = 0;
    Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
    std::optional<Eigen::Vector2d> place_mm{}; ///< of an indenter, in place of the area: MovingTouch
  };

  /// Samples with one area loaded at a time, on every area. Throws Error where they are others.
  explicit SimulatedTouch(const SampleSet& samples);

  /// The touch at a time: each area for `kTouch_s`, the first half at rest (time to tare), then pressed with a
  /// shear that goes round.
  [[nodiscard]] Truth truth(double time_s) const;
  /// Row-wires x column-wires [ohm].
  [[nodiscard]] Eigen::MatrixXd resistances_ohm(const Truth& truth) const;
  /// Lets a hand hold the touch from now on.
  void follow(std::shared_ptr<const TouchHand> hand) { hand_ = std::move(hand); }
  /// For Board: valid until the next call.
  const Eigen::MatrixXd& at(double time_s);

  [[nodiscard]] int rowWires() const { return rowWires_; }
  [[nodiscard]] int columnWires() const { return columnWires_; }
  [[nodiscard]] const std::string& designFingerprint() const { return designFingerprint_; }

  static constexpr double kTouch_s = 2;

private:
  int rowWires_ = 0;
  int columnWires_ = 0;
  std::string designFingerprint_;
  ForwardModel response_; ///< change of R since rest, row-wires times column-wires, of the force
  Eigen::VectorXd rest_ohm_;
  Eigen::Vector3d low_N_, high_N_; ///< range of the samples
  Eigen::MatrixXd now_ohm_;
  std::shared_ptr<const TouchHand> hand_; ///< null: none
};

/// Holds the simulated touch, from any thread.
class TouchHand {
public:
  /// None: the touch moves over the areas automatically.
  void hold(const std::optional<SimulatedTouch::Truth>& touch);
  [[nodiscard]] std::optional<SimulatedTouch::Truth> held() const;
  /// What touches at a time of the board, moved automatically or held; only of a simulated board with an indenter.
  void tell(double time_s, const SimulatedTouch::Truth& now);
  /// Its state at the time closest to this one, of the last few hundred; none before the first.
  [[nodiscard]] std::optional<SimulatedTouch::Truth> at(double time_s) const;

private:
  mutable std::mutex mutex_;
  std::optional<SimulatedTouch::Truth> touch_;
  std::deque<std::pair<double, SimulatedTouch::Truth>> states_;
};

/// A virtual board of the sensor that the samples are of, under the simulated touch: of samples of touches under an
/// indenter that wanders. Keeps what it needs.
VirtualBoard simulatedBoard(const SampleSet& samples, const BoardDisturbance& disturbance, int rate_Hz,
                            std::uint64_t seed, std::shared_ptr<TouchHand> hand = {});

} // namespace palp
