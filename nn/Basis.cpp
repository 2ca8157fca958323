#include "nn/Basis.h"

#include "nn/NetworkError.h"
#include "nn/VectorKernels.h"

#include <cmath>
#include <numbers>

namespace palp {

std::string name(SpreadConvention convention) {
  return convention == SpreadConvention::Radbas ? "radbas" : "sigma";
}

SpreadConvention spreadConventionNamed(const std::string& text) {
  for (const SpreadConvention convention : {SpreadConvention::Radbas, SpreadConvention::Sigma})
    if (name(convention) == text) return convention;
  throw NetworkError("spread convention '" + text + "': not known, allowed are radbas and sigma");
}

std::string name(BasisForm form) {
  return form == BasisForm::Gaussian ? "gaussian" : "remainder";
}

BasisForm basisFormNamed(const std::string& text) {
  for (const BasisForm form : {BasisForm::Gaussian, BasisForm::Remainder})
    if (name(form) == text) return form;
  throw NetworkError("basis '" + text + "': not known, allowed are gaussian and remainder");
}

double gaussianRate(double spread, SpreadConvention convention) {
  return (convention == SpreadConvention::Radbas ? std::numbers::ln2 : 0.5) / (spread * spread);
}

Eigen::MatrixXd squaredDistances(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                 const Eigen::Ref<const Eigen::MatrixXd>& b) {
  Eigen::MatrixXd result(a.cols(), b.cols());
  const Eigen::MatrixXd rowsOfA = a.transpose(); // contiguous over the samples of a, as the kernel wants it
  for (Eigen::Index j = 0; j < b.cols(); ++j)
    kernels::squaredDistancesToPoint(rowsOfA.data(), rowsOfA.rows(), rowsOfA.cols(), b.col(j).data(),
                                     result.col(j).data());
  return result;
}

void basisInPlace(Eigen::Ref<Eigen::MatrixXd> squaredDistance, double gamma, BasisForm form) {
  for (Eigen::Index j = 0; j < squaredDistance.cols(); ++j) {
    double* column = squaredDistance.col(j).data();
    const auto count = static_cast<std::size_t>(squaredDistance.rows());
    if (form == BasisForm::Gaussian)
      kernels::exponential(column, count, -gamma);
    else
      kernels::exponentialRemainder(column, count, gamma);
  }
}

} // namespace palp
