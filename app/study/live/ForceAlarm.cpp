#include "app/study/live/ForceAlarm.h"

#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kBack = 0.05;          // of the limit
constexpr double kLeastBack = 1. / 300; // of the force range, where the limit is near 0: 0.02 N of 6 N

double valueOf(ForceQuantity quantity, const Eigen::Vector3d& force_N) {
  return quantity == ForceQuantity::Size ? force_N.norm() : force_N(static_cast<Eigen::Index>(quantity));
}

/// The area whose force is farthest beyond the limit (by_N below 0: within it).
struct Beyond {
  Eigen::Index area = 0;
  double value_N = 0, by_N = 0;
};

Beyond mostBeyond(const ForceAlarm& alarm, const Eigen::Ref<const Eigen::Matrix3Xd>& forces_N) {
  const bool pressed = !forces_N.isZero(0);
  std::optional<Beyond> most;
  for (Eigen::Index area = 0; area < forces_N.cols(); ++area) {
    if (pressed && forces_N.col(area).isZero(0)) continue; // nothing presses this area, but another one
    const double value_N = valueOf(alarm.quantity, forces_N.col(area));
    const double beyond_N = alarm.side == AlarmSide::Above ? value_N - alarm.limit_N : alarm.limit_N - value_N;
    if (!most || beyond_N > most->by_N) most = Beyond{area, value_N, beyond_N};
  }
  return *most;
}

std::string sentence(const ForceAlarm& alarm, const Beyond& most, Eigen::Index areas) {
  const std::string place = areas > 1 ? " on area " + std::to_string(most.area) : "";
  return "alarm: " + std::string(kForceQuantities.name(alarm.quantity)) + " " + withDecimals(most.value_N, 3) + " N" +
         place + " is " + std::string(kAlarmSides.name(alarm.side)) + " " + withDigits(alarm.limit_N, 4) + " N";
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
  const Beyond most = mostBeyond(*alarm_, forces_N);
  const double back_N = std::max(kBack * std::abs(alarm_->limit_N), kLeastBack * range_N_);
  const bool lasts = !words_.empty();
  if (lasts && most.by_N <= -back_N) return lose();
  if (!lasts && !(most.by_N > 0)) return {};
  // Within the hysteresis the force is not beyond the limit: the words stay those of the last one that was.
  if (most.by_N > 0) words_ = sentence(*alarm_, most, forces_N.cols());
  return lasts ? std::nullopt : std::optional(words_);
}

} // namespace palp
