#include "nn/linear/VectorKernels.h"

#include <cstdint>
#include <cstring>

// Every function that takes or gives vectors is inlined into those below, so that no vector crosses a call.
#pragma GCC diagnostic ignored "-Wpsabi"

// Only x86-64 has these names; elsewhere, or with PALP_ONE_MACHINE, the compiler's own target serves. So it does under
// the thread sanitizer, which is not there yet when the clone is chosen, and with Clang, which makes no clones of
// functions that work on vectors wider than the narrowest clone's.
#if defined(__x86_64__) && !defined(PALP_ONE_MACHINE) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define PALP_MANY_MACHINES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define PALP_MANY_MACHINES
#endif
#define PALP_INLINE __attribute__((always_inline)) inline

namespace palp::kernels {
namespace {

using Lanes = double __attribute__((vector_size(64)));
using LanesUnaligned __attribute__((vector_size(64), aligned(8), may_alias)) =
    double; // there, or Clang aligns it by 64
using Integers = std::int64_t __attribute__((vector_size(64)));
constexpr std::size_t kWidth = 8;
static_assert(kBlockLanes == 2 * kWidth);

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

/// exp(-t) - 1 + t for 0 <= t < 1 by its series t^2/2 - t^3/6 + ..., where the sum would cancel; its
/// rest is below 2^-55.
PALP_INLINE Lanes smallRemainderOf(Lanes t) {
  constexpr double inverseFactorials[] = {-1.0 / 355687428096000.0,
                                          1.0 / 20922789888000.0,
                                          -1.0 / 1307674368000.0,
                                          1.0 / 87178291200.0,
                                          -1.0 / 6227020800.0,
                                          1.0 / 479001600.0,
                                          -1.0 / 39916800.0,
                                          1.0 / 3628800.0,
                                          -1.0 / 362880.0,
                                          1.0 / 40320.0,
                                          -1.0 / 5040.0,
                                          1.0 / 720.0,
                                          -1.0 / 120.0,
                                          1.0 / 24.0,
                                          -1.0 / 6.0,
                                          0.5};
  Lanes p = Lanes{} + 1.0 / 6402373705728000.0;
  for (const double c : inverseFactorials) p = p * t + c;
  return p * t * t;
}

PALP_INLINE double largest(Lanes v) {
  double result = v[0];
  for (std::size_t i = 1; i < kWidth; ++i) result = v[i] > result ? v[i] : result;
  return result;
}

PALP_INLINE double sum(Lanes v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

/// The basis at rate * r2, in place. Together, so that arguments that are all small cost the series alone.
template <std::size_t Count> PALP_INLINE void basisOf(Lanes* r2, double rate, bool remainder) {
  if (!remainder) {
    for (std::size_t i = 0; i < Count; ++i) r2[i] = exponentialOf(r2[i] * -rate);
    return;
  }
  Lanes most = r2[0];
  for (std::size_t i = 1; i < Count; ++i) most = r2[i] > most ? r2[i] : most;
  if (largest(most) * rate < 1) {
    for (std::size_t i = 0; i < Count; ++i) r2[i] = smallRemainderOf(r2[i] * rate);
    return;
  }
  for (std::size_t i = 0; i < Count; ++i) {
    const Lanes t = r2[i] * rate;
    r2[i] = t < 1.0 ? smallRemainderOf(t) : exponentialOf(-t) - 1.0 + t;
  }
}

PALP_INLINE void basisInPlace(double* values, std::size_t count, double rate, bool remainder) {
  constexpr std::size_t group = 8;
  Lanes lanes[group];
  std::size_t i = 0;
  for (; i + group * kWidth <= count; i += group * kWidth) {
    for (std::size_t k = 0; k < group; ++k) lanes[k] = load(values + i + k * kWidth);
    basisOf<group>(lanes, rate, remainder);
    for (std::size_t k = 0; k < group; ++k) store(values + i + k * kWidth, lanes[k]);
  }
  for (; i + kWidth <= count; i += kWidth) {
    lanes[0] = load(values + i);
    basisOf<1>(lanes, rate, remainder);
    store(values + i, lanes[0]);
  }
  if (i == count) return;
  double rest[kWidth] = {};
  std::memcpy(rest, values + i, (count - i) * sizeof(double));
  lanes[0] = load(rest);
  basisOf<1>(lanes, rate, remainder);
  store(rest, lanes[0]);
  std::memcpy(values + i, rest, (count - i) * sizeof(double));
}

/// The basis of `Samples` samples at `Blocks` blocks of centres: sums that do not wait for each other.
template <std::size_t Samples, std::size_t Blocks>
PALP_INLINE void fillBasis(const PackedNetwork& network, const double* scaled, std::size_t block, double* basis) {
  const double* center = network.centers + block * network.inputs * kBlockLanes;
  Lanes r2[Samples * Blocks * 2] = {};
  for (std::size_t d = 0; d < network.inputs; ++d)
    for (std::size_t b = 0; b < Blocks; ++b) {
      const double* at = center + (b * network.inputs + d) * kBlockLanes;
      const Lanes c0 = load(at), c1 = load(at + kWidth);
      for (std::size_t s = 0; s < Samples; ++s) {
        const double x = scaled[s * network.inputs + d];
        const Lanes d0 = c0 - x, d1 = c1 - x;
        r2[(s * Blocks + b) * 2] += d0 * d0;
        r2[(s * Blocks + b) * 2 + 1] += d1 * d1;
      }
    }
  basisOf<Samples * Blocks * 2>(r2, network.rate, network.remainder);
  for (std::size_t s = 0; s < Samples; ++s)
    for (std::size_t k = 0; k < 2 * Blocks; ++k)
      store(basis + s * network.blocks * kBlockLanes + block * kBlockLanes + k * kWidth, r2[s * 2 * Blocks + k]);
}

/// Blocks whose terms are summed before they are added to the total: large weights of both signs cancel, and short sums
/// lose less in rounding than a long one.
constexpr std::size_t kSummedBlocks = 4;

template <std::size_t Samples>
PALP_INLINE void addWeighted(const PackedNetwork& network, const double* basis, double* output) {
  const std::size_t centers = network.blocks * kBlockLanes;
  for (std::size_t o = 0; o < network.outputs; ++o) {
    const double* weight = network.weights + o * centers;
    Lanes total[Samples] = {}, lost[Samples] = {};
    for (std::size_t first = 0; first < centers; first += kSummedBlocks * kBlockLanes) {
      const std::size_t last =
          first + kSummedBlocks * kBlockLanes < centers ? first + kSummedBlocks * kBlockLanes : centers;
      Lanes even[Samples] = {}, odd[Samples] = {};
      for (std::size_t c = first; c < last; c += kBlockLanes) {
        const Lanes w0 = load(weight + c), w1 = load(weight + c + kWidth);
        for (std::size_t s = 0; s < Samples; ++s) {
          even[s] += w0 * load(basis + s * centers + c);
          odd[s] += w1 * load(basis + s * centers + c + kWidth);
        }
      }
      for (std::size_t s = 0; s < Samples; ++s) {
        const Lanes part = even[s] + odd[s], next = total[s] + part, added = next - total[s];
        lost[s] += (total[s] - (next - added)) + (part - added); // Knuth's two-sum
        total[s] = next;
      }
    }
    for (std::size_t s = 0; s < Samples; ++s) output[s * network.outputs + o] += sum(total[s]) + sum(lost[s]);
  }
}

// As wide as most machines have them: of wider ones products with a number go through memory (GCC 12).
using Four = double __attribute__((vector_size(32)));
using FourUnaligned __attribute__((vector_size(32), aligned(8), may_alias)) = double;

PALP_INLINE Four loadFour(const double* from) {
  return *reinterpret_cast<const FourUnaligned*>(from);
}
/// Single precision, made double.
PALP_INLINE Four loadFour(const float* from) {
  using FourFloats = float __attribute__((vector_size(16)));
  using FourFloatsUnaligned __attribute__((vector_size(16), aligned(4), may_alias)) = float;
  const FourFloats four = *reinterpret_cast<const FourFloatsUnaligned*>(from);
  return __builtin_convertvector(four, Four);
}
PALP_INLINE void storeFour(double* to, Four value) {
  *reinterpret_cast<FourUnaligned*>(to) = value;
}

/// Eight rows together, whose sums are independent of each other.
template <class Number>
PALP_INLINE void threeSumsOf(const Number* const* columns, std::size_t rows, const double* shares, double* results) {
  constexpr std::size_t count = kSplineColumns, sums = 3;
  std::size_t i = 0;
  for (; i + 8 <= rows; i += 8) {
    Four low[sums] = {}, high[sums] = {};
    for (std::size_t c = 0; c < count; ++c) {
      const Four c0 = loadFour(columns[c] + i), c1 = loadFour(columns[c] + i + 4);
      for (std::size_t o = 0; o < sums; ++o) {
        const double x = shares[o * count + c];
        const Four share = {x, x, x, x};
        low[o] += c0 * share;
        high[o] += c1 * share;
      }
    }
    for (std::size_t o = 0; o < sums; ++o) {
      storeFour(results + o * rows + i, low[o]);
      storeFour(results + o * rows + i + 4, high[o]);
    }
  }
  for (; i < rows; ++i)
    for (std::size_t o = 0; o < sums; ++o) {
      double total = 0;
      for (std::size_t c = 0; c < count; ++c) total += static_cast<double>(columns[c][i]) * shares[o * count + c];
      results[o * rows + i] = total;
    }
}

} // namespace

PALP_MANY_MACHINES void threeSums(const double* const* columns, std::size_t rows, const double* shares,
                                  double* results) {
  threeSumsOf(columns, rows, shares, results);
}

PALP_MANY_MACHINES void threeSums(const float* const* columns, std::size_t rows, const double* shares,
                                  double* results) {
  threeSumsOf(columns, rows, shares, results);
}

PALP_MANY_MACHINES void gaussian(double* squaredDistances, std::size_t count, double rate) {
  basisInPlace(squaredDistances, count, rate, false);
}

PALP_MANY_MACHINES void gaussianRemainder(double* squaredDistances, std::size_t count, double rate) {
  basisInPlace(squaredDistances, count, rate, true);
}

PALP_MANY_MACHINES void squaredDistancesToPoint(const double* rows, std::size_t stride, std::size_t count,
                                                std::size_t dimensions, const double* point, double* result) {
  std::size_t i = 0;
  for (; i + kWidth <= count; i += kWidth) {
    Lanes total = {};
    for (std::size_t d = 0; d < dimensions; ++d) {
      const Lanes difference = load(rows + d * stride + i) - point[d];
      total += difference * difference;
    }
    store(result + i, total);
  }
  for (; i < count; ++i) {
    double total = 0;
    for (std::size_t d = 0; d < dimensions; ++d) {
      const double difference = rows[d * stride + i] - point[d];
      total += difference * difference;
    }
    result[i] = total;
  }
}

PALP_MANY_MACHINES void addGaussians(const PackedNetwork& network, const double* scaled, double* basis,
                                     double* output) {
  std::size_t block = 0;
  for (; block + 4 <= network.blocks; block += 4) fillBasis<1, 4>(network, scaled, block, basis);
  for (; block < network.blocks; ++block) fillBasis<1, 1>(network, scaled, block, basis);
  addWeighted<1>(network, basis, output);
}

PALP_MANY_MACHINES void addGaussiansEight(const PackedNetwork& network, const double* scaled, double* basis,
                                          double* output) {
  for (std::size_t block = 0; block < network.blocks; ++block) fillBasis<8, 1>(network, scaled, block, basis);
  addWeighted<8>(network, basis, output);
}

} // namespace palp::kernels
