#include "nn/RbfEvaluator.h"

#include "nn/linear/VectorKernels.h"

#include <algorithm>
#include <cassert>

namespace palp {
namespace {

constexpr std::size_t kLanes = kernels::kBlockLanes;
/// Samples that go through a block of centres together.
constexpr std::size_t kTogether = 8;

std::vector<double> copyOf(const Eigen::MatrixXd& m) {
  return {m.data(), m.data() + m.size()};
}

/// [block][input][lane] from inputs x centres; missing lanes are 0.
std::vector<double> packedCenters(const Eigen::MatrixXd& centers, std::size_t blocks) {
  const std::size_t rows = static_cast<std::size_t>(centers.rows());
  std::vector<double> result(blocks * rows * kLanes, 0.0);
  for (Eigen::Index c = 0; c < centers.cols(); ++c)
    for (std::size_t r = 0; r < rows; ++r) {
      const std::size_t column = static_cast<std::size_t>(c);
      result[(column / kLanes * rows + r) * kLanes + column % kLanes] = centers(static_cast<Eigen::Index>(r), c);
    }
  return result;
}

/// [output][lane of all blocks] from outputs x centres; missing lanes are 0.
std::vector<double> packedWeights(const Eigen::MatrixXd& weights, std::size_t blocks) {
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(blocks * kLanes), weights.rows());
  padded.topRows(weights.cols()) = weights.transpose();
  return copyOf(padded);
}

} // namespace

RbfEvaluator::RbfEvaluator(const RbfNetwork& network)
    : inputs_(static_cast<std::size_t>(network.inputs())),
      dimensions_(static_cast<std::size_t>(network.scaler.dimensions())),
      outputs_(static_cast<std::size_t>(network.outputs())),
      blocks_((static_cast<std::size_t>(network.centers.cols()) + kLanes - 1) / kLanes),
      rate_(gaussianRate(network.spread, network.convention)), remainder_(network.form == BasisForm::Remainder),
      offset_(copyOf(network.scaler.offset)), factor_(copyOf(network.scaler.factor)),
      rotation_(network.scaler.rotation.size() > 0 ? copyOf(network.scaler.jacobian()) : std::vector<double>()),
      centers_(packedCenters(network.centers, blocks_)), weights_(packedWeights(network.weights, blocks_)),
      tail_(copyOf(network.tail)), bias_(copyOf(network.bias)) {}

std::size_t RbfEvaluator::scratchSize() const {
  return dimensions_ + blocks_ * kLanes;
}

void RbfEvaluator::scale(const double* sample, double* scaled, double* output) const {
  std::copy(bias_.begin(), bias_.end(), output);
  if (rotation_.empty())
    for (std::size_t d = 0; d < inputs_; ++d) scaled[d] = (sample[d] - offset_[d]) * factor_[d];
  else {
    std::fill_n(scaled, dimensions_, 0.0);
    for (std::size_t i = 0; i < inputs_; ++i) {
      const double shifted = sample[i] - offset_[i];
      const double* column = rotation_.data() + i * dimensions_;
      for (std::size_t d = 0; d < dimensions_; ++d) scaled[d] += column[d] * shifted;
    }
  }
  if (tail_.empty()) return;
  for (std::size_t d = 0; d < dimensions_; ++d)
    for (std::size_t o = 0; o < outputs_; ++o) output[o] += tail_[d * outputs_ + o] * scaled[d];
}

void RbfEvaluator::evaluate(std::span<const double> sample, std::span<double> output, std::span<double> scratch) const {
  assert(sample.size() == inputs_ && output.size() == outputs_ && scratch.size() >= scratchSize());
  scale(sample.data(), scratch.data(), output.data());
  kernels::addGaussians({dimensions_, outputs_, blocks_, rate_, remainder_, centers_.data(), weights_.data()},
                        scratch.data(), scratch.data() + dimensions_, output.data());
}

void RbfEvaluator::evaluate(const Eigen::Ref<const Eigen::MatrixXd>& samples,
                            Eigen::Ref<Eigen::MatrixXd> output) const {
  const kernels::PackedNetwork network{dimensions_, outputs_,        blocks_,        rate_,
                                       remainder_,  centers_.data(), weights_.data()};
  std::vector<double> scaled(kTogether * dimensions_), basis(kTogether * blocks_ * kLanes),
      results(kTogether * outputs_);
  const Eigen::Index step = static_cast<Eigen::Index>(kTogether);
  for (Eigen::Index first = 0; first < samples.cols(); first += step) {
    const Eigen::Index count = std::min(step, samples.cols() - first);
    for (Eigen::Index s = 0; s < step; ++s) // a last group that is not full repeats its last sample
      scale(samples.col(first + std::min(s, count - 1)).data(),
            scaled.data() + s * static_cast<Eigen::Index>(dimensions_),
            results.data() + s * static_cast<Eigen::Index>(outputs_));
    kernels::addGaussiansEight(network, scaled.data(), basis.data(), results.data());
    for (Eigen::Index s = 0; s < count; ++s)
      output.col(first + s) = Eigen::Map<const Eigen::VectorXd>(
          results.data() + s * static_cast<Eigen::Index>(outputs_), static_cast<Eigen::Index>(outputs_));
  }
}

} // namespace palp
