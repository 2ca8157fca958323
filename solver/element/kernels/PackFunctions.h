#pragma once

#include "solver/element/kernels/Pack.h"

namespace palp::PALP_KERNEL {

// Functions of a register of doubles, lane by lane the same at every width.

typedef long long PackBits __attribute__((vector_size(8 * PALP_PACK)));

PALP_INLINE Pack squareRoot(Pack x) {
  Pack root;
  for (int lane = 0; lane < packSize; ++lane) root[lane] = __builtin_sqrt(x[lane]);
  return root;
}

/// A double whose last bits are a whole number k of some 50 bits: wholeAt0 + k.
constexpr double wholeAt0 = 6755399441055744.0;                                             // 1.5 * 2^52
constexpr double ln2High = 6.93147180369123816490e-01, ln2Low = 1.90821492927058770002e-10; // their sum is ln 2

/// e^x, to 2 units in the last place; for |x| above 700 that of 700.
PALP_INLINE Pack exponential(Pack x) {
  x = x < -700.0 ? all(-700.0) : x;
  x = x > 700.0 ? all(700.0) : x;
  const Pack shifted = x * 1.44269504088896340736 + wholeAt0, k = shifted - wholeAt0;
  const Pack r = (x - k * ln2High) - k * ln2Low; // |r| <= ln 2 / 2
  Pack series = all(1.0 / 6227020800.0);
  constexpr double inverse[13] = {1.0 / 479001600.0,
                                  1.0 / 39916800.0,
                                  1.0 / 3628800.0,
                                  1.0 / 362880.0,
                                  1.0 / 40320.0,
                                  1.0 / 5040.0,
                                  1.0 / 720.0,
                                  1.0 / 120.0,
                                  1.0 / 24.0,
                                  1.0 / 6.0,
                                  0.5,
                                  1.0,
                                  1.0};
  for (const double coefficient : inverse) series = series * r + coefficient;
  return (Pack)((PackBits)series + ((PackBits)shifted << 52)); // times 2^k
}

/// ln x for x > 0, to 1e-16 and 2 units in the last place.
PALP_INLINE Pack logarithm(Pack x) {
  constexpr long long rootOfHalf = 0x3fe6a09e667f3bcd;
  const PackBits bits = (PackBits)x, k = (bits - rootOfHalf) >> 52;
  const Pack m = (Pack)(bits - (k << 52)); // x = m 2^k, 0.707 <= m < 1.415
  const Pack exponent = (Pack)(k + (PackBits)all(wholeAt0)) - wholeAt0;
  const Pack z = (m - 1.0) / (m + 1.0), z2 = z * z; // ln m = 2 artanh z
  Pack series = all(1.0 / 23.0);
  for (int n = 21; n >= 3; n -= 2) series = series * z2 + 1.0 / n;
  return exponent * ln2High + (2.0 * z + (2.0 * z * z2 * series + exponent * ln2Low));
}

} // namespace palp::PALP_KERNEL
