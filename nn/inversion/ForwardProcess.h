#pragma once

// Private to nn: fits a forward model of touches.

#include "nn/inversion/KernelInversion.h"
#include "nn/inversion/MirrorGroup.h"
#include "nn/inversion/SplineTable.h"

#include <Eigen/Core>

#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// Hyperparameters, chosen by leave-one-out.
struct Smoothness {
  double width = 0.14;     ///< of the Gaussians over the positions, as a share of their range
  double decay = 0.3;      ///< of the coefficients from one degree to the next
  double smoothing = 1e-6; ///< variance of a sample's own error, relative to the components'
  bool mirrored = true;    ///< whether the samples have the mirrors that the options state
};

/// Prepares what all samples determine (scaling, components, hyperparameters), then fits models to some of them. The
/// components z of the parameters c, with x their positions and m_j the monomials of the others, are a Gaussian process
/// with the covariance
///   k(c, c') = v0 + exp(-|x - x'|^2 / (2 width^2)) sum_j decay^(2 degree_j - 2) m_j m_j'
/// and its mean is a table's splines times monomials (C. E. Rasmussen, C. K. I. Williams,
/// Gaussian Processes for Machine Learning, 2006, 2.2, 5.4.2). Where the body has mirrors, each component has a parity
/// p, the covariance sum over the mirrors' products g of sign(p, g) k(c, g c'), and a system of its own: n samples
/// then count as n samples and all their images.
class ForwardProcess {
public:
  ForwardProcess(const Eigen::MatrixXd& measurements, const Eigen::MatrixXd& parameters, const Eigen::VectorXi& groups,
                 const KernelForwardOptions& options, const std::stop_token& stop);
  void chooseSmoothness();
  [[nodiscard]] double width() const { return smoothness_.width * range_; }
  [[nodiscard]] KernelForwardModel modelOf(const std::vector<Eigen::Index>& samples) const;

private:
  /// Components of one parity, which are adjacent.
  struct Part {
    int parity;
    Eigen::Index from, count;
  };
  struct Fitted {
    Eigen::MatrixXd weights;     ///< samples x components
    Eigen::MatrixXd leaveOneOut; ///< residuals, samples x components
  };
  /// All components are one part where the samples have no mirrors.
  [[nodiscard]] std::vector<Part> partsFor(const Smoothness& by) const;
  [[nodiscard]] std::size_t imagesFor(const Smoothness& by) const { return by.mirrored ? images_.size() : 1; }
  void project(const Eigen::MatrixXd& centred, const Eigen::VectorXd& noise);
  [[nodiscard]] Eigen::MatrixXd placesOf(const Eigen::MatrixXd& scaled) const;
  [[nodiscard]] std::vector<Eigen::MatrixXd> covariances(const std::vector<Eigen::Index>& samples,
                                                         const Smoothness& by) const;
  [[nodiscard]] std::optional<Fitted> fitted(const std::vector<Eigen::Index>& samples, const Smoothness& by) const;
  void placeNodes();
  void subtractPrior();
  [[nodiscard]] Eigen::MatrixXd priorAt(const Eigen::MatrixXd& scaled) const;
  [[nodiscard]] SplineTable tableOf(const std::vector<Eigen::Index>& samples, const Eigen::MatrixXd& weights) const;

  const KernelForwardOptions& options_;
  const std::stop_token& stop_;
  MirrorGroup mirrors_;
  KernelForwardModel common_;           ///< without its table
  SplineTable form_;                    ///< without coefficients and rest
  std::vector<Eigen::Index> varied_;    ///< parameters
  SplineTable prior_;                   ///< prior mean; without coefficients: none
  std::vector<Eigen::MatrixXd> images_; ///< scaled parameters that vary x samples, for each of the mirrors' products
  std::vector<Part> parts_;
  Eigen::MatrixXd components_;
  double range_ = 0; ///< the larger of the positions'
  Smoothness smoothness_;
};

} // namespace palp
