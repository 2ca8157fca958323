#include "nn/inversion/PlaceKernel.h"

#include "model/base/Monomials.h"

#include <algorithm>
#include <cmath>

namespace palp {

Eigen::MatrixXi placeMonomials(Eigen::Index inputs, const std::vector<Eigen::Index>& others,
                               const std::vector<int>& amplitudes, int degree) {
  const Eigen::MatrixXi all =
      monomialExponents(static_cast<Eigen::Index>(others.size()), amplitudes.empty() ? 0 : 1, degree);
  Eigen::MatrixXi exponents = Eigen::MatrixXi::Zero(inputs, all.cols());
  Eigen::Index count = 0;
  for (Eigen::Index j = 0; j < all.cols(); ++j) {
    exponents(others, count) = all.col(j);
    const auto contains = [&](int amplitude) { return exponents(amplitude, count) > 0; };
    if (amplitudes.empty() || std::any_of(amplitudes.begin(), amplitudes.end(), contains)) ++count;
  }
  return exponents.leftCols(count);
}

Eigen::MatrixXd monomialsOf(const SplineTable& form, const Eigen::MatrixXd& inputs, double decay, int least) {
  Eigen::MatrixXd all(form.terms(), inputs.cols());
  for (Eigen::Index j = 0; j < form.terms(); ++j) {
    Eigen::ArrayXd value =
        Eigen::ArrayXd::Constant(inputs.cols(), std::pow(decay, form.exponents.col(j).sum() - least));
    for (Eigen::Index k = 0; k < form.inputs(); ++k)
      for (int power = 0; power < form.exponents(k, j); ++power)
        value *= inputs.row(k).transpose().array() + form.shift(k);
    all.row(j) = value.transpose();
  }
  return all;
}

Eigen::Vector2d nodeOf(const SplineTable& form, int x, int y) {
  return {form.place[0] < 0 ? 0 : form.low(0) + x * form.step(0),
          form.place[1] < 0 ? 0 : form.low(1) + y * form.step(1)};
}

Eigen::MatrixXd gaussians(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double width) {
  Eigen::MatrixXd result(a.cols(), b.cols());
  for (Eigen::Index j = 0; j < b.cols(); ++j)
    result.col(j) = (-(a.colwise() - b.col(j)).colwise().squaredNorm() / (2 * width * width)).array().exp();
  return result;
}

} // namespace palp
