#pragma once

#include "model/base/NamedEnum.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace palp {

/// What is made of each reading before anything is learned from it.
enum class ReadingTransform { None, Logarithm, Inverse };
inline constexpr NamedEnum kReadingTransforms("transform", std::array{std::pair{ReadingTransform::None, "x"},
                                                                      std::pair{ReadingTransform::Logarithm, "ln"},
                                                                      std::pair{ReadingTransform::Inverse, "1/x"}});

/// From readings to the inputs of a decoder: a transform, and a memory of what was before. With signals g (the
/// transformed readings, or weights * readings + constant) and their first-order low passes s_k' = (g - s_k) / tau_k
/// the inputs are [transformed readings, g - s_1, g - s_2, ...]: the differences are 0 at rest and after a long hold,
/// so the decoder without memory is among those with one (resources/docs/numerics/measured.md).
struct InputStage {
  ReadingTransform transform = ReadingTransform::None;
  std::vector<double> times_s; ///< tau_k, ascending; empty: no memory
  Eigen::MatrixXd weights;     ///< signals x readings; empty: the signals are the transformed readings
  Eigen::VectorXd constant;    ///< signals
  double longestGap_s = 0;     ///< a longer one between two samples begins a new run; 0: none does
  bool rowsAreClock = false;   ///< times are the samples' numbers: they are equally spaced

  [[nodiscard]] bool hasMemory() const { return !times_s.empty(); }
  [[nodiscard]] Eigen::Index inputs(Eigen::Index readings) const;

  [[nodiscard]] Eigen::MatrixXd transformed(const Eigen::Ref<const Eigen::MatrixXd>& readings) const;
  [[nodiscard]] Eigen::MatrixXd rememberedOf(const Eigen::Ref<const Eigen::MatrixXd>& transformed) const;
  /// The same for readings that have been held for long: the differences are 0.
  [[nodiscard]] Eigen::MatrixXd held(const Eigen::Ref<const Eigen::MatrixXd>& readings) const;
  /// Derivative of the inputs by the readings at one sample, inputs x readings, for a change that is quick against the
  /// memory: the states stay.
  [[nodiscard]] Eigen::MatrixXd slope(const Eigen::Ref<const Eigen::VectorXd>& readings) const;
  /// Inputs x samples from readings x samples. `clock_s` and `runs` (1 x samples; no rows: no clock, one run) are
  /// needed by a memory, unless rows are its clock: a new run begins where the run changes or a gap is too long. Throws
  /// NetworkError without a clock.
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::Ref<const Eigen::MatrixXd>& readings, const Eigen::MatrixXd& clock_s,
                                      const Eigen::MatrixXd& runs) const;
};

/// 0, 1, 2, ...: the clock of rows that are equally spaced in time.
inline Eigen::VectorXd rowNumbers(Eigen::Index count) {
  return Eigen::VectorXd::LinSpaced(count, 0, static_cast<double>(count - 1));
}

/// First-order low passes of signals, exact for signals that are linear between their samples, at any spacing.
class MemoryStates {
public:
  explicit MemoryStates(std::vector<double> times_s, double longestGap_s = 0)
      : times_s_(std::move(times_s)), longestGap_s_(longestGap_s) {}

  /// The next sample begins a new run: all states are its signals.
  void reset() { started_ = false; }
  /// Signals minus their states after this sample, the first time constant first: (signals times) numbers.
  const Eigen::VectorXd& next(double time_s, const Eigen::Ref<const Eigen::VectorXd>& values);

private:
  std::vector<double> times_s_;
  double longestGap_s_;
  bool started_ = false;
  double time_s_ = 0;
  Eigen::VectorXd before_; ///< signals of the last sample
  Eigen::MatrixXd states_; ///< signals x times
  Eigen::VectorXd differences_;
};

} // namespace palp
