#include "app/study/live/drift/DriftMonitor.h"

#include "app/study/Median.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palp {

namespace {

constexpr double kNormalMedian = 0.6745; // of |x| for a normal x of deviation 1
constexpr double kAtRest = 2;            // times the noise that the readings scatter about their median
constexpr double kMemory_s = 1;
constexpr std::size_t kFewest = 8; // readings

} // namespace

void DriftMonitor::restart() {
  drift_.reset();
}

void DriftMonitor::add(const Eigen::MatrixXd& change, double noise, double time_s) {
  std::vector<double> good;
  for (const double value : change.reshaped())
    if (std::isfinite(value)) good.push_back(value);
  if (good.size() < kFewest || !(noise > 0)) return;
  const double middle = median(good);
  for (double& value : good) value = std::abs(value - middle);
  if (median(std::move(good)) / kNormalMedian > kAtRest * noise) return; // touched
  const double step_s = std::max(0.0, time_s - last_s_);
  last_s_ = time_s;
  drift_ = drift_ ? *drift_ + (middle - *drift_) * (1 - std::exp(-step_s / kMemory_s)) : middle;
}

} // namespace palp
