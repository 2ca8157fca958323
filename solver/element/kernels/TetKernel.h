#pragma once

#include "solver/element/kernels/OgdenPoint.h"

namespace palp::PALP_KERNEL {

/// P2 tetrahedron with the quartic bubble 256 l0 l1 l2 l3 and linear discontinuous pressure. Without bubble F is linear
/// in the barycentric coordinates l, so that four vertex gradients give it everywhere.
struct Tet : TetLayout {
  static constexpr int points = 14;
};

/// Walkington's rule of 14 points, exact to degree 5: two orbits of 4 and one of 6.
struct TetRule {
  double l[Tet::points][4];
  double weight[Tet::points];
};
constexpr TetRule makeTetRule() {
  TetRule q{};
  int n = 0;
  const double a[2] = {.31088591926330060980, .092735250310891226402};
  const double w[2] = {.11268792571801585080, .073493043116361949544};
  for (int orbit = 0; orbit < 2; ++orbit)
    for (int k = 0; k < 4; ++k, ++n) {
      for (int i = 0; i < 4; ++i) q.l[n][i] = i == k ? 1 - 3 * a[orbit] : a[orbit];
      q.weight[n] = w[orbit];
    }
  const double c = .045503704125649649492;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j, ++n) {
      for (int k = 0; k < 4; ++k) q.l[n][k] = k == i || k == j ? c : .5 - c;
      q.weight[n] = .042546020777081466438;
    }
  return q;
}
constexpr TetRule tetRule = makeTetRule();

/// Geometry of the lanes: a number a lane, or one number for all.
struct LaneGeometry {
  Pack g[4][3], volume;
};
struct SharedGeometry {
  double g[4][3], volume;
};
PALP_INLINE LaneGeometry tetGeometry(const double* p) {
  LaneGeometry geometry;
  for (int i = 0; i < Tet::volume; ++i) geometry.g[i / 3][i % 3] = load(p + 8 * i);
  geometry.volume = load(p + 8 * Tet::volume);
  return geometry;
}
PALP_INLINE SharedGeometry tetSharedGeometry(const double* p) {
  SharedGeometry geometry;
  for (int i = 0; i < Tet::volume; ++i) geometry.g[i / 3][i % 3] = p[i];
  geometry.volume = p[Tet::volume];
  return geometry;
}

struct TetState {
  Pack vertexGradient[4][3][3];
  Pack bubble[3], pressure[4];
};

template <class Geometry>
PALP_INLINE void tetState(const Geometry& geo, const double* u, const double* x, TetState& state) {
  Pack ue[10][3];
  for (int n = 0; n < 10; ++n)
    for (int d = 0; d < 3; ++d) ue[n][d] = load(u + 8 * (3 * n + d));
  for (int k = 0; k < 4; ++k) {
    Pack coefficient[4][3];
    for (int i = 0; i < 4; ++i)
      for (int d = 0; d < 3; ++d) coefficient[i][d] = (i == k ? 3.0 : -1.0) * ue[i][d];
    for (int e = 0; e < 6; ++e)
      for (int end = 0; end < 2; ++end)
        if (tetEdges[e][end] == k)
          for (int d = 0; d < 3; ++d) coefficient[tetEdges[e][1 - end]][d] += 4.0 * ue[4 + e][d];
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s < 3; ++s)
        state.vertexGradient[k][r][s] = coefficient[0][r] * geo.g[0][s] + coefficient[1][r] * geo.g[1][s] +
                                        coefficient[2][r] * geo.g[2][s] + coefficient[3][r] * geo.g[3][s] +
                                        (r == s ? 1.0 : 0.0);
  }
  for (int d = 0; d < 3; ++d) state.bubble[d] = load(x + 8 * d);
  for (int k = 0; k < 4; ++k) state.pressure[k] = load(x + 8 * (3 + k));
}

template <class Geometry> PALP_INLINE void bubbleGradient(const Geometry& geo, const double* l, Pack gradient[3]) {
  const double w[4] = {256 * l[1] * l[2] * l[3], 256 * l[0] * l[2] * l[3], 256 * l[0] * l[1] * l[3],
                       256 * l[0] * l[1] * l[2]};
  for (int s = 0; s < 3; ++s)
    gradient[s] = Pack{} + (w[0] * geo.g[0][s] + w[1] * geo.g[1][s] + w[2] * geo.g[2][s] + w[3] * geo.g[3][s]);
}

/// What residual and tangent sum over the points.
struct TetSums {
  Pack stress[4][3][3] = {}; ///< sum of w l_k P
  Pack bubble[3] = {};
  Pack volume[4] = {}; ///< sum of w l_k (J - 1)
  Pack smallestJ, largestJ;
};

template <class Geometry, class Point>
PALP_INLINE void tetPoint(const Geometry& geo, const TetState& state, int q, Point& m, Pack gradient[3]) {
  const double* l = tetRule.l[q];
  bubbleGradient(geo, l, gradient);
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s)
      m.F[r][s] = l[0] * state.vertexGradient[0][r][s] + l[1] * state.vertexGradient[1][r][s] +
                  l[2] * state.vertexGradient[2][r][s] + l[3] * state.vertexGradient[3][r][s] +
                  state.bubble[r] * gradient[s];
  evaluate(m,
           l[0] * state.pressure[0] + l[1] * state.pressure[1] + l[2] * state.pressure[2] + l[3] * state.pressure[3]);
}

template <class Point>
PALP_INLINE void addTetPoint(const Point& m, const Pack gradient[3], Pack weight, const double* l, TetSums& sums) {
  Pack P[3][3];
  weightedStress(m, weight, P);
  for (int k = 0; k < 4; ++k)
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s < 3; ++s) sums.stress[k][r][s] += l[k] * P[r][s];
  for (int r = 0; r < 3; ++r) sums.bubble[r] += P[r][0] * gradient[0] + P[r][1] * gradient[1] + P[r][2] * gradient[2];
  const Pack growth = weight * (m.J - 1.0);
  for (int k = 0; k < 4; ++k) sums.volume[k] += l[k] * growth;
  sums.smallestJ = smaller(sums.smallestJ, m.leastJ);
  sums.largestJ = larger(sums.largestJ, m.J);
}

template <class Geometry>
PALP_INLINE void storeTetResidual(const Geometry& geo, const TetState& state, const TetSums& sums,
                                  double compressibility, const ElementResidual& out, int lane) {
  for (int i = 0; i < 4; ++i)
    for (int r = 0; r < 3; ++r) {
      Pack f = Pack{};
      for (int s = 0; s < 3; ++s) {
        const Pack total = sums.stress[0][r][s] + sums.stress[1][r][s] + sums.stress[2][r][s] + sums.stress[3][r][s];
        f += (4.0 * sums.stress[i][r][s] - total) * geo.g[i][s];
      }
      store(out.forces + 8 * (3 * i + r) + lane, f);
    }
  for (int e = 0; e < 6; ++e)
    for (int r = 0; r < 3; ++r) {
      const int i = tetEdges[e][0], j = tetEdges[e][1];
      Pack f = Pack{};
      for (int s = 0; s < 3; ++s) f += sums.stress[i][r][s] * geo.g[j][s] + sums.stress[j][r][s] * geo.g[i][s];
      store(out.forces + 8 * (3 * (4 + e) + r) + lane, 4.0 * f);
    }
  for (int r = 0; r < 3; ++r) store(out.local + 8 * r + lane, sums.bubble[r]);
  const Pack total = state.pressure[0] + state.pressure[1] + state.pressure[2] + state.pressure[3];
  for (int k = 0; k < 4; ++k)
    store(out.local + 8 * (3 + k) + lane,
          sums.volume[k] - (compressibility / 20) * geo.volume * (state.pressure[k] + total));
  store(out.volumeRange + lane, sums.smallestJ);
  store(out.volumeRange + 8 + lane, sums.largestJ);
}

template <class Point, class Geometry>
PALP_INLINE void tetResidual(const RubberConstants& rubber, const Geometry& geo, const ElementInput& in,
                             const ElementResidual& out, int lane) {
  TetState state;
  tetState(geo, in.displacements + lane, in.unknowns + lane, state);
  TetSums sums;
  sums.smallestJ = load(out.volumeRange + lane);
  sums.largestJ = load(out.volumeRange + 8 + lane);
  Point m;
  m.law = decltype(m.law)(rubber);
#pragma GCC unroll 1
  for (int q = 0; q < Tet::points; ++q) {
    Pack gradient[3];
    tetPoint(geo, state, q, m, gradient);
    addTetPoint(m, gradient, Pack{} + tetRule.weight[q] * geo.volume, tetRule.l[q], sums);
  }
  storeTetResidual(geo, state, sums, rubber.compressibility_per_MPa, out, lane);
}

PALP_INLINE void tetShapeGradients(const LaneGeometry& geo, const double* l, const Pack bubble[3], Pack N[11][3]) {
  for (int d = 0; d < 3; ++d) {
    for (int i = 0; i < 4; ++i) N[i][d] = (4 * l[i] - 1) * geo.g[i][d];
    for (int e = 0; e < 6; ++e)
      N[4 + e][d] = 4 * (l[tetEdges[e][0]] * geo.g[tetEdges[e][1]][d] + l[tetEdges[e][1]] * geo.g[tetEdges[e][0]][d]);
    N[10][d] = bubble[d];
  }
}

/// Residual and uncondensed stiffness of the elements in the lanes.
template <class Point>
PALP_INLINE void tetStiffness(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out,
                              int lane, Pack K[Tet::rows][Tet::rows]) {
  const LaneGeometry geo = tetGeometry(in.geometry + lane);
  TetState state;
  tetState(geo, in.displacements + lane, in.unknowns + lane, state);
  TetSums sums;
  sums.smallestJ = load(out.volumeRange + lane);
  sums.largestJ = load(out.volumeRange + 8 + lane);
  for (int i = 0; i < Tet::rows; ++i)
    for (int j = 0; j < Tet::rows; ++j) K[i][j] = Pack{};
  Point m;
  m.law = decltype(m.law)(rubber);
#pragma GCC unroll 1
  for (int q = 0; q < Tet::points; ++q) {
    Pack gradient[3], N[11][3];
    tetPoint(geo, state, q, m, gradient);
    const Pack weight = tetRule.weight[q] * geo.volume;
    addTetPoint(m, gradient, weight, tetRule.l[q], sums);
    tetShapeGradients(geo, tetRule.l[q], gradient, N);
    addStiffness<11, 4>(m, N, weight, tetRule.l[q], K);
  }
  for (int k = 0; k < 4; ++k)
    for (int n = k; n < 4; ++n)
      K[Tet::firstPressure + k][Tet::firstPressure + n] -=
          (rubber.tangentCompressibility_per_MPa / 20 * (k == n ? 2.0 : 1.0)) * geo.volume;
  storeTetResidual(geo, state, sums, rubber.compressibility_per_MPa, out, lane);
}

} // namespace palp::PALP_KERNEL
