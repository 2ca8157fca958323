#pragma once

#include "solver/element/kernels/TetKernel.h"

namespace palp::PALP_KERNEL {

// The residual of a tetrahedron in single precision. All is written in the displacement's gradient H = F - I, where the
// terms of the stress that cancel at rest are left out: so it is exact to a few times 1e-7 of itself under the smallest
// load as well.

/// Floats per SIMD register, at most 8 lanes.
constexpr int singlePackSize = PALP_PACK < 4 ? 2 * PALP_PACK : 8;
typedef float Single __attribute__((vector_size(4 * singlePackSize)));
typedef double WideSingle __attribute__((vector_size(8 * singlePackSize)));

PALP_INLINE Single loadSingle(const double* p) {
  WideSingle v;
  __builtin_memcpy(&v, p, sizeof v);
  return __builtin_convertvector(v, Single);
}
/// The difference before it is rounded.
PALP_INLINE Single loadSingleFrom(const double* p, const double* origin) {
  WideSingle v, from;
  __builtin_memcpy(&v, p, sizeof v);
  __builtin_memcpy(&from, origin, sizeof from);
  return __builtin_convertvector(v - from, Single);
}
PALP_INLINE void storeSingle(double* p, Single v) {
  const WideSingle w = __builtin_convertvector(v, WideSingle);
  __builtin_memcpy(p, &w, sizeof w);
}

/// J^(-1/3) - 1 for J = 1 + d, by the series of inverseCubeRoot (Pack.h); to rounding for J in 0.25 .. 3.5, beyond it
/// relative errors of 2e-7 at 0.2, 3e-7 at 4, 1e-5 at 5.
PALP_INLINE Single inverseCubeRootLessOne(Single d) {
  Single x = -d / (3.0F + d);
  for (int i = 0; i < 2; ++i) {
    const Single cube = x * (3.0F + x * (3.0F + x)); // (1 + x)^3 - 1
    const Single h = -(d + cube + d * cube);
    x += (1.0F + x) * h * (1.0F / 3 + h * (2.0F / 9 + h * (14.0F / 81)));
  }
  return x;
}

/// First Piola-Kirchhoff stress, tension positive, with pressure p (Rubber.h): with K = cof F - I, b = F F^T - I,
/// t = tr b,
///   P = a1 (H - K - beta cof F) + a2 (t F - b F + 2 (H - K) - 2 delta cof F) + p cof F,   a1 = 2 w1 J^(-2/3),
///   a2 = 2 w2 J^(-4/3),   1 + beta = I1 / (3 J),   1 + delta = I2 / (3 J);
/// gives J - 1, and the smallest J as Rubber has it.
template <class Law>
PALP_INLINE Single stressInSingle(const Law& law, const Single H[3][3], Single p, Single P[3][3], Single& leastJ) {
  Single cof[3][3]; // of H
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) {
      const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, s1 = (s + 1) % 3, s2 = (s + 2) % 3;
      cof[r][s] = H[r1][s1] * H[r2][s2] - H[r1][s2] * H[r2][s1];
    }
  const Single trace = H[0][0] + H[1][1] + H[2][2];
  const Single growth =
      trace + (cof[0][0] + cof[1][1] + cof[2][2]) + H[0][0] * cof[0][0] + H[0][1] * cof[0][1] + H[0][2] * cof[0][2];
  Single b[3][3];
  for (int r = 0; r < 3; ++r)
    for (int s = r; s < 3; ++s)
      b[r][s] = b[s][r] = H[r][s] + H[s][r] + (H[r][0] * H[s][0] + H[r][1] * H[s][1] + H[r][2] * H[s][2]);
  const Single t = b[0][0] + b[1][1] + b[2][2];
  const Single x = inverseCubeRootLessOne(growth);
  const Single inverseJ = x * (3.0F + x * (3.0F + x)); // less one, as the next three
  const Single alpha = (1.0F / 3) * t, beta = alpha + inverseJ + alpha * inverseJ;
  const Single j1 = (1.0F + x) * (1.0F + x);
  const Single stretching = t * j1 + 3.0F * x * (2.0F + x); // I1bar - 3
  const auto a1 = (2.0F * law.slope(stretching)) * j1;
  leastJ = 1.0F + growth;
  if constexpr (Law::limited) leastJ = law.within(stretching) ? leastJ : Single{} + float(lockedVolume);
  Single shear = a1, a2{}, c;
  if constexpr (Law::hasI2) {
    const Single squares = b[0][0] * b[0][0] + b[1][1] * b[1][1] + b[2][2] * b[2][2] +
                           2.0F * (b[0][1] * b[0][1] + b[0][2] * b[0][2] + b[1][2] * b[1][2]);
    const Single gamma = (1.0F / 3) * (2.0F * t + 0.5F * (t * t - squares)),
                 delta = gamma + inverseJ + gamma * inverseJ;
    a2 = (2.0F * law.slope2()) * (j1 * j1);
    shear = a1 + 2.0F * a2;
    c = p - a1 * beta - 2.0F * (a2 * delta);
  } else {
    c = p - a1 * beta;
  }
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) {
      Single K = cof[r][s] - H[s][r], cofF = K, E{};
      if (r == s) {
        K += trace;
        cofF = K + 1.0F;
      }
      P[r][s] = shear * (H[r][s] - K);
      if constexpr (Law::hasI2) {
        E = t * H[r][s] - b[r][s];
        if (r == s) E += t;
        E -= b[r][0] * H[0][s] + b[r][1] * H[1][s] + b[r][2] * H[2][s];
        P[r][s] += a2 * E;
      }
      P[r][s] += c * cofF;
    }
  return growth;
}

/// An element's state: the gradient is linear without the bubble.
struct SingleState {
  Single vertexGradient[4][3][3], sum[3][3]; ///< of the displacement, and of all four
  Single bubble[3], pressure[4], pressures;
};

struct SingleGeometry {
  float g[4][3], volume;
};

PALP_INLINE void singleState(const SingleGeometry& geo, const double* u, const double* x, SingleState& state) {
  Single ue[10][3]; // from the first node
  for (int n = 0; n < 10; ++n)
    for (int d = 0; d < 3; ++d) ue[n][d] = loadSingleFrom(u + 8 * (3 * n + d), u + 8 * d);
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) state.sum[r][s] = Single{};
  for (int k = 0; k < 4; ++k) {
    Single coefficient[4][3];
    for (int i = 0; i < 4; ++i)
      for (int d = 0; d < 3; ++d) coefficient[i][d] = (i == k ? 3.0F : -1.0F) * ue[i][d];
    for (int e = 0; e < 6; ++e)
      for (int end = 0; end < 2; ++end)
        if (tetEdges[e][end] == k)
          for (int d = 0; d < 3; ++d) coefficient[tetEdges[e][1 - end]][d] += 4.0F * ue[4 + e][d];
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s < 3; ++s) {
        state.vertexGradient[k][r][s] = coefficient[0][r] * geo.g[0][s] + coefficient[1][r] * geo.g[1][s] +
                                        coefficient[2][r] * geo.g[2][s] + coefficient[3][r] * geo.g[3][s];
        state.sum[r][s] += state.vertexGradient[k][r][s];
      }
  }
  for (int d = 0; d < 3; ++d) state.bubble[d] = loadSingle(x + 8 * d);
  for (int k = 0; k < 4; ++k) state.pressure[k] = loadSingle(x + 8 * (3 + k));
  state.pressures = state.pressure[0] + state.pressure[1] + state.pressure[2] + state.pressure[3];
}

/// Sums over the points, of what belongs to all vertices alike and to each alone.
struct SingleSums {
  Single stress[5][3][3] = {}; ///< of w l_k P: what is k's alone, then what all have
  Single volume[5] = {};       ///< of w l_k (J - 1), in the same way
  Single bubble[3] = {};
  Single smallestJ, largestJ;
};

/// One point, of barycentric coordinates l_i = l_j = even + own, the others even: of one vertex where i = j. There
///   H = even sum_k H_k + own (H_i + H_j) + bubble (x) steep (g_i + g_j)
/// as the barycentric gradients g sum to nothing.
struct SinglePoint {
  float even, own, steep, weight;
};

template <bool Pair, class Law>
PALP_INLINE void addSinglePoint(const Law& law, const SingleGeometry& geo, const SingleState& state,
                                const SinglePoint& point, int i, int j, SingleSums& sums) {
  float g[3];
  for (int s = 0; s < 3; ++s) g[s] = point.steep * (Pair ? geo.g[i][s] + geo.g[j][s] : geo.g[i][s]);
  Single H[3][3], P[3][3];
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) {
      Single vertices = state.vertexGradient[i][r][s];
      if constexpr (Pair) vertices += state.vertexGradient[j][r][s];
      H[r][s] = point.even * state.sum[r][s] + point.own * vertices + state.bubble[r] * g[s];
    }
  Single pressure = state.pressure[i];
  if constexpr (Pair) pressure += state.pressure[j];
  Single least;
  const Single growth = stressInSingle(law, H, point.even * state.pressures + point.own * pressure, P, least);
  const float weight = point.weight * geo.volume;
  const auto add = [&](int k, float share) {
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s < 3; ++s) sums.stress[k][r][s] += share * P[r][s];
    sums.volume[k] += share * growth;
  };
  add(4, weight * point.even);
  add(i, weight * point.own);
  if constexpr (Pair) add(j, weight * point.own);
  for (int r = 0; r < 3; ++r) sums.bubble[r] += weight * (P[r][0] * g[0] + P[r][1] * g[1] + P[r][2] * g[2]);
  const Single J = 1.0F + growth;
  sums.smallestJ =
      ((sums.smallestJ < least) | (sums.smallestJ != sums.smallestJ)) ? sums.smallestJ : least; // as smaller
  sums.largestJ = ((sums.largestJ > J) | (sums.largestJ != sums.largestJ)) ? sums.largestJ : J;
}

/// The points of the rule by their orbits.
constexpr SinglePoint singlePoint(int point, int even, int own) {
  const double e = tetRule.l[point][even], o = tetRule.l[point][own];
  double others = 256; // of the bubble's gradient, but for e and o
  for (int k = 0; k < 4; ++k)
    if (k != even && k != own) others *= tetRule.l[point][k];
  return {float(e), float(o - e), float(others * (e - o)), float(tetRule.weight[point])};
}
constexpr SinglePoint singleOrbits[3] = {singlePoint(0, 1, 0), singlePoint(4, 1, 0), singlePoint(8, 2, 0)};

PALP_INLINE void storeSingleResidual(const SingleGeometry& geo, const SingleState& state, SingleSums& sums,
                                     float compressibility, const ElementResidual& out) {
  for (int k = 0; k < 4; ++k) {
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s < 3; ++s) sums.stress[k][r][s] += sums.stress[4][r][s];
    sums.volume[k] += sums.volume[4];
  }
  for (int i = 0; i < 4; ++i)
    for (int r = 0; r < 3; ++r) {
      Single f{};
      for (int s = 0; s < 3; ++s) {
        const Single total = sums.stress[0][r][s] + sums.stress[1][r][s] + sums.stress[2][r][s] + sums.stress[3][r][s];
        f += (4.0F * sums.stress[i][r][s] - total) * geo.g[i][s];
      }
      storeSingle(out.forces + 8 * (3 * i + r), f);
    }
  for (int e = 0; e < 6; ++e)
    for (int r = 0; r < 3; ++r) {
      const int i = tetEdges[e][0], j = tetEdges[e][1];
      Single f{};
      for (int s = 0; s < 3; ++s) f += sums.stress[i][r][s] * geo.g[j][s] + sums.stress[j][r][s] * geo.g[i][s];
      storeSingle(out.forces + 8 * (3 * (4 + e) + r), 4.0F * f);
    }
  for (int r = 0; r < 3; ++r) storeSingle(out.local + 8 * r, sums.bubble[r]);
  for (int k = 0; k < 4; ++k)
    storeSingle(out.local + 8 * (3 + k),
                sums.volume[k] - (compressibility / 20 * geo.volume) * (state.pressure[k] + state.pressures));
  storeSingle(out.volumeRange, sums.smallestJ);
  storeSingle(out.volumeRange + 8, sums.largestJ);
}

/// One element, lanes of loads from `lane` on.
template <class Law>
PALP_INLINE void tetResidualInSingle(const RubberConstants& rubber, const SingleGeometry& geo, const ElementInput& in,
                                     const ElementResidual& out, int lane) {
  const Law law(rubber);
  SingleState state;
  singleState(geo, in.displacements + lane, in.unknowns + lane, state);
  const ElementResidual at{out.forces + lane, out.local + lane, out.volumeRange + lane};
  SingleSums sums;
  sums.smallestJ = loadSingle(at.volumeRange);
  sums.largestJ = loadSingle(at.volumeRange + 8);
#pragma GCC unroll 1
  for (int orbit = 0; orbit < 2; ++orbit)
#pragma GCC unroll 1
    for (int k = 0; k < 4; ++k) addSinglePoint<false>(law, geo, state, singleOrbits[orbit], k, k, sums);
#pragma GCC unroll 1
  for (int e = 0; e < 6; ++e)
    addSinglePoint<true>(law, geo, state, singleOrbits[2], tetEdges[e][0], tetEdges[e][1], sums);
  storeSingleResidual(geo, state, sums, float(rubber.compressibility_per_MPa), at);
}

} // namespace palp::PALP_KERNEL
