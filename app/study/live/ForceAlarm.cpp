#include "app/study/live/ForceAlarm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace palp {

namespace {

constexpr double kBack = 0.05;        // of the limit
constexpr double kLeastBack_N = 0.02; // where the limit is near 0

double valueOf(ForceQuantity quantity, const Eigen::Vector3d& force_N) {
  return quantity == ForceQuantity::Size ? force_N.norm() : force_N(static_cast<Eigen::Index>(quantity));
}

} // namespace

void AlarmWatch::set(std::optional<ForceAlarm> alarm) {
  if (alarm == alarm_) return;
  alarm_ = alarm;
  words_.clear();
}

std::optional<std::string> AlarmWatch::lose() {
  if (words_.empty()) return {};
  words_.clear();
  return "alarm over";
}

std::optional<std::string> AlarmWatch::add(const Eigen::Ref<const Eigen::Matrix3Xd>& forces_N) {
  if (!alarm_ || forces_N.cols() == 0) return {};
  Eigen::Index area = 0;
  forces_N.colwise().squaredNorm().maxCoeff(&area);
  const double value_N = valueOf(alarm_->quantity, forces_N.col(area));
  const double beyond_N = alarm_->side == AlarmSide::Above ? value_N - alarm_->limit_N : alarm_->limit_N - value_N;
  const double back_N = std::max(kBack * std::abs(alarm_->limit_N), kLeastBack_N);
  const bool lasts = !words_.empty();
  if (lasts && beyond_N <= -back_N) return lose();
  if (!lasts && !(beyond_N > 0)) return {};
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "alarm: %s %.3f N is %s %.4g N",
                std::string(kForceQuantities.name(alarm_->quantity)).c_str(), value_N,
                std::string(kAlarmSides.name(alarm_->side)).c_str(), alarm_->limit_N);
  // Within the hysteresis the force is not beyond the limit: the words stay those of the last one that was.
  if (beyond_N > 0) words_ = text.data();
  return lasts ? std::nullopt : std::optional(words_);
}

} // namespace palp
