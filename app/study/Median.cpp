#include "app/study/Median.h"

#include <algorithm>

namespace palp {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.size() % 2 == 1 ? *middle : (*std::max_element(values.begin(), middle) + *middle) / 2;
}

Eigen::Vector3d median(const std::vector<Eigen::Vector3d>& values) {
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> ofAxis;
    for (const Eigen::Vector3d& value : values) ofAxis.push_back(value(axis));
    result(axis) = median(std::move(ofAxis));
  }
  return result;
}

} // namespace palp
