#pragma once

#include "model/base/NamedEnum.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace palp {

enum class ForceQuantity { Fx, Fy, Fz, Size };
inline constexpr NamedEnum
    kForceQuantities("force", std::array{std::pair{ForceQuantity::Fx, "Fx"}, std::pair{ForceQuantity::Fy, "Fy"},
                                         std::pair{ForceQuantity::Fz, "Fz"}, std::pair{ForceQuantity::Size, "|F|"}});
enum class AlarmSide { Above, Below };
inline constexpr NamedEnum kAlarmSides("side", std::array{std::pair{AlarmSide::Above, "above"},
                                                          std::pair{AlarmSide::Below, "below"}});

/// A limit of the decoded force.
struct ForceAlarm {
  ForceQuantity quantity = ForceQuantity::Fz;
  AlarmSide side = AlarmSide::Below;
  double limit_N = -5;

  bool operator==(const ForceAlarm&) const = default;
};

/// Goes off where the force on any area passes the limit, and is over where those on all areas are back by 5 % of it:
/// noise about the limit is one alarm.
class AlarmWatch {
public:
  void set(std::optional<ForceAlarm> alarm);
  /// The largest range of the forces: near a limit of 0 a share of it counts.
  void setRange(double range_N) { range_N_ = range_N; }
  /// Takes the forces of a frame, 3 x areas: each one counts that is not 0, or all. Returns text on what begins or is
  /// over.
  std::optional<std::string> add(const Eigen::Ref<const Eigen::Matrix3Xd>& forces_N);
  /// There are no forces: an alarm that lasts is over. Returns text on that only.
  std::optional<std::string> lose();
  /// As text with the present force, while it lasts; else empty.
  [[nodiscard]] const std::string& words() const { return words_; }

private:
  std::optional<ForceAlarm> alarm_;
  double range_N_ = 0;
  std::string words_;
};

} // namespace palp
