#pragma once

#include "solver/element/ElementKernels.h"
#include "solver/element/kernels/Pack.h"

namespace palp::PALP_KERNEL {

/// Mooney-Rivlin rubber at one point, pressure p (tension positive) independent:
/// P = a F + b E + c cof F, a = 2 c10 J^(-2/3), b = 2 c01 J^(-4/3), E = I1 F - F C,
/// c = p - g/J, g = (2/3) c10 J^(-2/3) I1 + (4/3) c01 J^(-4/3) I2.
struct Rubber {
  Pack F[3][3], cof[3][3], E[3][3], B[3][3];
  Pack J, I1, I2, j1, j2, inverseJ, a, b, c, g;
  double c10, c01;
};

PALP_INLINE void cofactor(const Pack F[3][3], Pack cof[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) {
      const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, s1 = (s + 1) % 3, s2 = (s + 2) % 3;
      cof[r][s] = F[r1][s1] * F[r2][s2] - F[r1][s2] * F[r2][s1];
    }
}

/// Fills everything but F and the constants, which are given.
PALP_INLINE void evaluate(Rubber& m, Pack p) {
  cofactor(m.F, m.cof);
  m.J = m.F[0][0] * m.cof[0][0] + m.F[0][1] * m.cof[0][1] + m.F[0][2] * m.cof[0][2];
  for (int r = 0; r < 3; ++r)
    for (int s = r; s < 3; ++s) {
      m.B[r][s] = m.F[r][0] * m.F[s][0] + m.F[r][1] * m.F[s][1] + m.F[r][2] * m.F[s][2];
      m.B[s][r] = m.B[r][s];
    }
  m.I1 = m.B[0][0] + m.B[1][1] + m.B[2][2];
  const Pack squares = m.B[0][0] * m.B[0][0] + m.B[1][1] * m.B[1][1] + m.B[2][2] * m.B[2][2] +
                       2.0 * (m.B[0][1] * m.B[0][1] + m.B[0][2] * m.B[0][2] + m.B[1][2] * m.B[1][2]);
  m.I2 = 0.5 * (m.I1 * m.I1 - squares);
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s)
      m.E[r][s] = m.I1 * m.F[r][s] - (m.B[r][0] * m.F[0][s] + m.B[r][1] * m.F[1][s] + m.B[r][2] * m.F[2][s]);
  const Pack x = inverseCubeRoot(m.J);
  m.j1 = x * x;
  m.j2 = m.j1 * m.j1;
  m.inverseJ = m.j1 * x;
  m.a = (2.0 * m.c10) * m.j1;
  m.b = (2.0 * m.c01) * m.j2;
  m.g = (2.0 / 3.0 * m.c10) * m.j1 * m.I1 + (4.0 / 3.0 * m.c01) * m.j2 * m.I2;
  m.c = p - m.g * m.inverseJ;
}

/// First Piola-Kirchhoff stress times the weight of the point.
PALP_INLINE void weightedStress(const Rubber& m, Pack weight, Pack P[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) P[r][s] = weight * (m.a * m.F[r][s] + m.b * m.E[r][s] + m.c * m.cof[r][s]);
}

PALP_INLINE constexpr int permutationSign(int i, int j, int k) {
  return (i - j) * (j - k) * (k - i) / 2;
}

/// dP/dF times the weight: A[3 r + s][3 i + j] = dP_rs / dF_ij, symmetric.
PALP_INLINE void weightedTangent(const Rubber& m, const Pack C[3][3], Pack weight, Pack A[9][9]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Pack dJ = m.cof[i][j];
      const Pack dI1 = 2.0 * m.F[i][j], dI2 = 2.0 * m.E[i][j];
      const Pack dj1 = (-2.0 / 3.0) * m.j1 * m.inverseJ * dJ, dj2 = (-4.0 / 3.0) * m.j2 * m.inverseJ * dJ;
      const Pack da = (2.0 * m.c10) * dj1, db = (2.0 * m.c01) * dj2;
      const Pack dg = (2.0 / 3.0 * m.c10) * (dj1 * m.I1 + m.j1 * dI1) + (4.0 / 3.0 * m.c01) * (dj2 * m.I2 + m.j2 * dI2);
      const Pack dc = (m.g * dJ * m.inverseJ - dg) * m.inverseJ;
      const int column = 3 * i + j;
      for (int r = 0; r < 3; ++r)
        for (int s = 0; s < 3; ++s) {
          const int row = 3 * r + s;
          if (row > column) continue;
          Pack dE = dI1 * m.F[r][s] - m.F[r][j] * m.F[i][s];
          if (s == j) dE -= m.B[r][i];
          if (r == i) dE -= C[j][s];
          if (r == i && s == j) dE += m.I1;
          Pack dP = da * m.F[r][s] + db * m.E[r][s] + m.b * dE + dc * m.cof[r][s];
          if (r == i && s == j) dP += m.a;
          if (r != i && s != j) {
            const int k = 3 - i - r, l = 3 - j - s;
            dP += double(permutationSign(r, k, i) * permutationSign(s, l, j)) * m.c * m.F[k][l];
          }
          A[row][column] = weight * dP;
          A[column][row] = A[row][column];
        }
    }
}

PALP_INLINE void rightCauchyGreen(const Pack F[3][3], Pack C[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s) C[r][s] = F[0][r] * F[0][s] + F[1][r] * F[1][s] + F[2][r] * F[2][s];
}

/// A point's part of the stiffness over the nodes' displacements, then the pressures: K[i][j], i <= j. N holds the
/// gradients of the nodes' shape functions, l the values of the pressures'.
template <int Nodes, int Pressures>
PALP_INLINE void addStiffness(const Rubber& m, const Pack N[Nodes][3], Pack weight, const double l[Pressures],
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
