#include "model/field/HeatKernel.h"

#include <cmath>
#include <numbers>

namespace palp {

namespace {

KernelJet byImages(double s, double time, double length) {
  const double norm = 1 / std::sqrt(4 * std::numbers::pi * time);
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
    const double k = n * std::numbers::pi / length;
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
  return time < length * length / std::numbers::pi ? byImages(s, time, length) : byCosines(s, time, length);
}

HeatTimes heatTimes(double nearest_mm, double longest_mm, double digits) {
  const double exponent = digits * std::log(10.0), step = std::numbers::pi * std::numbers::pi / exponent;
  const double end = exponent + 3;                          // derivatives come with powers of it
  const double first = nearest_mm * nearest_mm / (4 * end); // exp(-d^2 / 4 t) = exp(-end)
  const double last =
      end * (longest_mm / std::numbers::pi) * (longest_mm / std::numbers::pi); // exp(-(pi / L)^2 t) = exp(-end)
  const auto steps = static_cast<Eigen::Index>(std::ceil(std::log(last / first) / step));
  HeatTimes times;
  times.time = first * (step * Eigen::ArrayXd::LinSpaced(steps + 1, 0, static_cast<double>(steps))).exp();
  times.weight = step * times.time;
  // geometric series
  times.before = step * first / std::expm1(step);
  times.after = step / std::sqrt(times.time(steps)) / std::expm1(step / 2);
  return times;
}

} // namespace palp
