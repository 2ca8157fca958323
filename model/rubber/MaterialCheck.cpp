#include "model/MaterialCheck.h"

#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <cmath>

namespace palp {

namespace {

constexpr double kLargestConstant_MPa = 1e9;
constexpr double kLeastAlpha = 0.01; // 2 mu / alpha cancels below
constexpr double kLargestAlpha = 50;

using Faults = std::vector<DesignFault>;

/// Adds a fault where the modulus is not a number or beyond what is allowed; true where it is allowed.
bool requireModulus(Faults& faults, const std::string& key, double value) {
  if (std::abs(value) <= kLargestConstant_MPa) return true; // false for NaN
  faults.push_back({"material." + key, gotExpected(value, " MPa", "-1e+09 to 1e+09 MPa")});
  return false;
}

void requireAboveZero(Faults& faults, const std::string& key, double value) {
  if (requireModulus(faults, key, value) && !(value > 0))
    faults.push_back({"material." + key, gotExpected(value, " MPa", "above 0")});
}

void checkLaw(Faults& faults, const MooneyRivlin& law) {
  const bool c10 = requireModulus(faults, "c10_MPa", law.c10_MPa), c01 = requireModulus(faults, "c01_MPa", law.c01_MPa);
  if (!c10 || !c01) return;
  if (!(law.c10_MPa > 0)) faults.push_back({"material.c10_MPa", gotExpected(law.c10_MPa, " MPa", "above 0")});
  if (!(law.c10_MPa + law.c01_MPa > 0))
    faults.push_back(
        {"material.c01_MPa", gotExpected(law.c01_MPa, " MPa", "c10 + c01 above 0, or the rubber has no stiffness")});
}

void checkLaw(Faults& faults, const NeoHooke& law) {
  requireAboveZero(faults, "c10_MPa", law.c10_MPa);
}

void checkLaw(Faults& faults, const Yeoh& law) {
  requireAboveZero(faults, "c10_MPa", law.c10_MPa);
  requireModulus(faults, "c20_MPa", law.c20_MPa);
  requireModulus(faults, "c30_MPa", law.c30_MPa);
}

void checkLaw(Faults& faults, const Gent& law) {
  requireAboveZero(faults, "mu_MPa", law.mu_MPa);
  if (!(law.jm > 0 && law.jm <= 1e9))
    faults.push_back({"material.jm", gotExpected(law.jm, "", "above 0 up to 1e+09 (largest I1 - 3 of the rubber)")});
}

void checkLaw(Faults& faults, const Ogden& law) {
  const std::size_t terms = law.mu_MPa.size();
  if (terms < 1 || terms > kMostOgdenTerms) {
    faults.push_back({"material.mu_MPa", gotExpected(std::to_string(terms) + " terms", "1 to 3")});
    return;
  }
  if (law.alpha.size() != terms) {
    faults.push_back({"material.alpha", gotExpected(std::to_string(law.alpha.size()) + " exponents",
                                                    "as many as mu_MPa has terms, " + std::to_string(terms))});
    return;
  }
  const std::size_t before = faults.size();
  for (std::size_t k = 0; k < terms; ++k) {
    const std::string place = "[" + std::to_string(k) + "]";
    requireModulus(faults, "mu_MPa" + place, law.mu_MPa[k]);
    if (const double size = std::abs(law.alpha[k]); !(size >= kLeastAlpha && size <= kLargestAlpha))
      faults.push_back({"material.alpha" + place, gotExpected(law.alpha[k], "", "0.01 to 50, or -50 to -0.01")});
  }
  if (faults.size() == before && !(shearModulus_MPa(law) > 0))
    faults.push_back({"material.mu_MPa", gotExpected("a sum of " + shortText(shearModulus_MPa(law)) + " MPa",
                                                     "a sum above 0, or the rubber has no stiffness")});
}

} // namespace

std::vector<DesignFault> check(const Material& material) {
  Faults faults;
  std::visit([&](const auto& law) { checkLaw(faults, law); }, material.law);
  if (!(material.poissonRatio >= 0 && material.poissonRatio <= 0.5))
    faults.push_back({"material.poisson_ratio", gotExpected(material.poissonRatio, "", "0 to 0.5")});
  if (const double density = material.density_t_per_mm3; !(density > 0 && density <= 1))
    faults.push_back({"material.density_t_per_mm3", gotExpected(density, " t/mm3", "above 0 up to 1 t/mm3")});
  return faults;
}

std::optional<std::string> stabilityWarning(const Material& material) {
  constexpr double least = 0.5, most = 2;
  std::string outside;
  for (const auto& [mode, name] : kTestModes.all()) {
    const StableRange range = stableRange(material.law, mode, least, most);
    if (range.least <= least && range.most >= most) continue;
    outside += (outside.empty() ? "" : ", ") + std::string(name) + " " + withDigits(range.least, 3) + " to " +
               withDigits(range.most, 3);
  }
  if (outside.empty()) return {};
  return "material: the law is not stable at all stretches from 0.5 to 2; stable ranges: " + outside +
         " (beyond them a solve may stop)";
}

} // namespace palp
