#include "app/study/reports/layout/SignalComparison.h"

#include <cmath>

namespace palp {

SignalComparison comparedWith(const LogSensitivity& other, const LogSensitivity& own) {
  SignalComparison compared;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double mixed = 0, ofOther = 0, ofOwn = 0;
    for (std::size_t area = 0; area < own.size(); ++area) {
      mixed += own[area][axis].cwiseProduct(other[area][axis]).sum();
      ofOther += other[area][axis].squaredNorm();
      ofOwn += own[area][axis].squaredNorm();
    }
    const auto force = static_cast<Eigen::Index>(axis);
    compared.factor(force) = std::sqrt(ofOwn / ofOther);
    compared.correlation(force) = mixed / std::sqrt(ofOwn * ofOther);
  }
  return compared;
}

} // namespace palp
