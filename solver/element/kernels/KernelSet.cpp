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
          .condense = condenseForces<D, X, 8>,
          .condenseLoads = condenseForces<D, X, 1>,
          .recover = recoverUnknowns<D, X, 8>,
          .recoverLoads = recoverUnknowns<D, X, 1>};
}

void forwardFactorOfOne(const BlockedFactor& L, int first, int last, double* x) {
  for (int s = first; s < last; ++s) forwardSupernodeOfOne(L, s, x);
}

void backwardFactorOfOne(const BlockedFactor& L, int first, int last, double* x) {
  for (int s = last - 1; s >= first; --s) backwardSupernodeOfOne(L, s, x);
}

} // namespace

extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
extern const LaneKernels laneKernelSet;
const LaneKernels laneKernelSet = {.forward = forwardLanes,
                                   .backward = backwardLanes,
                                   .forwardOne = forwardFactorOfOne,
                                   .backwardOne = backwardFactorOfOne,
                                   .addPolynomials = evaluatePolynomials,
                                   .gather = gatherRows,
                                   .subtract = subtractRows,
                                   .gatherScaled = gatherScaledRows,
                                   .sumMixed = sumMixed,
                                   .stepMixed = stepMixed,
                                   .followMixed = followMixed,
                                   .beginLoads = beginLoads,
                                   .addPointSource = addSource,
                                   .eightSums = sumsOfEight,
                                   .addSquares = squaresOfLanes,
                                   .narrow = scaledFloats,
                                   .widen = scaledDoubles,
                                   .subtractProduct = subtractOfLanes};
constexpr ElementKernels tetSet =
    kernelsOf<Tet>(tetResidual8, tetResidualOfLoads, tetResidualOfLoadsInSingle, tetTangent);
constexpr ElementKernels hexSet = kernelsOf<Hex>(hexResidual8, hexResidualOfLoads, hexResidualOfLoads, hexTangent);
const ElementKernels tetKernels = tetSet;
const ElementKernels hexKernels = hexSet;

} // namespace palp::PALP_KERNEL
