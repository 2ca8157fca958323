#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace palp {

/// Least and largest value of each reading over samples that come block by block.
class ConstantReadings {
public:
  /// Readings x samples.
  void add(const Eigen::Ref<const Eigen::MatrixXd>& readings);

  /// Those that stay the same to rounding over all samples.
  [[nodiscard]] std::vector<Eigen::Index> constant() const;
  /// A sentence that names them with their values: a broken wire, a dead channel. Empty where there is none, or where
  /// the samples are too few to tell.
  [[nodiscard]] std::string inWords(const std::function<std::string(Eigen::Index)>& name,
                                    const std::string& unit) const;

private:
  Eigen::VectorXd low_, high_;
  Eigen::Index samples_ = 0;
};

} // namespace palp
