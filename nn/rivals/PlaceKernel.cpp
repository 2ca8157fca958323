#include "nn/rivals/PlaceKernel.h"

#include <algorithm>
#include <cmath>

namespace palp {

Eigen::MatrixXi placeMonomials(Eigen::Index inputs, const std::vector<Eigen::Index>& others,
                               const std::vector<int>& strengths, int degree) {
  std::vector<Eigen::VectorXi> all;
  const int least = strengths.empty() ? 0 : 1;
  for (int total = least; total <= degree; ++total) {
    Eigen::VectorXi now = Eigen::VectorXi::Zero(inputs);
    const auto fill = [&](const auto& self, std::size_t k, int left) -> void {
      if (k == others.size()) {
        const bool strong = std::any_of(strengths.begin(), strengths.end(), [&](int s) { return now(s) > 0; });
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

Eigen::MatrixXd gaussians(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double width) {
  Eigen::MatrixXd result(a.cols(), b.cols());
  for (Eigen::Index j = 0; j < b.cols(); ++j)
    result.col(j) = (-(a.colwise() - b.col(j)).colwise().squaredNorm() / (2 * width * width)).array().exp();
  return result;
}

} // namespace palp
