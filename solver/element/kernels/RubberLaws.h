#pragma once

#include "solver/element/ElementKernels.h"
#include "solver/element/kernels/Pack.h"

namespace palp::PALP_KERNEL {

// Laws of rubber by the isochoric invariants, W(I1bar, I2bar) [MPa], each once for all kernels: Real is double or
// float, a vector of lanes either Pack or Single. A law gives the derivatives of W by s = I1bar - 3 and by I2bar:
//   slope(s) = dW/dI1bar, curvature(s) = d2W/dI1bar2 where `curved`, slope2() = dW/dI2bar (a constant) where `hasI2`,
//   within(s): whether the rubber can be stretched so far, where `limited`.
// Ogden's law has principal stretches instead: OgdenPoint.h.

/// Mooney and Rivlin: W = c10 s + c01 (I2bar - 3); neo-Hooke's law with c01 = 0.
template <class Real> struct MooneyRivlinLaw {
  static constexpr bool hasI2 = true, curved = false, limited = false;
  Real c10{}, c01{};
  PALP_INLINE_MEMBER MooneyRivlinLaw() = default;
  PALP_INLINE_MEMBER explicit MooneyRivlinLaw(const RubberConstants& r)
      : c10(Real(r.constants[0])), c01(Real(r.constants[1])) {}
  template <class Lanes> PALP_INLINE_MEMBER Real slope(Lanes /*s*/) const { return c10; }
  PALP_INLINE_MEMBER Real slope2() const { return c01; }
};

/// Yeoh: W = c10 s + c20 s^2 + c30 s^3.
template <class Real> struct YeohLaw {
  static constexpr bool hasI2 = false, curved = true, limited = false;
  Real c10{}, c20{}, c30{};
  PALP_INLINE_MEMBER YeohLaw() = default;
  PALP_INLINE_MEMBER explicit YeohLaw(const RubberConstants& r)
      : c10(Real(r.constants[0])), c20(Real(r.constants[1])), c30(Real(r.constants[2])) {}
  template <class Lanes> PALP_INLINE_MEMBER Lanes slope(Lanes s) const { return c10 + s * (2 * c20 + 3 * c30 * s); }
  template <class Lanes> PALP_INLINE_MEMBER Lanes curvature(Lanes s) const { return 2 * c20 + 6 * c30 * s; }
};

/// Gent: W = -(mu jm / 2) ln(1 - s / jm), which locks as s approaches jm.
template <class Real> struct GentLaw {
  static constexpr bool hasI2 = false, curved = true, limited = true;
  Real mu{}, jm{};
  PALP_INLINE_MEMBER GentLaw() = default;
  PALP_INLINE_MEMBER explicit GentLaw(const RubberConstants& r) : mu(Real(r.constants[0])), jm(Real(r.constants[1])) {}
  template <class Lanes> PALP_INLINE_MEMBER Lanes slope(Lanes s) const { return mu / 2 * jm / (jm - s); }
  template <class Lanes> PALP_INLINE_MEMBER Lanes curvature(Lanes s) const {
    return mu / 2 * jm / ((jm - s) * (jm - s));
  }
  template <class Lanes> PALP_INLINE_MEMBER auto within(Lanes s) const { return s < jm; }
};

} // namespace palp::PALP_KERNEL
