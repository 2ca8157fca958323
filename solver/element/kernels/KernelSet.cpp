// Compiled once for each instruction set, with PALP_KERNEL (a name) and PALP_PACK (doubles per register) given.
#include "solver/element/kernels/Condensation.h"
#include "solver/element/kernels/HexKernel.h"
#include "solver/element/kernels/LaneMix.h"
#include "solver/element/kernels/LaneSolve.h"
#include "solver/element/kernels/ScalarField.h"
#include "solver/element/kernels/SingleTet.h"
#include "solver/element/kernels/TetKernel.h"

namespace palp::PALP_KERNEL {
namespace {

void tetResidual8(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  for (int lane = 0; lane < 8; lane += packSize) tetResidual(rubber, tetGeometry(in.geometry + lane), in, out, lane);
}

void tetResidualOfLoads(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  const SharedGeometry geometry = tetSharedGeometry(in.geometry);
  for (int lane = 0; lane < 8; lane += packSize) tetResidual(rubber, geometry, in, out, lane);
}

void tetResidualOfLoadsInSingle(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  SingleGeometry geometry;
  for (int i = 0; i < Tet::volume; ++i) geometry.g[i / 3][i % 3] = float(in.geometry[i]);
  geometry.volume = float(in.geometry[Tet::volume]);
  for (int lane = 0; lane < 8; lane += singlePackSize) tetResidualInSingle(rubber, geometry, in, out, lane);
}

void tetTangent(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out,
                const ElementTangent& tangent) {
  for (int lane = 0; lane < 8; lane += packSize) {
    Pack K[Tet::rows][Tet::rows];
    tetStiffness(rubber, in, out, lane, K);
    eliminate<Tet::dofs, Tet::unknowns>(K, tangent.stiffness, tangent.elimination, tangent.localInverse, lane);
  }
}

void hexResidual8(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  for (int lane = 0; lane < 8; lane += packSize) hexElement<8, false>(rubber, in, out, lane, nullptr);
}

void hexResidualOfLoads(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  for (int lane = 0; lane < 8; lane += packSize) hexElement<1, false>(rubber, in, out, lane, nullptr);
}

void hexTangent(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out,
                const ElementTangent& tangent) {
  for (int lane = 0; lane < 8; lane += packSize) {
    Pack K[Hex::rows][Hex::rows];
    for (int i = 0; i < Hex::rows; ++i)
      for (int j = 0; j < Hex::rows; ++j) K[i][j] = Pack{};
    hexElement<8, true>(rubber, in, out, lane, K);
    eliminate<Hex::dofs, Hex::unknowns>(K, tangent.stiffness, tangent.elimination, tangent.localInverse, lane);
  }
}

template <int D, int X, int Stride> void condense(const double* elimination, const double* local, double* forces) {
  condenseForces<D, X, Stride>(elimination, local, forces);
}

template <int D, int X, int Stride>
void recover(const double* elimination, const double* localInverse, const double* local, const double* du, double* dx) {
  recoverUnknowns<D, X, Stride>(elimination, localInverse, local, du, dx);
}

template <class Element>
constexpr ElementKernels
kernelsOf(decltype(ElementKernels::residual) residual, decltype(ElementKernels::residualOfLoads) residualOfLoads,
          decltype(ElementKernels::residualOfLoads) inSingle, decltype(ElementKernels::tangent) tangent) {
  constexpr int D = Element::dofs, X = Element::unknowns;
  return {.nodes = Element::nodes,
          .unknowns = X,
          .bubbles = Element::bubbles,
          .geometrySize = Element::geometrySize,
          .residual = residual,
          .residualOfLoads = residualOfLoads,
          .residualOfLoadsInSingle = inSingle,
          .tangent = tangent,
          .condense = condense<D, X, 8>,
          .condenseLoads = condense<D, X, 1>,
          .recover = recover<D, X, 8>,
          .recoverLoads = recover<D, X, 1>};
}

void forwardFactor(const BlockedFactor& L, int first, int last, unsigned live, float* x) {
  forwardLanes(L, first, last, live, x);
}

void backwardFactor(const BlockedFactor& L, int first, int last, unsigned live, float* x) {
  backwardLanes(L, first, last, live, x);
}

void forwardFactorOfOne(const BlockedFactor& L, int first, int last, double* x) {
  for (int s = first; s < last; ++s) forwardSupernodeOfOne(L, s, x);
}

void backwardFactorOfOne(const BlockedFactor& L, int first, int last, double* x) {
  for (int s = last - 1; s >= first; --s) backwardSupernodeOfOne(L, s, x);
}

void polynomials(const double* coefficients, int terms, const double* monomials, int rows, double* out, int stride) {
  evaluatePolynomials(coefficients, terms, monomials, rows, out, stride);
}

void gather(const double* values, const int* nodes, int count, double* out) {
  gatherRows(values, nodes, count, out);
}

void subtract(const double* forces, const int* nodes, int count, double* values) {
  subtractRows(forces, nodes, count, values);
}

void gatherScaled(const float* x, const int* rows, const double* scale, const int* nodes, int count, double* out) {
  gatherScaledRows(x, rows, scale, nodes, count, out);
}

void sumsOfMixed(const MixedRows& rows, const LaneMix& mix, double* sums) {
  sumMixed(rows, mix, sums);
}

void stepsOfMixed(const MixedRows& rows, const LaneMix& mix, double* u) {
  stepMixed(rows, mix, u);
}

void stepsOfFollowing(const double* directions, int count, const LaneMix& mix, float* past, double* values) {
  followMixed(directions, count, mix, past, values);
}

void startsOfLoads(double* values, float* before, int rows, std::ptrdiff_t stride, const InitialGuess& guess) {
  beginLoads(values, before, rows, stride, starts);
}

void source(const SurfacePoints& points, const double* at, double* potential, double* flux) {
  addSource(points, at, potential, flux);
}

void sums8(const double* matrix, const double* values, int count, double* sums) {
  sumsOfEight(matrix, values, count, sums);
}

void squares(const double* x, int rows, double* sums) {
  squaresOfLanes(x, rows, sums);
}

void toFloats(const double* x, const double* scale, const int* order, int rows, float* out) {
  scaledFloats(x, scale, order, rows, out);
}

void toDoubles(const float* x, const double* scale, const int* order, int rows, double* out) {
  scaledDoubles(x, scale, order, rows, out);
}

void product(const LowerTriangle& K, const double* x, double* from) {
  subtractOfLanes(K, x, from);
}

} // namespace

extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
extern const LaneKernels laneKernelSet;
const LaneKernels laneKernelSet = {
    forwardFactor, backwardFactor, forwardFactorOfOne, backwardFactorOfOne, polynomials, gather, subtract, gatherScaled,
    sumsOfMixed,   stepsOfMixed,   stepsOfFollowing,   startsOfLoads,       source,      sums8,  squares,  toFloats,
    toDoubles,     product};
constexpr ElementKernels tetSet =
    kernelsOf<Tet>(tetResidual8, tetResidualOfLoads, tetResidualOfLoadsInSingle, tetTangent);
constexpr ElementKernels hexSet = kernelsOf<Hex>(hexResidual8, hexResidualOfLoads, hexResidualOfLoads, hexTangent);
const ElementKernels tetKernels = tetSet;
const ElementKernels hexKernels = hexSet;

} // namespace palp::PALP_KERNEL
