#pragma once

#include "nn/RbfNetwork.h"

#include <Eigen/Core>

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Many measurements as a smooth function of a few causes, by Gaussians in the space of the causes: what the
/// polynomials of ForwardModel are where the causes include a place, over which measurements rise and fall. The
/// measurements are taken together into those components that stand out of the noise.
struct KernelForwardModel {
  Eigen::VectorXd causeOffset, causeFactor; ///< causes to the network's inputs, (y - offset) * factor; 0: never varied
  Eigen::VectorXd causeDeviation;           ///< known beforehand of each cause: range / sqrt(12), about the offset
  Eigen::VectorXd measurementOffset;
  Eigen::MatrixXd projection; ///< components x measurements: in standard deviations of the noise
  RbfNetwork network;         ///< scaled causes that vary -> components
  Eigen::VectorXd deviation;  ///< of each component: noise and the network's own error
  Eigen::VectorXd inflation;  ///< of each cause: error on samples that were held out, over that expected of it

  [[nodiscard]] Eigen::Index measurements() const { return measurementOffset.size(); }
  [[nodiscard]] Eigen::Index causes() const { return causeOffset.size(); }
  [[nodiscard]] Eigen::Index components() const { return deviation.size(); }
};

struct KernelForwardOptions {
  double relativeNoise = 0; ///< of each measurement
  int threads = 0;          ///< 0: all cores; the result is the same
};

struct KernelForwardFit {
  KernelForwardModel model;
  std::vector<Eigen::Index> heldOut; ///< every fifth sample: inverted by a model of the others
  Eigen::MatrixXd heldOutResiduals;  ///< causes x these: true less estimated
  std::vector<std::string> warnings; ///< whole sentences
};

/// One column a sample. Causes of one group are of one kind and share a unit: along those of group 0 (places)
/// distances count as they are; how much the range of another group counts is chosen by leave-one-out. Throws
/// NetworkError where nothing can be fitted, and Cancelled.
KernelForwardFit fitKernelForwardModel(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                                       const Eigen::Ref<const Eigen::MatrixXd>& causes, const Eigen::VectorXi& groups,
                                       const KernelForwardOptions& options, const std::stop_token& stop = {});

/// Causes of one measurement vector.
struct KernelEstimate {
  Eigen::VectorXd causes;
  Eigen::VectorXd standardDeviation;
  double chiSquare = 0; ///< mean square of what is left, in standard deviations: 1 if model and noise fit
};

/// Maximum a posteriori by Gauss-Newton steps (Levenberg's damping) from the most likely of the training samples, each
/// cause normal with the variance of its range; keeps what inverting many has in common. The model must outlive it.
class KernelInversion {
public:
  explicit KernelInversion(const KernelForwardModel& model);
  [[nodiscard]] KernelEstimate estimate(const Eigen::Ref<const Eigen::VectorXd>& measurement) const;

private:
  struct Trial;
  [[nodiscard]] Trial descend(const Eigen::VectorXd& start, const Eigen::VectorXd& wanted) const;
  [[nodiscard]] double cost(const Eigen::VectorXd& left, const Eigen::VectorXd& scaled) const;

  const KernelForwardModel& model_;
  std::vector<Eigen::Index> varied_;
  Eigen::VectorXd weight_;    ///< 1 / deviation
  Eigen::VectorXd precision_; ///< of the scaled causes that vary, known beforehand
  Eigen::MatrixXd starts_;    ///< scaled causes of the training samples
  Eigen::MatrixXd expected_;  ///< weighted components there
};

} // namespace palp
