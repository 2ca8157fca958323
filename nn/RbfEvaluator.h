#pragma once

#include "nn/RbfNetwork.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace palp {

/// An RbfNetwork laid out for speed: no allocation per sample, double precision, the machine's vector instructions.
/// Immutable, so threads may share it.
class RbfEvaluator {
public:
  explicit RbfEvaluator(const RbfNetwork& network);

  [[nodiscard]] std::size_t inputs() const { return inputs_; }
  [[nodiscard]] std::size_t outputs() const { return outputs_; }
  /// Number of doubles of scratch memory that `evaluate` needs from its caller.
  [[nodiscard]] std::size_t scratchSize() const;
  /// One sample. Sizes are inputs(), outputs(), scratchSize().
  void evaluate(std::span<const double> sample, std::span<double> output, std::span<double> scratch) const;
  /// Many samples, one column each; faster per sample than one at a time. `output` is outputs x samples.
  void evaluate(const Eigen::Ref<const Eigen::MatrixXd>& samples, Eigen::Ref<Eigen::MatrixXd> output) const;

private:
  /// Scaled inputs, and the tail and bias as the output to add to.
  void scale(const double* sample, double* scaled, double* output) const;

  std::size_t inputs_ = 0;
  std::size_t dimensions_ = 0; ///< of the scaled inputs
  std::size_t outputs_ = 0;
  std::size_t blocks_ = 0;
  double rate_ = 1;
  bool remainder_ = false;
  std::vector<double> offset_, factor_;
  std::vector<double> rotation_; ///< [input][dimension], the factors in it; empty: none
  std::vector<double> centers_;  ///< blocks of 16 centres: [block][dimension][lane]
  std::vector<double> weights_;  ///< [output][block][lane]
  std::vector<double> tail_;     ///< [dimension][output]
  std::vector<double> bias_;
};

} // namespace palp
