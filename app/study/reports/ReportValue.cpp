#include "app/study/reports/ReportValue.h"

#include "model/base/NumberText.h"

#include <cmath>

namespace palp {

std::string shortNumber(double value) {
  if (!std::isfinite(value)) return "-";
  return withDigits(value, 4);
}

std::string triple(const Eigen::Vector3d& values) {
  return shortNumber(values.x()) + " / " + shortNumber(values.y()) + " / " + shortNumber(values.z());
}

} // namespace palp
