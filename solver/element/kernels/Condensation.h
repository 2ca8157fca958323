#pragma once

#include "solver/element/kernels/Pack.h"

namespace palp::PALP_KERNEL {

// Static condensation (E. L. Wilson, IJNME 8, 1974): with u the displacements of an element's nodes, x its own unknowns
// (bubble, pressures),
//   | Kuu Kux | | du |   | -ru |        W  = Kxx^-1 Kxu
//   | Kxu Kxx | | dx | = | -rx |   =>   Kc = Kuu - Kux W,   rc = ru - W^T rx,   dx = -Kxx^-1 rx - W du.

/// Kxx^-1 of the symmetric indefinite block A = Kxx (upper triangle given) by A = L D L^T in the order bubble,
/// pressures: the pressures' pivots, -M/kappa - B Kbb^-1 B^T, are negative without cancellation, at nu = 0.5 as well.
template <int N> PALP_INLINE void invertLocal(Pack (*A)[N], Pack inverse[N][N]) {
  Pack L[N][N], pivotInverse[N];
  for (int i = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j) L[i][j] = A[j][i];
  for (int k = 0; k < N; ++k) {
    pivotInverse[k] = 1.0 / L[k][k];
    for (int i = k + 1; i < N; ++i) {
      const Pack f = L[i][k] * pivotInverse[k];
      for (int j = k + 1; j <= i; ++j) L[i][j] -= f * L[j][k];
    }
    for (int i = k + 1; i < N; ++i) L[i][k] *= pivotInverse[k];
  }
  for (int c = 0; c < N; ++c) {
    Pack y[N];
    for (int i = 0; i < N; ++i) {
      y[i] = all(i == c ? 1.0 : 0.0);
      for (int j = 0; j < i; ++j) y[i] -= L[i][j] * y[j];
    }
    for (int i = 0; i < N; ++i) y[i] *= pivotInverse[i];
    for (int i = N - 1; i >= 0; --i)
      for (int j = i + 1; j < N; ++j) y[i] -= L[j][i] * y[j];
    for (int i = 0; i < N; ++i) inverse[i][c] = y[i];
  }
}

/// Kc, W and Kxx^-1 as ElementTangent promises them; x are the last X rows of K.
template <int D, int X>
PALP_INLINE void eliminate(Pack (*K)[D + X], double* stiffness, double* elimination, double* localInverse, int lane) {
  Pack A[X][X], inverse[X][X];
  for (int i = 0; i < X; ++i)
    for (int j = i; j < X; ++j) A[i][j] = K[D + i][D + j];
  invertLocal<X>(A, inverse);
  for (int j = 0; j < X; ++j)
    for (int i = 0; i <= j; ++i) store(localInverse + 8 * (j * (j + 1) / 2 + i) + lane, inverse[i][j]);
#pragma GCC unroll 1
  for (int c = 0; c < D; ++c) {
    Pack w[X];
    for (int k = 0; k < X; ++k) {
      w[k] = inverse[k][0] * K[c][D];
      for (int m = 1; m < X; ++m) w[k] += inverse[k][m] * K[c][D + m];
      store(elimination + 8 * (k * D + c) + lane, w[k]);
    }
#pragma GCC unroll 1
    for (int i = 0; i <= c; ++i) {
      Pack t = K[i][c];
      for (int k = 0; k < X; ++k) t -= K[i][D + k] * w[k];
      store(stiffness + 8 * (c * (c + 1) / 2 + i) + lane, t);
    }
  }
}

template <int Stride> PALP_INLINE Pack item(const double* p, int index, int lane) {
  if constexpr (Stride == 1) {
    return all(p[index]);
  } else {
    return load(p + 8 * index + lane);
  }
}

/// forces = ru - W^T rx, given ru in `forces` and rx in `local`.
template <int D, int X, int Stride>
PALP_INLINE void condenseForces(const double* elimination, const double* local, double* forces) {
  for (int lane = 0; lane < 8; lane += packSize) {
    Pack r[X];
    for (int k = 0; k < X; ++k) r[k] = load(local + 8 * k + lane);
#pragma GCC unroll 1
    for (int c = 0; c < D; ++c) {
      Pack f = load(forces + 8 * c + lane);
      for (int k = 0; k < X; ++k) f -= item<Stride>(elimination, k * D + c, lane) * r[k];
      store(forces + 8 * c + lane, f);
    }
  }
}

/// dx = -Kxx^-1 rx - W du.
template <int D, int X, int Stride>
PALP_INLINE void recoverUnknowns(const double* elimination, const double* localInverse, const double* local,
                                 const double* du, double* dx) {
  for (int lane = 0; lane < 8; lane += packSize) {
    Pack r[X], t[X];
    for (int k = 0; k < X; ++k) r[k] = load(local + 8 * k + lane);
    for (int k = 0; k < X; ++k) {
      t[k] = Pack{};
      for (int m = 0; m < X; ++m) {
        const int low = k < m ? k : m, high = k < m ? m : k;
        t[k] -= item<Stride>(localInverse, high * (high + 1) / 2 + low, lane) * r[m];
      }
    }
#pragma GCC unroll 1
    for (int c = 0; c < D; ++c) {
      const Pack v = load(du + 8 * c + lane);
      for (int k = 0; k < X; ++k) t[k] -= item<Stride>(elimination, k * D + c, lane) * v;
    }
    for (int k = 0; k < X; ++k) store(dx + 8 * k + lane, t[k]);
  }
}

} // namespace palp::PALP_KERNEL
