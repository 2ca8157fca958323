#include "nn/Basis.h"

#include "model/base/Cancelled.h"
#include "nn/linear/VectorKernels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {
namespace {

/// Points whose inputs stay in the fastest cache while they meet all others.
constexpr Eigen::Index kCachedRows = 64;

} // namespace

double gaussianRate(double spread, SpreadConvention convention) {
  return (convention == SpreadConvention::Radbas ? std::numbers::ln2 : 0.5) / (spread * spread);
}

Eigen::MatrixXd squaredDistances(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                                 const std::stop_token& stop) {
  Eigen::MatrixXd result(a.cols(), b.cols());
  const Eigen::MatrixXd rows = a.transpose(); // contiguous over the samples of a, as the kernel needs it
  for (Eigen::Index first = 0; first < rows.rows(); first += kCachedRows) {
    throwIfStopped(stop);
    for (Eigen::Index j = 0; j < b.cols(); ++j)
      kernels::squaredDistancesToPoint(&rows(first, 0), rows.rows(), std::min(kCachedRows, rows.rows() - first),
                                       rows.cols(), b.col(j).data(), &result(first, j));
  }
  return result;
}

Eigen::MatrixXd squaredDistances(const Eigen::Ref<const Eigen::MatrixXd>& a) {
  const Eigen::Index count = a.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, count);
  const Eigen::MatrixXd rows = a.transpose();
  for (Eigen::Index first = 0; first < count; first += kCachedRows) {
    const Eigen::Index last = std::min(first + kCachedRows, count);
    for (Eigen::Index j = 0; j < last; ++j) {
      const Eigen::Index top = std::max(first, j);
      kernels::squaredDistancesToPoint(&rows(top, 0), count, last - top, a.rows(), a.col(j).data(), &result(top, j));
    }
  }
  return result;
}

void basisInPlace(Eigen::Ref<Eigen::MatrixXd> squaredDistance, double gamma, BasisForm form) {
  for (Eigen::Index j = 0; j < squaredDistance.cols(); ++j) {
    double* column = squaredDistance.col(j).data();
    const auto count = static_cast<std::size_t>(squaredDistance.rows());
    if (form == BasisForm::Gaussian)
      kernels::gaussian(column, count, gamma);
    else
      kernels::gaussianRemainder(column, count, gamma);
  }
}

} // namespace palp
