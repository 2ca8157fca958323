#pragma once

#include "solver/element/kernels/RubberLaws.h"

namespace palp::PALP_KERNEL {

/// Rubber at one point by a law of the isochoric invariants (RubberLaws.h), pressure p (tension positive) independent,
/// w1 = dW/dI1bar, w2 = dW/dI2bar:
/// P = a F + b E + c cof F, a = 2 w1 J^(-2/3), b = 2 w2 J^(-4/3), E = I1 F - F C,
/// c = p - g/J, g = (2/3) w1 J^(-2/3) I1 + (4/3) w2 J^(-4/3) I2.
template <class Law> struct Rubber {
  Pack F[3][3], cof[3][3], E[3][3], B[3][3];
  Pack J, I1, I2, j1, j2, inverseJ, a, b, c, g;
  Law law;
  decltype(Law().slope(Pack{})) w1;
  Pack curvature; ///< d2W/dI1bar2
  Pack leastJ;    ///< J, or lockedVolume where the law does not allow the stretch
};

PALP_INLINE void cofactor(const Pack F[3][3], Pack cof[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) {
      const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, s1 = (s + 1) % 3, s2 = (s + 2) % 3;
      cof[r][s] = F[r1][s1] * F[r2][s2] - F[r1][s2] * F[r2][s1];
    }
}

/// J and B = F F^T, given F and cof F.
template <class Point> PALP_INLINE void volumeAndLeftCauchyGreen(Point& m) {
  m.J = m.F[0][0] * m.cof[0][0] + m.F[0][1] * m.cof[0][1] + m.F[0][2] * m.cof[0][2];
  for (int r = 0; r < 3; ++r)
    for (int s = r; s < 3; ++s) {
      m.B[r][s] = m.F[r][0] * m.F[s][0] + m.F[r][1] * m.F[s][1] + m.F[r][2] * m.F[s][2];
      m.B[s][r] = m.B[r][s];
    }
}

/// Fills everything but F and the law, which are given.
template <class Law> PALP_INLINE void evaluate(Rubber<Law>& m, Pack p) {
  cofactor(m.F, m.cof);
  volumeAndLeftCauchyGreen(m);
  m.I1 = m.B[0][0] + m.B[1][1] + m.B[2][2];
  if constexpr (Law::hasI2) {
    const Pack squares = m.B[0][0] * m.B[0][0] + m.B[1][1] * m.B[1][1] + m.B[2][2] * m.B[2][2] +
                         2.0 * (m.B[0][1] * m.B[0][1] + m.B[0][2] * m.B[0][2] + m.B[1][2] * m.B[1][2]);
    m.I2 = 0.5 * (m.I1 * m.I1 - squares);
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s < 3; ++s)
        m.E[r][s] = m.I1 * m.F[r][s] - (m.B[r][0] * m.F[0][s] + m.B[r][1] * m.F[1][s] + m.B[r][2] * m.F[2][s]);
  }
  const Pack x = inverseCubeRoot(m.J);
  m.j1 = x * x;
  m.j2 = m.j1 * m.j1;
  m.inverseJ = m.j1 * x;
  const Pack s = m.j1 * m.I1 - 3.0;
  m.w1 = m.law.slope(s);
  if constexpr (Law::curved) m.curvature = m.law.curvature(s);
  m.a = (2.0 * m.w1) * m.j1;
  if constexpr (Law::hasI2) {
    m.b = (2.0 * m.law.slope2()) * m.j2;
    m.g = (2.0 / 3.0 * m.w1) * m.j1 * m.I1 + (4.0 / 3.0 * m.law.slope2()) * m.j2 * m.I2;
  } else {
    m.g = (2.0 / 3.0 * m.w1) * m.j1 * m.I1;
  }
  m.c = p - m.g * m.inverseJ;
  m.leastJ = m.J;
  if constexpr (Law::limited) m.leastJ = m.law.within(s) ? m.J : all(lockedVolume);
}

/// First Piola-Kirchhoff stress times the weight of the point.
template <class Law> PALP_INLINE void weightedStress(const Rubber<Law>& m, Pack weight, Pack P[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s)
      if constexpr (Law::hasI2)
        P[r][s] = weight * (m.a * m.F[r][s] + m.b * m.E[r][s] + m.c * m.cof[r][s]);
      else
        P[r][s] = weight * (m.a * m.F[r][s] + m.c * m.cof[r][s]);
}

PALP_INLINE constexpr int permutationSign(int i, int j, int k) {
  return (i - j) * (j - k) * (k - i) / 2;
}

PALP_INLINE void rightCauchyGreen(const Pack F[3][3], Pack C[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) C[r][s] = F[0][r] * F[0][s] + F[1][r] * F[1][s] + F[2][r] * F[2][s];
}

/// Adds (d2W/dI1bar2) D (x) D to the tangent, D = dI1bar/dF = 2 J^(-2/3) (F - (I1 / (3 J)) cof F).
template <class Law> PALP_INLINE void addCurvature(const Rubber<Law>& m, Pack weight, Pack A[9][9]) {
  Pack D[9];
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) D[3 * r + s] = 2.0 * m.j1 * (m.F[r][s] - (1.0 / 3.0) * m.I1 * m.inverseJ * m.cof[r][s]);
  for (int column = 0; column < 9; ++column) {
    const Pack share = weight * m.curvature * D[column];
    for (int row = 0; row <= column; ++row) {
      A[row][column] += D[row] * share;
      A[column][row] = A[row][column];
    }
  }
}

/// dP/dF times the weight: A[3 r + s][3 i + j] = dP_rs / dF_ij, symmetric. C = F^T F is given: where it is computed
/// decides which products g++ fuses with sums, and so the last bits.
template <class Law>
PALP_INLINE void weightedTangent(const Rubber<Law>& m, const Pack C[3][3], Pack weight, Pack A[9][9]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Pack dJ = m.cof[i][j];
      const Pack dI1 = 2.0 * m.F[i][j], dI2 = 2.0 * m.E[i][j];
      const Pack dj1 = (-2.0 / 3.0) * m.j1 * m.inverseJ * dJ, dj2 = (-4.0 / 3.0) * m.j2 * m.inverseJ * dJ;
      const Pack da = (2.0 * m.w1) * dj1;
      Pack db{}, dg;
      if constexpr (Law::hasI2) {
        db = (2.0 * m.law.slope2()) * dj2;
        dg = (2.0 / 3.0 * m.w1) * (dj1 * m.I1 + m.j1 * dI1) + (4.0 / 3.0 * m.law.slope2()) * (dj2 * m.I2 + m.j2 * dI2);
      } else {
        dg = (2.0 / 3.0 * m.w1) * (dj1 * m.I1 + m.j1 * dI1);
      }
      const Pack dc = (m.g * dJ * m.inverseJ - dg) * m.inverseJ;
      const int column = 3 * i + j;
      for (int r = 0; r < 3; ++r)
        for (int s = 0; s < 3; ++s) {
          const int row = 3 * r + s;
          if (row > column) continue;
          Pack dP;
          if constexpr (Law::hasI2) {
            Pack dE = dI1 * m.F[r][s] - m.F[r][j] * m.F[i][s];
            if (s == j) dE -= m.B[r][i];
            if (r == i) dE -= C[j][s];
            if (r == i && s == j) dE += m.I1;
            dP = da * m.F[r][s] + db * m.E[r][s] + m.b * dE + dc * m.cof[r][s];
          } else {
            dP = da * m.F[r][s] + dc * m.cof[r][s];
          }
          if (r == i && s == j) dP += m.a;
          if (r != i && s != j) {
            const int k = 3 - i - r, l = 3 - j - s;
            dP += double(permutationSign(r, k, i) * permutationSign(s, l, j)) * m.c * m.F[k][l];
          }
          A[row][column] = weight * dP;
          A[column][row] = A[row][column];
        }
    }
  if constexpr (Law::curved) addCurvature(m, weight, A);
}

/// A point's part of the stiffness over the nodes' displacements, then the pressures: K[i][j], i <= j. N holds the
/// gradients of the nodes' shape functions, l the values of the pressures'.
template <int Nodes, int Pressures, class Point>
PALP_INLINE void addStiffness(const Point& m, const Pack N[Nodes][3], Pack weight, const double l[Pressures],
                              Pack K[3 * Nodes + Pressures][3 * Nodes + Pressures]) {
  Pack C[3][3], A[9][9];
  rightCauchyGreen(m.F, C);
  weightedTangent(m, C, weight, A);
#pragma GCC unroll 1
  for (int j = 0; j < Nodes; ++j) {
    Pack AN[9][3];
    for (int R = 0; R < 9; ++R)
      for (int d = 0; d < 3; ++d)
        AN[R][d] = A[R][3 * d] * N[j][0] + A[R][3 * d + 1] * N[j][1] + A[R][3 * d + 2] * N[j][2];
#pragma GCC unroll 1
    for (int i = 0; i <= j; ++i)
      for (int r = 0; r < 3; ++r)
        for (int d = 0; d < 3; ++d)
          K[3 * i + r][3 * j + d] += N[i][0] * AN[3 * r][d] + N[i][1] * AN[3 * r + 1][d] + N[i][2] * AN[3 * r + 2][d];
    for (int d = 0; d < 3; ++d) {
      const Pack b = weight * (m.cof[d][0] * N[j][0] + m.cof[d][1] * N[j][1] + m.cof[d][2] * N[j][2]);
      for (int k = 0; k < Pressures; ++k) K[3 * j + d][3 * Nodes + k] += l[k] * b;
    }
  }
}

} // namespace palp::PALP_KERNEL
