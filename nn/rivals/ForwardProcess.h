#pragma once

// Private to nn: the work of fitting a model of touches.

#include "nn/rivals/KernelInversion.h"
#include "nn/rivals/MirrorGroup.h"
#include "nn/rivals/SplineTable.h"

#include <Eigen/Core>

#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// What leave-one-out chooses.
struct Smoothness {
  double width = 0.14;     ///< of the Gaussians over the places, of the places' range
  double reach = 0.3;      ///< of each further degree's coefficients
  double smoothing = 1e-6; ///< variance left to a sample, of the components' own
  bool mirrored = true;    ///< the samples have the mirrors that the body is said to have
};

/// What all samples decide, then models of some of them. The components z of the causes c, with x their places and m_j
/// the monomials of the others, are a Gaussian process with the covariance
///   k(c, c') = v0 + exp(-|x - x'|^2 / (2 width^2)) sum_j reach^(2 degree_j - 2) m_j m_j'
/// and its mean is a table's splines times monomials (C. E. Rasmussen, C. K. I. Williams,
/// Gaussian Processes for Machine Learning, 2006, 2.2, 5.4.2). Where the body has mirrors, each component has a parity
/// p, the covariance sum over the mirrors' products g of sign(p, g) k(c, g c'), and systems of its own: to learn from n
/// samples is then to learn from n and all their images.
class ForwardProcess {
public:
  ForwardProcess(const Eigen::MatrixXd& measurements, const Eigen::MatrixXd& causes, const Eigen::VectorXi& groups,
                 const KernelForwardOptions& options, const std::stop_token& stop);
  void chooseSmoothness();
  [[nodiscard]] double width() const { return smoothness_.width * range_; }
  [[nodiscard]] KernelForwardModel modelOf(const std::vector<Eigen::Index>& samples) const;

private:
  /// Components of one parity, which stand side by side.
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
  void takeKnown();
  [[nodiscard]] Eigen::MatrixXd knownAt(const Eigen::MatrixXd& scaled) const;
  [[nodiscard]] SplineTable tableOf(const std::vector<Eigen::Index>& samples, const Eigen::MatrixXd& weights) const;

  const KernelForwardOptions& options_;
  const std::stop_token& stop_;
  MirrorGroup mirrors_;
  KernelForwardModel common_;           ///< less its table
  SplineTable form_;                    ///< without coefficients and rest
  std::vector<Eigen::Index> varied_;    ///< causes
  SplineTable known_;                   ///< what is known beforehand; without coefficients: nothing
  std::vector<Eigen::MatrixXd> images_; ///< scaled causes that vary x samples, for each of the mirrors' products
  std::vector<Part> parts_;
  Eigen::MatrixXd components_;
  double range_ = 0; ///< largest of the places
  Smoothness smoothness_;
};

} // namespace palp
