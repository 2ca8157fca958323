#pragma once

#include "solver/element/kernels/OgdenPoint.h"

namespace palp::PALP_KERNEL {

/// Trilinear hexahedron with one pressure; 8 points, each with the 8 shape gradients and the weight as geometry.
struct Hex : HexLayout {};

/// One number a lane (Stride 8) or one for all lanes (Stride 1).
template <int Stride> PALP_INLINE Pack geometryItem(const double* geometry, int item, int lane) {
  if constexpr (Stride == 1) {
    return all(geometry[item]);
  } else {
    return load(geometry + 8 * item + lane);
  }
}

struct HexPoint {
  Pack N[8][3], weight;
};

template <int Stride, class Point>
PALP_INLINE void hexPoint(const double* geometry, int q, int lane, const Pack u[8][3], Pack pressure, HexPoint& point,
                          Point& m) {
  for (int n = 0; n < 8; ++n)
    for (int d = 0; d < 3; ++d) point.N[n][d] = geometryItem<Stride>(geometry, Hex::pointSize * q + 3 * n + d, lane);
  point.weight = geometryItem<Stride>(geometry, Hex::pointSize * q + Hex::weight, lane);
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) {
      m.F[r][s] = all(r == s ? 1.0 : 0.0);
      for (int n = 0; n < 8; ++n) m.F[r][s] += u[n][r] * point.N[n][s];
    }
  evaluate(m, pressure);
}

struct HexSums {
  Pack forces[8][3] = {};
  Pack volume = {}, weight = {};
  Pack smallestJ, largestJ;
};

template <class Point> PALP_INLINE void addHexPoint(const Point& m, const HexPoint& point, HexSums& sums) {
  Pack P[3][3];
  weightedStress(m, point.weight, P);
  for (int n = 0; n < 8; ++n)
    for (int r = 0; r < 3; ++r)
      sums.forces[n][r] += P[r][0] * point.N[n][0] + P[r][1] * point.N[n][1] + P[r][2] * point.N[n][2];
  sums.volume += point.weight * (m.J - 1.0);
  sums.weight += point.weight;
  sums.smallestJ = smaller(sums.smallestJ, m.leastJ);
  sums.largestJ = larger(sums.largestJ, m.J);
}

/// Residual of the lanes and, where K is given, the uncondensed stiffness over 24 displacements and the pressure.
template <class Point, int Stride, bool WithStiffness>
PALP_INLINE void hexElement(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out, int lane,
                            Pack K[Hex::rows][Hex::rows]) {
  constexpr double one = 1; // the pressure's shape function
  Pack u[8][3];
  for (int n = 0; n < 8; ++n)
    for (int d = 0; d < 3; ++d) u[n][d] = load(in.displacements + 8 * (3 * n + d) + lane);
  const Pack pressure = load(in.unknowns + lane);
  HexSums sums;
  sums.smallestJ = load(out.volumeRange + lane);
  sums.largestJ = load(out.volumeRange + 8 + lane);
  Point m;
  m.law = decltype(m.law)(rubber);
#pragma GCC unroll 1
  for (int q = 0; q < Hex::points; ++q) {
    HexPoint point;
    hexPoint<Stride>(in.geometry, q, lane, u, pressure, point, m);
    addHexPoint(m, point, sums);
    if constexpr (WithStiffness) addStiffness<8, 1>(m, point.N, point.weight, &one, K);
  }
  if constexpr (WithStiffness)
    K[Hex::firstPressure][Hex::firstPressure] -= rubber.tangentCompressibility_per_MPa * sums.weight;
  for (int n = 0; n < 8; ++n)
    for (int d = 0; d < 3; ++d) store(out.forces + 8 * (3 * n + d) + lane, sums.forces[n][d]);
  store(out.local + lane, sums.volume - rubber.compressibility_per_MPa * sums.weight * pressure);
  store(out.volumeRange + lane, sums.smallestJ);
  store(out.volumeRange + 8 + lane, sums.largestJ);
}

} // namespace palp::PALP_KERNEL
