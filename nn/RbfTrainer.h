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

/// How the weights are found.
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

/// Where the Gaussians sit.
enum class CenterChoice { Samples, KMeans, Random };
/// Those that choose among the samples; all of them is a number of centres, not a way to choose.
inline constexpr NamedEnum kCenterChoices("choice of centres", std::array{std::pair{CenterChoice::KMeans, "kmeans"},
                                                                          std::pair{CenterChoice::Random, "random"}});
/// Default number of centres.
inline constexpr int kMostCenters = 600;

/// What is added to the Gaussians.
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
  /// Whiten: the power that raises small components. Empty: 0.25, 0.5 or 0.75, chosen by leave-one-out if spread or
  /// ridge is chosen that way too, else 0.5.
  std::optional<double> whitening;
  CenterChoice centers = CenterChoice::Samples;
  int centerCount = 0;          ///< KMeans, Random: how many; 0: kMostCenters at most. Samples: all
  std::optional<double> spread; ///< empty: by leave-one-out
  SpreadConvention convention = SpreadConvention::Radbas;
  Tail tail = Tail::Linear;
  double tailVariance = 100; ///< LinearPenalised: prior variance of the tail's weights against the Gaussians'
  LeastSquaresMethod method = LeastSquaresMethod::PivotedQr;
  std::optional<double> ridge = 0.0; ///< empty: by leave-one-out over 1e-13..10
  double rcond = 1e-15;
  double forgetting = 1; ///< Recursive: factor in (0, 1]
  /// Relative standard deviation of each input (sigma_i = |x_i| * it); 0: clean. Copies of the samples with noise of
  /// this size are what the network is fitted to.
  double relativeInputNoise = 0;
  int noiseCopies = 10;
  bool leaveOneOut = true; ///< report the leave-one-out error (costs about as much as the fit)
  std::uint64_t seed = 1;
  int threads = 0; ///< 0: as many as there are cores; the result is the same
};

/// What came out of a fit, and what one needs to know to trust it.
struct FitReport {
  double spread = 0;
  double ridge = 0;
  int centers = 0;
  double condition = 0; ///< estimate, of the system that was solved
  int rank = 0;
  double largestWeight = 0;
  Eigen::VectorXd leaveOneOut; ///< root mean square of the leave-one-out errors, one per output; empty: not requested
  Eigen::MatrixXd leaveOneOutResiduals; ///< outputs x samples; empty: not requested
  double seconds = 0;
  std::vector<std::string> warnings; ///< complete sentences
};

struct RbfFit {
  RbfNetwork network;
  FitReport report;
};

/// Fits a network to samples (inputs x samples) and targets (outputs x samples). Throws NetworkError for data from
/// which no network can be made, and Cancelled.
RbfFit trainRbf(const Eigen::Ref<const Eigen::MatrixXd>& samples, const Eigen::Ref<const Eigen::MatrixXd>& targets,
                const RbfOptions& options = {}, const std::stop_token& stop = {});

} // namespace palp
