#pragma once

#include "model/base/NamedEnum.h"
#include "nn/RbfNetwork.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// How the linear system of the weights is solved.
enum class LeastSquaresMethod {
  PivotedQr,    ///< column-pivoted QR, directions below rcond dropped
  Cholesky,     ///< with a ridge of at least 1e-12
  TruncatedSvd, ///< singular values below rcond dropped
  Recursive,    ///< recursive least squares with forgetting, the paper's method
};
inline constexpr NamedEnum kLeastSquaresMethods("solver",
                                                std::array{std::pair{LeastSquaresMethod::PivotedQr, "qr"},
                                                           std::pair{LeastSquaresMethod::Cholesky, "cholesky"},
                                                           std::pair{LeastSquaresMethod::TruncatedSvd, "svd"},
                                                           std::pair{LeastSquaresMethod::Recursive, "rls"}});
inline std::string name(LeastSquaresMethod method) {
  return kLeastSquaresMethods.name(method);
}

/// How the centres of the Gaussians are chosen.
enum class CenterChoice { Samples, KMeans, Random };
/// Names of the two that choose some of the samples. Samples (all of them) has no name: it follows from the number of
/// centres.
inline constexpr NamedEnum kCenterChoices("choice of centres", std::array{std::pair{CenterChoice::KMeans, "kmeans"},
                                                                          std::pair{CenterChoice::Random, "random"}});
/// Default limit of the number of centres.
inline constexpr int kMostCenters = 600;

/// Terms added to the Gaussians.
enum class Tail {
  None,
  Bias,
  Linear,          ///< bias and linear tail, exact as in kriging: the weights are orthogonal to it
  LinearPenalised, ///< bias and linear tail as ordinary weights; for noise and for few samples
};
inline constexpr NamedEnum kTails("tail", std::array{std::pair{Tail::None, "none"}, std::pair{Tail::Bias, "bias"},
                                                     std::pair{Tail::Linear, "linear"},
                                                     std::pair{Tail::LinearPenalised, "penalised"}});

struct RbfOptions {
  Scaling scaling = Scaling::Global;
  /// Scaling::Whiten: the exponent by which small components are amplified. Empty: 0.25, 0.5 or 0.75, chosen by
  /// leave-one-out if spread or ridge is chosen that way too, else 0.5.
  std::optional<double> whitening;
  CenterChoice centers = CenterChoice::Samples;
  int centerCount = 0;          ///< for KMeans and Random; 0: at most kMostCenters. Samples uses all samples
  std::optional<double> spread; ///< empty: chosen by leave-one-out
  SpreadConvention convention = SpreadConvention::Radbas;
  Tail tail = Tail::Linear;
  double tailVariance = 100; ///< LinearPenalised: prior variance of the tail's weights relative to the Gaussians'
  LeastSquaresMethod method = LeastSquaresMethod::PivotedQr;
  std::optional<double> ridge = 0.0; ///< empty: chosen by leave-one-out over 1e-13..10
  double rcond = 1e-15;
  double forgetting = 1; ///< Recursive: factor in (0, 1]
  /// Relative standard deviation of the noise of each input (sigma_i = |x_i| * relativeInputNoise). If above 0, the
  /// network is fitted to noiseCopies copies of the samples with this noise.
  double relativeInputNoise = 0;
  int noiseCopies = 10;
  bool leaveOneOut = true; ///< report the leave-one-out error (costs about as much as the fit)
  std::uint64_t seed = 1;
  int threads = 0; ///< 0: all cores; changes the time, never the result
};

/// Chosen parameters of a fit, and figures to judge it by.
struct FitReport {
  double spread = 0;
  double ridge = 0;
  int centers = 0;
  double condition = 0; ///< estimated condition number of the system that was solved
  int rank = 0;
  double largestWeight = 0;
  Eigen::VectorXd leaveOneOut; ///< root mean square of the leave-one-out errors, one per output; empty: not requested
  Eigen::MatrixXd leaveOneOutResiduals; ///< outputs x samples; empty: not requested
  std::string leftOut;                  ///< how rows were left out instead of one by one, as text; empty: one by one
  double seconds = 0;
  std::vector<std::string> warnings; ///< complete sentences
};

struct RbfFit {
  RbfNetwork network;
  FitReport report;
};

/// Fits a network to samples (inputs x samples) and targets (outputs x samples). Throws NetworkError if no
/// network can be fitted to the data, and Cancelled if stopped.
RbfFit trainRbf(const Eigen::Ref<const Eigen::MatrixXd>& samples, const Eigen::Ref<const Eigen::MatrixXd>& targets,
                const RbfOptions& options = {}, const std::stop_token& stop = {});

} // namespace palp
