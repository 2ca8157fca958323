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

template <class Point>
void tetResidual8(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  for (int lane = 0; lane < 8; lane += packSize)
    tetResidual<Point>(rubber, tetGeometry(in.geometry + lane), in, out, lane);
}

template <class Point>
void tetResidualOfLoads(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  const SharedGeometry geometry = tetSharedGeometry(in.geometry);
  for (int lane = 0; lane < 8; lane += packSize) tetResidual<Point>(rubber, geometry, in, out, lane);
}

template <class Law>
void tetResidualOfLoadsInSingle(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  SingleGeometry geometry;
  for (int i = 0; i < Tet::volume; ++i) geometry.g[i / 3][i % 3] = float(in.geometry[i]);
  geometry.volume = float(in.geometry[Tet::volume]);
  for (int lane = 0; lane < 8; lane += singlePackSize) tetResidualInSingle<Law>(rubber, geometry, in, out, lane);
}

template <class Point>
void tetTangent(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out,
                const ElementTangent& tangent) {
  for (int lane = 0; lane < 8; lane += packSize) {
    Pack K[Tet::rows][Tet::rows];
    tetStiffness<Point>(rubber, in, out, lane, K);
    eliminate<Tet::dofs, Tet::unknowns>(K, tangent.stiffness, tangent.elimination, tangent.localInverse, lane);
  }
}

template <class Point, int Stride>
void hexResidual(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out) {
  for (int lane = 0; lane < 8; lane += packSize) hexElement<Point, Stride, false>(rubber, in, out, lane, nullptr);
}

template <class Point>
void hexTangent(const RubberConstants& rubber, const ElementInput& in, const ElementResidual& out,
                const ElementTangent& tangent) {
  for (int lane = 0; lane < 8; lane += packSize) {
    Pack K[Hex::rows][Hex::rows];
    for (int i = 0; i < Hex::rows; ++i)
      for (int j = 0; j < Hex::rows; ++j) K[i][j] = Pack{};
    hexElement<Point, 8, true>(rubber, in, out, lane, K);
    eliminate<Hex::dofs, Hex::unknowns>(K, tangent.stiffness, tangent.elimination, tangent.localInverse, lane);
  }
}

/// A law of the invariants, in both precisions.
template <template <class> class Law> constexpr LawKernels tetLaw() {
  using Point = Rubber<Law<double>>;
  return {tetResidual8<Point>, tetResidualOfLoads<Point>, tetResidualOfLoadsInSingle<Law<float>>, tetTangent<Point>};
}

template <class Point> constexpr LawKernels hexLaw() {
  return {hexResidual<Point, 8>, hexResidual<Point, 1>, hexResidual<Point, 1>, hexTangent<Point>};
}

/// Kernels of all laws in the order of KernelLaw. Single precision gains nothing where eigenvectors take most of the
/// time.
constexpr LawKernels tetLaws[kernelLaws] = {
    tetLaw<MooneyRivlinLaw>(),
    tetLaw<YeohLaw>(),
    tetLaw<GentLaw>(),
    {tetResidual8<OgdenPoint>, tetResidualOfLoads<OgdenPoint>, tetResidualOfLoads<OgdenPoint>, tetTangent<OgdenPoint>}};
constexpr LawKernels hexLaws[kernelLaws] = {hexLaw<Rubber<MooneyRivlinLaw<double>>>(),
                                            hexLaw<Rubber<YeohLaw<double>>>(), hexLaw<Rubber<GentLaw<double>>>(),
                                            hexLaw<OgdenPoint>()};

template <class Element> constexpr ElementKernels kernelsOf(const LawKernels (&laws)[kernelLaws]) {
  constexpr int D = Element::dofs, X = Element::unknowns;
  return {.nodes = Element::nodes,
          .unknowns = X,
          .bubbles = Element::bubbles,
          .geometrySize = Element::geometrySize,
          .laws = {laws[0], laws[1], laws[2], laws[3]},
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
constexpr ElementKernels tetSet = kernelsOf<Tet>(tetLaws);
constexpr ElementKernels hexSet = kernelsOf<Hex>(hexLaws);
const ElementKernels tetKernels = tetSet;
const ElementKernels hexKernels = hexSet;

} // namespace palp::PALP_KERNEL
