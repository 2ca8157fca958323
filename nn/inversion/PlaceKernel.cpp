#include "nn/inversion/PlaceKernel.h"

#include <algorithm>
#include <cmath>

namespace palp {

Eigen::MatrixXi placeMonomials(Eigen::Index inputs, const std::vector<Eigen::Index>& others,
                               const std::vector<int>& amplitudes, int degree) {
  std::vector<Eigen::VectorXi> all;
  const int least = amplitudes.empty() ? 0 : 1;
  for (int total = least; total <= degree; ++total) {
    Eigen::VectorXi now = Eigen::VectorXi::Zero(inputs);
    const auto fill = [&](const auto& self, std::size_t k, int left) -> void {
      if (k == others.size()) {
        const bool strong = std::any_of(amplitudes.begin(), amplitudes.end(), [&](int s) { return now(s) > 0; });
        if (left == 0 && (least == 0 || strong)) all.push_back(now);
        return;
      }
      for (int power = left; power >= 0; --power) {
        now(others[k]) = power;
        self(self, k + 1, left - power);
      }
      now(others[k]) = 0;
    };
    fill(fill, 0, total);
  }
  Eigen::MatrixXi exponents(inputs, static_cast<Eigen::Index>(all.size()));
  for (std::size_t j = 0; j < all.size(); ++j) exponents.col(static_cast<Eigen::Index>(j)) = all[j];
  return exponents;
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
