#pragma once

#include "solver/element/kernels/PackFunctions.h"
#include "solver/element/kernels/Rubber.h"

namespace palp::PALP_KERNEL {

/// Ogden's law, W = sum 2 mu / alpha^2 (l1^alpha + l2^alpha + l3^alpha - 3) of the isochoric stretches l.
struct OgdenLaw {
  double amplitude[ogdenTerms] = {}, halfAlpha[ogdenTerms] = {}, slope[ogdenTerms] = {}; ///< 2 mu / alpha, 2 mu
  int terms = 0;
  PALP_INLINE_MEMBER OgdenLaw() = default;
  PALP_INLINE_MEMBER explicit OgdenLaw(const RubberConstants& r) {
    for (; terms < ogdenTerms && r.constants[2 * terms + 1] != 0; ++terms) {
      const double mu = r.constants[2 * terms], alpha = r.constants[2 * terms + 1];
      halfAlpha[terms] = alpha / 2;
      amplitude[terms] = 2 * mu / alpha;
      slope[terms] = 2 * mu;
    }
  }
};

/// Ogden's rubber at one point, pressure p (tension positive) independent: P = (T + p J 1) F^-T with the Kirchhoff
/// stress T = sum_a s_a n_a (x) n_a, s the deviator of dW/d ln l. Any directions will do where stretches are equal.
struct OgdenPoint {
  Pack F[3][3], cof[3][3], B[3][3];
  Pack J, inverseJ, p, leastJ;
  Pack n[3][3]; ///< n[a]: principal direction a of B = F F^T
  Pack x[3];    ///< squared isochoric stretches
  Pack s[3];    ///< deviatoric principal Kirchhoff stresses
  Pack t[3];    ///< their derivatives by ln l, as if the stretches were independent
  OgdenLaw law;
};

/// One Jacobi rotation in the plane of k and l, which makes B[k][l] vanish.
PALP_INLINE void jacobiRotation(Pack B[3][3], Pack n[3][3], int k, int l) {
  const int other = 3 - k - l;
  const Pack twice = 2.0 * B[k][l], gap = B[l][l] - B[k][k];
  const Pack reach = (gap < 0.0 ? -gap : gap) + squareRoot(gap * gap + twice * twice) + 1e-300;
  const Pack t = (gap < 0.0 ? -twice : twice) / reach;
  const Pack c = 1.0 / squareRoot(1.0 + t * t), s = t * c;
  B[k][k] -= t * B[k][l];
  B[l][l] += t * B[k][l];
  B[k][l] = B[l][k] = Pack{};
  const Pack first = B[other][k], second = B[other][l];
  B[other][k] = B[k][other] = c * first - s * second;
  B[other][l] = B[l][other] = s * first + c * second;
  for (int d = 0; d < 3; ++d) {
    const Pack nk = n[k][d], nl = n[l][d];
    n[k][d] = c * nk - s * nl;
    n[l][d] = s * nk + c * nl;
  }
}

/// Eigenvectors n[a] of B, whose diagonal becomes its eigenvalues. Always as many rotations, so that no lane's bytes
/// depend on its neighbours. The convergence is cubic: after four sweeps the rest was below 1e-20 of B in 100,000
/// random deformation gradients, strains from 5 % to several 100 %.
PALP_INLINE void principalDirections(Pack B[3][3], Pack n[3][3]) {
  constexpr int sweeps = 4;
  for (int a = 0; a < 3; ++a)
    for (int d = 0; d < 3; ++d) n[a][d] = all(a == d ? 1.0 : 0.0);
#pragma GCC unroll 1
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    jacobiRotation(B, n, 0, 1);
    jacobiRotation(B, n, 0, 2);
    jacobiRotation(B, n, 1, 2);
  }
}

/// Fills everything but F and the law, which are given.
PALP_INLINE void evaluate(OgdenPoint& m, Pack p) {
  cofactor(m.F, m.cof);
  volumeAndLeftCauchyGreen(m);
  principalDirections(m.B, m.n);
  const Pack root = inverseCubeRoot(m.J), j1 = root * root;
  m.inverseJ = j1 * root;
  m.p = p;
  m.leastJ = m.J;
  Pack lnX[3];
  for (int a = 0; a < 3; ++a) {
    m.x[a] = j1 * m.B[a][a];
    lnX[a] = logarithm(m.x[a]);
    m.s[a] = m.t[a] = Pack{};
  }
#pragma GCC unroll 1
  for (int term = 0; term < m.law.terms; ++term)
    for (int a = 0; a < 3; ++a) {
      const Pack power = exponential(m.law.halfAlpha[term] * lnX[a]);
      m.s[a] += m.law.amplitude[term] * power;
      m.t[a] += m.law.slope[term] * power;
    }
  const Pack mean = (1.0 / 3.0) * (m.s[0] + m.s[1] + m.s[2]);
  for (int a = 0; a < 3; ++a) m.s[a] -= mean;
}

/// First Piola-Kirchhoff stress times the weight of the point.
PALP_INLINE void weightedStress(const OgdenPoint& m, Pack weight, Pack P[3][3]) {
  Pack T[3][3];
  for (int r = 0; r < 3; ++r)
    for (int s = r; s < 3; ++s) {
      T[r][s] = m.inverseJ *
                (m.s[0] * m.n[0][r] * m.n[0][s] + m.s[1] * m.n[1][r] * m.n[1][s] + m.s[2] * m.n[2][r] * m.n[2][s]);
      T[s][r] = T[r][s];
    }
  for (int r = 0; r < 3; ++r) T[r][r] += m.p;
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s)
      P[r][s] = weight * (T[r][0] * m.cof[0][s] + T[r][1] * m.cof[1][s] + T[r][2] * m.cof[2][s]);
}

/// (s_a - s_b) / (x_a - x_b); where the two stretches are equal or nearly so, the mean of both ends' derivatives
/// t / (2 x), which then differs from it by 1e-10.
PALP_INLINE Pack stressOverStretch(const OgdenPoint& m, int a, int b) {
  constexpr double nearlyEqual = 3e-5;
  const Pack gap = m.x[a] - m.x[b], size = gap < 0.0 ? -gap : gap;
  const auto apart = size > nearlyEqual * (m.x[a] + m.x[b]);
  const Pack derivative = 0.25 * (m.t[a] / m.x[a] + m.t[b] / m.x[b]);
  return apart ? (m.s[a] - m.s[b]) / (apart ? gap : all(1.0)) : derivative;
}

/// dP/dF times the weight, as of Rubber. With v_ab = n_a (x) F^-1 n_b and dF = L F, L_ab = v_ab : dF, the isochoric
/// part is sum_ac D_ac v_aa v_cc, D_ac = ds_a/d ln l_c - s_a delta_ac, and for each pair a != b with h = (s_a - s_b) /
/// (x_a - x_b): h x_b v_ab v_ab + h x_a v_ba v_ba + (h x_a - s_a) (v_ab v_ba + v_ba v_ab).
PALP_INLINE void weightedTangent(const OgdenPoint& m, const Pack /*C*/[3][3], Pack weight, Pack A[9][9]) {
  Pack back[3][3]; // F^-1 n_b
  for (int b = 0; b < 3; ++b)
    for (int s = 0; s < 3; ++s)
      back[b][s] = m.inverseJ * (m.cof[0][s] * m.n[b][0] + m.cof[1][s] * m.n[b][1] + m.cof[2][s] * m.n[b][2]);
  Pack v[9][9], y[9][9]; // v of the pair 3 a + b, and the same times the moduli
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int r = 0; r < 3; ++r)
        for (int s = 0; s < 3; ++s) v[3 * a + b][3 * r + s] = m.n[a][r] * back[b][s];
  const Pack sum = m.t[0] + m.t[1] + m.t[2];
  for (int a = 0; a < 3; ++a) {
    Pack D[3];
    for (int c = 0; c < 3; ++c) D[c] = (1.0 / 9.0) * sum - (1.0 / 3.0) * (m.t[a] + m.t[c]);
    D[a] += m.t[a] - m.s[a];
    for (int i = 0; i < 9; ++i) y[4 * a][i] = D[0] * v[0][i] + D[1] * v[4][i] + D[2] * v[8][i];
  }
  for (int a = 0; a < 3; ++a)
    for (int b = a + 1; b < 3; ++b) {
      const Pack h = stressOverStretch(m, a, b), own = h * m.x[b], other = h * m.x[a], cross = other - m.s[a];
      for (int i = 0; i < 9; ++i) {
        y[3 * a + b][i] = own * v[3 * a + b][i] + cross * v[3 * b + a][i];
        y[3 * b + a][i] = other * v[3 * b + a][i] + cross * v[3 * a + b][i];
      }
    }
  for (int row = 0; row < 9; ++row)
    for (int column = row; column < 9; ++column) {
      Pack dP{};
      for (int pair = 0; pair < 9; ++pair) dP += v[pair][row] * y[pair][column];
      const int r = row / 3, s = row % 3, i = column / 3, j = column % 3;
      if (r != i && s != j) {
        const int k = 3 - i - r, l = 3 - j - s;
        dP += double(permutationSign(r, k, i) * permutationSign(s, l, j)) * m.p * m.F[k][l];
      }
      A[row][column] = weight * dP;
      A[column][row] = A[row][column];
    }
}

} // namespace palp::PALP_KERNEL
