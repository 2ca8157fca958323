#include "model/field/HeatKernel.h"

#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPanel = 1.9; // widest in ln t

KernelJet byImages(double s, double time, double length) {
  const double norm = 1 / std::sqrt(4 * kPi * time);
  KernelJet jet;
  for (int n = -3; n <= 3; ++n) {
    const double away = s + 2 * n * length;
    const double value = norm * std::exp(-away * away / (4 * time));
    const double rate = away / (2 * time);
    jet.value += value;
    jet.slope -= rate * value;
    jet.curvature += (rate * rate - 1 / (2 * time)) * value;
  }
  return jet;
}

KernelJet byCosines(double s, double time, double length) {
  KernelJet jet{1 / (2 * length), 0, 0};
  for (int n = 1; n <= 3; ++n) {
    const double k = n * kPi / length;
    const double size = std::exp(-k * k * time) / length;
    jet.value += size * std::cos(k * s);
    jet.slope -= size * k * std::sin(k * s);
    jet.curvature -= size * k * k * std::cos(k * s);
  }
  return jet;
}

} // namespace

KernelJet circleKernel(double s, double time, double length) {
  if (s > length) s -= 2 * length;
  if (s < -length) s += 2 * length;
  return time < length * length / kPi ? byImages(s, time, length) : byCosines(s, time, length);
}

HeatTimes heatTimes(double nearest_mm, double longest_mm, int pointsAPanel) {
  HeatTimes times;
  times.first = nearest_mm * nearest_mm / 160;               // exp(-d^2 / 4 t) = exp(-40)
  times.last = 45 * (longest_mm / kPi) * (longest_mm / kPi); // exp(-(pi / L)^2 t) = exp(-45)
  const double low = std::log(times.first), high = std::log(times.last);
  const int panels = static_cast<int>(std::ceil((high - low) / kPanel));
  const QuadratureRule rule = gaussOnPanels(Eigen::ArrayXd::LinSpaced(panels + 1, low, high), pointsAPanel);
  times.time = rule.points.exp();
  times.weight = rule.weights * times.time;
  return times;
}

} // namespace palp
