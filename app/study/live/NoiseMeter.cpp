#include "app/study/live/NoiseMeter.h"

#include "app/study/Median.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palp {

namespace {

/// Of |x| for a normal x of deviation 1.
constexpr double kMedianOfNoise = 0.6745;

} // namespace

void NoiseMeter::restart() {
  before_ohm_.resize(0);
  last_ohm_.resize(0);
  recent_.clear();
}

void NoiseMeter::add(const Eigen::VectorXd& readings_ohm) {
  if (before_ohm_.size() == readings_ohm.size() && readings_ohm.size() > 0) {
    const Eigen::ArrayXd second = (readings_ohm - 2 * last_ohm_ + before_ohm_).array() / readings_ohm.array();
    std::vector<double> sizes;
    for (const double value : second)
      if (std::isfinite(value)) sizes.push_back(std::abs(value));
    if (!sizes.empty()) recent_.push_back(median(std::move(sizes)) / (std::sqrt(6.0) * kMedianOfNoise)); // 1 + 4 + 1
    if (recent_.size() > kMost) recent_.pop_front();
  }
  before_ohm_ = std::move(last_ohm_);
  last_ohm_ = readings_ohm;
}

/// A frame's median of n readings is known to 1.17 / sqrt(2 n) of itself; neighbours share readings, so that three
/// frames count as one, and the median over the frames is worth a factor of 1.25.
double NoiseMeter::uncertainty() const {
  if (recent_.empty() || last_ohm_.size() == 0) return 1;
  const double frames = std::max(1.0, static_cast<double>(recent_.size()) / 3);
  return 1.25 * 1.17 / std::sqrt(2 * static_cast<double>(last_ohm_.size()) * frames);
}

double NoiseMeter::noise() const {
  return recent_.empty() ? 0 : median(std::vector<double>(recent_.begin(), recent_.end()));
}

} // namespace palp
