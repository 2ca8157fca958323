#pragma once

#include <Eigen/Core>

#include <string>

namespace palp {

/// How inputs are brought to order 1 before distances are taken.
enum class Scaling {
  Raw,    ///< left as they are
  MinMax, ///< each input to [-1, 1]
  ZScore, ///< each input to mean 0 and standard deviation 1
  Global, ///< mean subtracted, then one factor for all inputs: the sample farthest from the mean -> distance 1
};

/// The scaling's name as on the command line: raw, minmax, zscore, global.
std::string name(Scaling scaling);
/// Throws NetworkError where no scaling has this name.
Scaling scalingNamed(const std::string& name);

/// Affine map of each input, (x - offset) * factor. An input that does not vary has factor 0: it tells nothing.
struct FeatureScaler {
  Scaling scaling = Scaling::Raw;
  Eigen::VectorXd offset;
  Eigen::VectorXd factor;

  /// From the columns of `samples`.
  static FeatureScaler fit(Scaling scaling, const Eigen::Ref<const Eigen::MatrixXd>& samples);
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;
  [[nodiscard]] Eigen::MatrixXd invert(const Eigen::Ref<const Eigen::MatrixXd>& scaled) const;
};

} // namespace palp
