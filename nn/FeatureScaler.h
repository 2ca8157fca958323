#pragma once

#include "model/base/NamedEnum.h"

#include <Eigen/Core>

#include <string>

namespace palp {

/// How inputs are scaled to order 1 before distances are computed.
enum class Scaling {
  Raw,    ///< left as they are
  MinMax, ///< each input to [-1, 1]
  ZScore, ///< each input to mean 0 and standard deviation 1
  Global, ///< mean subtracted, then one factor for all inputs: the sample farthest from the mean -> distance 1
  Whiten, ///< principal components, small ones raised, those lost in noise dropped; see whitened()
};

inline constexpr NamedEnum
    kScalings("scaler", std::array{std::pair{Scaling::Raw, "raw"}, std::pair{Scaling::MinMax, "minmax"},
                                   std::pair{Scaling::ZScore, "zscore"}, std::pair{Scaling::Global, "global"},
                                   std::pair{Scaling::Whiten, "whiten"}});
inline std::string name(Scaling scaling) {
  return kScalings.name(scaling);
}

/// Affine map of each input, (x - offset) * factor, and a rotation after it where there is one. An input that does not
/// vary has factor 0: it carries no information.
struct FeatureScaler {
  Scaling scaling = Scaling::Raw;
  Eigen::VectorXd offset;
  Eigen::VectorXd factor;
  Eigen::MatrixXd rotation; ///< scaled inputs x inputs; empty: none

  /// Number of inputs, and of scaled inputs.
  [[nodiscard]] Eigen::Index inputs() const { return offset.size(); }
  [[nodiscard]] Eigen::Index dimensions() const { return rotation.size() > 0 ? rotation.rows() : offset.size(); }

  /// Fits the scaling to the columns of `samples`.
  static FeatureScaler fit(Scaling scaling, const Eigen::Ref<const Eigen::MatrixXd>& samples);
  /// Principal components of the inputs relative to their size (so that relative noise is the same in all directions).
  /// Component k, of standard deviation s_k, is multiplied by s_k / (s_k^2 + noise^2)^((1 + power) / 2): power 0 keeps
  /// the proportions of components above the noise, power 1 makes them equal. Components below a tenth of the noise are
  /// dropped. Then one factor for all: the sample farthest from the mean -> distance 1.
  static FeatureScaler whitened(const Eigen::Ref<const Eigen::MatrixXd>& samples, double relativeNoise, double power);
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;
  /// d scaled / d input, dimensions() x inputs().
  [[nodiscard]] Eigen::MatrixXd jacobian() const;
  /// Only for a scaler without rotation.
  [[nodiscard]] Eigen::MatrixXd invert(const Eigen::Ref<const Eigen::MatrixXd>& scaled) const;
};

} // namespace palp
