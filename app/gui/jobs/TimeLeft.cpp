#include "app/gui/jobs/TimeLeft.h"

#include <QObject>

#include <algorithm>
#include <cmath>

namespace palp {

QString roughly(double seconds) {
  if (seconds < 20) return QObject::tr("%1 s").arg(std::max(1.0, std::round(seconds)));
  if (seconds < 90) return QObject::tr("%1 s").arg(5 * std::round(seconds / 5));
  if (seconds < 300) return QObject::tr("%1 min").arg(0.5 * std::round(seconds / 30));
  return QObject::tr("%1 min").arg(std::round(seconds / 60));
}

void TimeLeft::begin(double done, double now_s) {
  from_ = done;
  since_s_ = now_s;
}

void TimeLeft::pause(double done, double now_s) {
  seen_ += done - from_;
  took_s_ += now_s - since_s_;
  begin(done, now_s);
}

std::optional<double> TimeLeft::left_s(double done, double all, double now_s) const {
  const double seen = seen_ + done - from_;
  if (!(seen > 0)) return std::nullopt;
  return (all - done) * (took_s_ + now_s - since_s_) / seen;
}

std::optional<double> LeftOfShares::at(double share) const {
  constexpr double kFirst_s = 2, kLeast = 0.1;
  const double took_s = 1e-3 * static_cast<double>(clock_.elapsed());
  if (took_s < kFirst_s || share < kLeast || share >= 1) return std::nullopt;
  return took_s * (1 - share) / share;
}

std::string leftInWords(std::optional<double> left_s) {
  return left_s ? QObject::tr(", about %1 left").arg(roughly(*left_s)).toStdString() : std::string();
}

} // namespace palp
