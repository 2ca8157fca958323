#pragma once

#include "nn/baselines/ForwardModel.h"
#include "nn/inversion/KernelInversion.h"

#include <Eigen/Cholesky>

#include <string>
#include <vector>

namespace palp {

struct Decoder;

/// Which of a decoder's inputs came, and which did not; both ascending.
struct PresentReadings {
  std::vector<Eigen::Index> present, missing;
};

/// Why a decoder gives no force where some of its readings are missing; empty where it gives one.
std::string whyNotFewer(const Decoder& decoder);

/// The model of these measurements alone.
ForwardModel ofMeasurements(const ForwardModel& model, const std::vector<Eigen::Index>& kept);

/// What a forward model expects of the missing readings under the most likely touch of the others.
struct ImputedReadings {
  Eigen::VectorXd values;
  Eigen::MatrixXd scatter; ///< missing x independent normal numbers: how far the values may be off
};
ImputedReadings imputed(const ForwardModel& model, const LikelihoodEstimate& touch, const PresentReadings& readings);

/// Touches from some of the readings: the components that all readings would have are found by generalised least
/// squares, then the causes are refined with the covariance of these components, which what is missing widens.
class FewerTouchReadings {
public:
  /// `model`: its deviations with all noise, of which `noise` is the variance by noise alone, in that of the noise that
  /// components are counted in, `counted` [relative]. The model must outlive it.
  FewerTouchReadings(const KernelForwardModel& model, double noise, double counted, const PresentReadings& readings);
  /// `inversion`: of the same model. Values at missing readings are not read.
  [[nodiscard]] KernelEstimate estimate(const KernelInversion& inversion,
                                        const Eigen::Ref<const Eigen::VectorXd>& readings_ohm) const;

private:
  struct Fit;
  [[nodiscard]] Fit fitAt(const Eigen::VectorXd& scaled, const Eigen::VectorXd& components) const;

  const KernelForwardModel& model_;
  std::vector<Eigen::Index> present_, missing_, varied_;
  Eigen::MatrixXd toComponents_;           ///< components x present
  Eigen::MatrixXd toMissing_;              ///< missing x components
  Eigen::LLT<Eigen::MatrixXd> covariance_; ///< of the components
  Eigen::VectorXd precision_;              ///< of the scaled causes that vary, known beforehand
};

} // namespace palp
