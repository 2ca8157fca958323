#pragma once

#include "solver/element/LaneKernels.h"
#include "solver/element/kernels/LaneSolve.h"

namespace palp::PALP_KERNEL {

// Anderson's mixing of 8 lanes (batch/AndersonBatch.h has the formulas). Of each number the past is kept in single
// precision, [what][8].

typedef int NarrowMask __attribute__((vector_size(4 * PALP_PACK)));
typedef long long WideMask __attribute__((vector_size(8 * PALP_PACK)));

PALP_INLINE void storeNarrow(float* p, NarrowPack v) {
  __builtin_memcpy(p, &v, sizeof v);
}
PALP_INLINE NarrowMask loadMask(const int* p) {
  NarrowMask v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
PALP_INLINE NarrowPack narrow(Pack v) {
  return __builtin_convertvector(v, NarrowPack);
}

/// Inserts `newest` before the stored values [mixingDepth][8] where the mask is set.
PALP_INLINE void keep(NarrowMask where, NarrowPack newest, float* kept, NarrowPack now[mixingDepth]) {
  for (int j = 0; j < mixingDepth; ++j) now[j] = loadNarrow(kept + 8 * j);
  for (int j = mixingDepth - 1; j > 0; --j) now[j] = where ? now[j - 1] : now[j];
  now[0] = where ? newest : now[0];
  for (int j = 0; j < mixingDepth; ++j) storeNarrow(kept + 8 * j, now[j]);
}

PALP_INLINE void sumMixed(const MixedRows& rows, const LaneMix& mix, double* sums) {
  for (int lane = 0; lane < 8; lane += packSize) {
    const NarrowMask pair = loadMask(mix.pair + lane);
    Pack sum[mixSums];
    for (int s = 0; s < mixSums; ++s) sum[s] = load(sums + 8 * s + lane);
    float* past = rows.past + lane;
    for (int i = 0; i < rows.count; ++i, past += rows.pastStride) {
      const Pack d = scaled(rows.directions, rows.rows[i], mix.scale, lane);
      const NarrowPack r = narrow(d), change = r - loadNarrow(past), motion = loadNarrow(past + 8) + change;
      NarrowPack motions[mixingDepth], changes[mixingDepth];
      keep(pair, motion, past + 16, motions);
      keep(pair, change, past + 16 + 8 * mixingDepth, changes);
      storeNarrow(past, r);
      int s = 0;
      for (int j = 0; j < mixingDepth; ++j) {
        const Pack a = wide(changes[j]);
        for (int k = 0; k <= j; ++k) sum[s++] += a * wide(changes[k]);
        sum[s++] += a * d;
      }
    }
    for (int s = 0; s < mixSums; ++s) store(sums + 8 * s + lane, sum[s]);
  }
}

/// The mixing term, subtracted from a direction.
PALP_INLINE Pack mixedPart(const LaneMix& mix, const NarrowPack motions[mixingDepth], int lane) {
  Pack part{};
  for (int j = 0; j < mixingDepth; ++j) {
    const NarrowPack motion = loadMask(mix.hasMotion[j] + lane) ? motions[j] : NarrowPack{};
    part += load(mix.gamma[j] + lane) * wide(motion);
  }
  return part;
}

PALP_INLINE void stepMixed(const MixedRows& rows, const LaneMix& mix, double* u) {
  for (int lane = 0; lane < 8; lane += packSize) {
    float* past = rows.past + lane;
    for (int i = 0; i < rows.count; ++i, past += rows.pastStride) {
      NarrowPack motions[mixingDepth];
      for (int j = 0; j < mixingDepth; ++j) motions[j] = loadNarrow(past + 16 + 8 * j);
      const Pack step = scaled(rows.directions, rows.rows[i], mix.scale, lane) - mixedPart(mix, motions, lane);
      storeNarrow(past + 8, narrow(step));
      double* value = u + std::size_t(i) * batchColumns + lane;
      store(value, load(value) + step);
    }
  }
}

PALP_INLINE void followMixed(const double* directions, int count, const LaneMix& mix, float* past, double* values) {
  for (int lane = 0; lane < 8; lane += packSize) {
    const NarrowMask pair = loadMask(mix.pair + lane), moves = loadMask(mix.moves + lane);
    for (int i = 0; i < count; ++i) {
      float* at = past + i * followingPast * 8 + lane;
      const NarrowPack direction = narrow(load(directions + 8 * i + lane));
      NarrowPack motions[mixingDepth];
      keep(pair, loadNarrow(at + 8) + (direction - loadNarrow(at)), at + 16, motions);
      const Pack step = load(directions + 8 * i + lane) - mixedPart(mix, motions, lane);
      storeNarrow(at, moves ? direction : loadNarrow(at));
      storeNarrow(at + 8, moves ? narrow(step) : loadNarrow(at + 8));
      const Pack value = load(values + 8 * i + lane);
      store(values + 8 * i + lane, __builtin_convertvector(moves, WideMask) ? value + step : value);
    }
  }
}

/// Initial guess of lanes that start a load increment.
PALP_INLINE void beginLoads(double* values, float* before, int rows, std::ptrdiff_t stride, const InitialGuess& guess) {
  for (int lane = 0; lane < 8; lane += packSize) {
    const NarrowMask from = loadMask(guess.begins + lane), on = loadMask(guess.ahead + lane);
    const WideMask rest = __builtin_convertvector(loadMask(guess.atRest + lane), WideMask);
    for (int i = 0; i < rows; ++i) {
      double* value = values + i * stride + lane;
      float* past = before + i * stride + lane;
      const NarrowPack last = loadNarrow(past);
      const Pack now = rest ? Pack{} : load(value);
      storeNarrow(past, from ? narrow(now) : last);
      store(value, __builtin_convertvector(on, WideMask) ? now + (now - wide(last)) : now);
    }
  }
}

} // namespace palp::PALP_KERNEL
