#include "model/RubberLaw.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace palp {

namespace {

double stretching(const Eigen::Vector3d& l) {
  return l.squaredNorm() - 3; // I1 - 3
}

double energyOf(const MooneyRivlin& law, const Eigen::Vector3d& l) {
  return law.c10_MPa * stretching(l) + law.c01_MPa * stretching(l.cwiseInverse());
}
double energyOf(const NeoHooke& law, const Eigen::Vector3d& l) {
  return law.c10_MPa * stretching(l);
}
double energyOf(const Yeoh& law, const Eigen::Vector3d& l) {
  const double s = stretching(l);
  return s * (law.c10_MPa + s * (law.c20_MPa + s * law.c30_MPa));
}
double energyOf(const Gent& law, const Eigen::Vector3d& l) {
  return -law.mu_MPa * law.jm / 2 * std::log(1 - stretching(l) / law.jm);
}
double energyOf(const Ogden& law, const Eigen::Vector3d& l) {
  double energy = 0;
  for (std::size_t k = 0; k < law.alpha.size(); ++k)
    energy += 2 * law.mu_MPa[k] / (law.alpha[k] * law.alpha[k]) * (l.array().pow(law.alpha[k]).sum() - 3);
  return energy;
}

/// l_i dW/dl_i for W(I1): 2 W' l_i^2.
Eigen::Vector3d byFirstInvariant(double slope, const Eigen::Vector3d& l) {
  return 2 * slope * l.cwiseAbs2();
}

Eigen::Vector3d stressesOf(const MooneyRivlin& law, const Eigen::Vector3d& l) {
  return 2 * law.c10_MPa * l.cwiseAbs2() - 2 * law.c01_MPa * l.cwiseAbs2().cwiseInverse(); // I2 = sum of 1 / l_i^2
}
Eigen::Vector3d stressesOf(const NeoHooke& law, const Eigen::Vector3d& l) {
  return byFirstInvariant(law.c10_MPa, l);
}
Eigen::Vector3d stressesOf(const Yeoh& law, const Eigen::Vector3d& l) {
  const double s = stretching(l);
  return byFirstInvariant(law.c10_MPa + s * (2 * law.c20_MPa + 3 * s * law.c30_MPa), l);
}
Eigen::Vector3d stressesOf(const Gent& law, const Eigen::Vector3d& l) {
  const double left = 1 - stretching(l) / law.jm;
  return byFirstInvariant(left > 0 ? law.mu_MPa / 2 / left : std::numeric_limits<double>::quiet_NaN(), l);
}
Eigen::Vector3d stressesOf(const Ogden& law, const Eigen::Vector3d& l) {
  Eigen::Vector3d stresses = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < law.alpha.size(); ++k)
    stresses += (2 * law.mu_MPa[k] / law.alpha[k] * l.array().pow(law.alpha[k])).matrix();
  return stresses;
}

double modulusOf(const MooneyRivlin& law) {
  return 2 * (law.c10_MPa + law.c01_MPa);
}
double modulusOf(const NeoHooke& law) {
  return 2 * law.c10_MPa;
}
double modulusOf(const Yeoh& law) {
  return 2 * law.c10_MPa;
}
double modulusOf(const Gent& law) {
  return law.mu_MPa;
}
double modulusOf(const Ogden& law) {
  double sum = 0;
  for (const double mu : law.mu_MPa) sum += mu;
  return sum;
}

void scale(MooneyRivlin& law, double factor) {
  law.c10_MPa *= factor;
  law.c01_MPa *= factor;
}
void scale(NeoHooke& law, double factor) {
  law.c10_MPa *= factor;
}
void scale(Yeoh& law, double factor) {
  law.c10_MPa *= factor;
  law.c20_MPa *= factor;
  law.c30_MPa *= factor;
}
void scale(Gent& law, double factor) {
  law.mu_MPa *= factor;
}
void scale(Ogden& law, double factor) {
  for (double& mu : law.mu_MPa) mu *= factor;
}

/// Whether the matrix d(t_i - t_3) / d ln l_j (i, j = 1, 2) of incompressible rubber is positive definite there.
bool isStable(const RubberLaw& law, const Eigen::Vector3d& stretches) {
  constexpr double step = 1e-5; // of ln l; central differences are then right to 1e-9
  Eigen::Matrix2d D;
  for (int j = 0; j < 2; ++j) {
    std::array<Eigen::Vector3d, 2> stresses;
    for (int side = 0; side < 2; ++side) {
      const double change = std::exp(side == 0 ? -step : step);
      Eigen::Vector3d moved = stretches;
      moved(j) *= change;
      moved(2) /= change;
      stresses[static_cast<std::size_t>(side)] = principalStresses_MPa(law, moved);
    }
    const Eigen::Vector3d rate = (stresses[1] - stresses[0]) / (2 * step);
    D.col(j) = rate.head<2>().array() - rate(2);
  }
  return D(0, 0) + D(1, 1) > 0 && D(0, 0) * D(1, 1) - D(0, 1) * D(1, 0) > 0; // false for not a number
}

} // namespace

RubberLawKind kindOf(const RubberLaw& law) {
  return static_cast<RubberLawKind>(law.index());
}

std::string titleOf(RubberLawKind kind) {
  switch (kind) {
  case RubberLawKind::MooneyRivlin:
    return "Mooney-Rivlin";
  case RubberLawKind::NeoHooke:
    return "neo-Hooke";
  case RubberLawKind::Yeoh:
    return "Yeoh";
  case RubberLawKind::Gent:
    return "Gent";
  case RubberLawKind::Ogden:
    return "Ogden";
  }
  return {};
}

double shearModulus_MPa(const RubberLaw& law) {
  return std::visit([](const auto& of) { return modulusOf(of); }, law);
}

RubberLaw timesStress(RubberLaw law, double factor) {
  std::visit([factor](auto& of) { scale(of, factor); }, law);
  return law;
}

double energy_MPa(const RubberLaw& law, const Eigen::Vector3d& stretches) {
  return std::visit([&](const auto& of) { return energyOf(of, stretches); }, law);
}

Eigen::Vector3d principalStresses_MPa(const RubberLaw& law, const Eigen::Vector3d& stretches) {
  return std::visit([&](const auto& of) { return stressesOf(of, stretches); }, law);
}

Eigen::Vector3d testStretches(TestMode mode, double stretch) {
  switch (mode) {
  case TestMode::Uniaxial:
    return {stretch, 1 / std::sqrt(stretch), 1 / std::sqrt(stretch)};
  case TestMode::Equibiaxial:
    return {stretch, stretch, 1 / (stretch * stretch)};
  case TestMode::Planar:
    return {stretch, 1, 1 / stretch};
  }
  return Eigen::Vector3d::Ones();
}

double nominalStress_MPa(const RubberLaw& law, TestMode mode, double stretch) {
  const Eigen::Vector3d stresses = principalStresses_MPa(law, testStretches(mode, stretch));
  return (stresses(0) - stresses(2)) / stretch; // direction 2 is free in every test
}

StableRange stableRange(const RubberLaw& law, TestMode mode, double least, double most) {
  constexpr int steps = 400;
  const auto end = [&](double limit) {
    double stable = 1;
    for (int k = 0; k <= steps; ++k) {
      const double stretch = std::exp(std::log(limit) * k / steps);
      if (!isStable(law, testStretches(mode, stretch))) return stable;
      stable = stretch;
    }
    return limit;
  };
  return {end(least), end(most)};
}

} // namespace palp
