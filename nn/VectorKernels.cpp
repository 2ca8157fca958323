#include "nn/VectorKernels.h"

#include <cstdint>
#include <cstring>

// Every function that takes or gives vectors is inlined into those below, so that no vector crosses a call.
#pragma GCC diagnostic ignored "-Wpsabi"

#define PALP_MANY_MACHINES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define PALP_INLINE __attribute__((always_inline)) inline

namespace palp::kernels {
namespace {

using Lanes = double __attribute__((vector_size(64)));
using LanesUnaligned = double __attribute__((vector_size(64), aligned(8), may_alias));
using Integers = std::int64_t __attribute__((vector_size(64)));
constexpr std::size_t width = 8;
static_assert(blockLanes == 2 * width);

PALP_INLINE Lanes load(const double* from) {
  return *reinterpret_cast<const LanesUnaligned*>(from);
}
PALP_INLINE void store(double* to, Lanes value) {
  *reinterpret_cast<LanesUnaligned*>(to) = value;
}

/// exp(x), Cody and Waite's reduction to |r| <= ln2 / 2 and a polynomial of degree 13 (Taylor; its rest is below
/// 2^-57), error about 1 ulp; x < -708 gives 0, x > 708 is held there.
PALP_INLINE Lanes exponentialOf(Lanes x) {
  constexpr double log2e = 1.4426950408889634074, ln2High = 6.93147180369123816490e-01,
                   ln2Low = 1.90821492927058770002e-10, roundBit = 6755399441055744.0; // 1.5 * 2^52
  const Integers underflow = x < -708.0;
  x = x < -708.0 ? Lanes{} - 708.0 : x;
  x = x > 708.0 ? Lanes{} + 708.0 : x;
  const Lanes shifted = x * log2e + roundBit;
  const Lanes n = shifted - roundBit;
  const Lanes r = (x - n * ln2High) - n * ln2Low;
  constexpr double inverseFactorials[] = {1.0 / 479001600.0,
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
  Lanes p = Lanes{} + 1.0 / 6227020800.0;
  for (const double c : inverseFactorials) p = p * r + c;
  // The low bits of `shifted` are n itself; moved into the exponent they are 2^n.
  Integers bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits + 1023) << 52;
  Lanes power;
  std::memcpy(&power, &bits, sizeof power);
  const Lanes result = p * power;
  return underflow ? Lanes{} : result;
}

/// exp(-t) - 1 + t for t >= 0: by its series t^2/2 - t^3/6 + ... below 1, where the sum would cancel.
PALP_INLINE Lanes remainderOf(Lanes t) {
  const Lanes plain = exponentialOf(-t) - 1.0 + t;
  Lanes series = Lanes{} + 1.0;
  for (int k = 19; k >= 3; --k) series = 1.0 - series * t * (1.0 / k);
  return t < 1.0 ? 0.5 * t * t * series : plain;
}

PALP_INLINE double sum(Lanes v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

/// `Samples` samples against one block of 16 centres.
template <std::size_t Samples, bool Remainder>
PALP_INLINE void addBasisOf(const PackedNetwork& network, const double* scaled, double* output) {
  const double* center = network.centers;
  const double* weight = network.weights;
  for (std::size_t b = 0; b < network.blocks; ++b) {
    Lanes low[Samples] = {}, high[Samples] = {};
    for (std::size_t d = 0; d < network.inputs; ++d, center += blockLanes) {
      const Lanes c0 = load(center), c1 = load(center + width);
      for (std::size_t s = 0; s < Samples; ++s) {
        const double x = scaled[s * network.inputs + d];
        const Lanes d0 = c0 - x, d1 = c1 - x;
        low[s] += d0 * d0;
        high[s] += d1 * d1;
      }
    }
    for (std::size_t s = 0; s < Samples; ++s) {
      low[s] = Remainder ? remainderOf(low[s] * network.rate) : exponentialOf(low[s] * -network.rate);
      high[s] = Remainder ? remainderOf(high[s] * network.rate) : exponentialOf(high[s] * -network.rate);
    }
    for (std::size_t o = 0; o < network.outputs; ++o, weight += blockLanes) {
      const Lanes w0 = load(weight), w1 = load(weight + width);
      for (std::size_t s = 0; s < Samples; ++s) output[s * network.outputs + o] += sum(w0 * low[s] + w1 * high[s]);
    }
  }
}

} // namespace

PALP_MANY_MACHINES void exponential(double* values, std::size_t count, double factor) {
  std::size_t i = 0;
  for (; i + width <= count; i += width) store(values + i, exponentialOf(load(values + i) * factor));
  if (i == count) return;
  double rest[width] = {};
  std::memcpy(rest, values + i, (count - i) * sizeof(double));
  store(rest, exponentialOf(load(rest) * factor));
  std::memcpy(values + i, rest, (count - i) * sizeof(double));
}

PALP_MANY_MACHINES void exponentialRemainder(double* values, std::size_t count, double factor) {
  std::size_t i = 0;
  for (; i + width <= count; i += width) store(values + i, remainderOf(load(values + i) * factor));
  if (i == count) return;
  double rest[width] = {};
  std::memcpy(rest, values + i, (count - i) * sizeof(double));
  store(rest, remainderOf(load(rest) * factor));
  std::memcpy(values + i, rest, (count - i) * sizeof(double));
}

PALP_MANY_MACHINES void squaredDistancesToPoint(const double* rows, std::size_t count, std::size_t dimensions,
                                                const double* point, double* result) {
  std::size_t i = 0;
  for (; i + width <= count; i += width) {
    Lanes total = {};
    for (std::size_t d = 0; d < dimensions; ++d) {
      const Lanes difference = load(rows + d * count + i) - point[d];
      total += difference * difference;
    }
    store(result + i, total);
  }
  for (; i < count; ++i) {
    double total = 0;
    for (std::size_t d = 0; d < dimensions; ++d) {
      const double difference = rows[d * count + i] - point[d];
      total += difference * difference;
    }
    result[i] = total;
  }
}

PALP_MANY_MACHINES void addGaussians(const PackedNetwork& network, const double* scaled, double* output) {
  if (network.remainder)
    addBasisOf<1, true>(network, scaled, output);
  else
    addBasisOf<1, false>(network, scaled, output);
}

PALP_MANY_MACHINES void addGaussiansFour(const PackedNetwork& network, const double* scaled, double* output) {
  if (network.remainder)
    addBasisOf<4, true>(network, scaled, output);
  else
    addBasisOf<4, false>(network, scaled, output);
}

} // namespace palp::kernels
