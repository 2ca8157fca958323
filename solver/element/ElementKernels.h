#pragma once

#include <cstddef>

namespace palp {

enum class ElementShape; // model/Mesh.h, kept out of the kernels' sources

/// Values are stored in blocks of 8 SIMD lanes, [item][8]: 8 elements of one load, or 8 loads on one element.
inline constexpr int lanes = 8;
inline constexpr int largestElementDofs = 30; ///< of displacements, of all kinds

/// Index of value `item` of the `size` values of an element in [blocks][size][8]. For loads on elements,
/// [elements][blocks of loads][size][8], the index before it is element * loads + load.
constexpr std::size_t laneIndex(std::size_t element, std::size_t size, std::size_t item) {
  return (element / lanes * size + item) * lanes + element % lanes;
}

/// Corners of a tetrahedron's edges in VTK's order; the node on edge k is 4 + k. (No std::array: the kernels' sources,
/// compiled for several processors, must not share inline functions.)
inline constexpr int tetEdges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

/// Quadratic tetrahedra with a quartic bubble and linear discontinuous pressures: the order of the numbers of an
/// element, which all share who write or read them.
struct TetLayout {
  static constexpr int nodes = 10, dofs = 3 * nodes;
  static constexpr int bubbles = 3, pressures = 4, unknowns = bubbles + pressures;
  static constexpr int firstPressure = dofs + bubbles, rows = dofs + unknowns; ///< of the stiffness before condensation
  static constexpr int volume = 4 * 3, geometrySize = volume + 1; ///< geometry: 4 barycentric gradients, the volume
};

/// The same for trilinear hexahedra with one pressure.
struct HexLayout {
  static constexpr int nodes = 8, dofs = 3 * nodes;
  static constexpr int bubbles = 0, pressures = 1, unknowns = bubbles + pressures;
  static constexpr int firstPressure = dofs + bubbles, rows = dofs + unknowns;
  static constexpr int points = 8, weight = nodes * 3, pointSize = weight + 1; ///< a point: 8 gradients, its weight
  static constexpr int geometrySize = points * pointSize;
};

/// The laws that have kernels of their own; neo-Hooke's is Mooney-Rivlin's with c01 = 0.
enum class KernelLaw { MooneyRivlin, Yeoh, Gent, Ogden };
inline constexpr int kernelLaws = 4;
inline constexpr int ogdenTerms = 3;

struct RubberConstants {
  KernelLaw law;
  /// c10, c01 [MPa]; Yeoh's c10, c20, c30 [MPa]; Gent's mu [MPa], jm; Ogden's mu [MPa], alpha of each term, then zeros.
  double constants[2 * ogdenTerms];
  double shearModulus_MPa;               ///< at rest
  double compressibility_per_MPa;        ///< 1/kappa; 0: incompressible
  double tangentCompressibility_per_MPa; ///< the same, kept above 0: the tangent's pressures are eliminated by it

  /// Whether single precision will do where iterations correct it: kappa is at most 1000 times the shear modulus. In a
  /// stiffer volume rounding weighs as much as the load.
  [[nodiscard]] bool roundsWell() const { return shearModulus_MPa * tangentCompressibility_per_MPa * 1000 >= 1; }
};

/// Reported as the smallest J where the rubber is stretched beyond the limit of its law.
inline constexpr double lockedVolume = -__builtin_inf();

/// What one call of a kernel reads.
struct ElementInput {
  const double* geometry;      ///< [geometrySize][8], or [geometrySize] where one element serves all lanes
  const double* displacements; ///< [3 nodes][8]: the nodes' displacements, 3 n + direction
  const double* unknowns;      ///< [unknowns][8]: bubble, pressures
};

struct ElementResidual {
  double* forces;      ///< [3 nodes][8] internal forces
  double* local;       ///< [unknowns][8] residual of the element's own unknowns
  double* volumeRange; ///< [2][8] smallest (lockedVolume: beyond the law's limit) and largest J met, kept across calls
};

/// The tangent with the element's own unknowns x eliminated: Kc = Kuu - Kux W, W = Kxx^-1 Kxu.
struct ElementTangent {
  double* stiffness;    ///< [d (d + 1) / 2][8], d = 3 nodes: upper triangle by columns
  double* elimination;  ///< W [unknowns * d][8], row by row
  double* localInverse; ///< Kxx^-1 [unknowns * (unknowns + 1) / 2][8], upper triangle by columns
};

/// Kernels of one element shape and one law of rubber.
struct LawKernels {
  /// 8 elements, one load.
  void (*residual)(const RubberConstants&, const ElementInput&, const ElementResidual&);
  /// One element, 8 loads: `geometry` holds one number an item.
  void (*residualOfLoads)(const RubberConstants&, const ElementInput&, const ElementResidual&);
  /// The same exact to a few times 1e-7 of itself: in single precision where that is faster.
  void (*residualOfLoadsInSingle)(const RubberConstants&, const ElementInput&, const ElementResidual&);
  void (*tangent)(const RubberConstants&, const ElementInput&, const ElementResidual&, const ElementTangent&);
};

/// Kernels of one element shape, for the instruction set at hand.
struct ElementKernels {
  int nodes;
  int unknowns;
  int bubbles; ///< the unknowns that come first; the others are pressures
  int geometrySize;
  LawKernels laws[kernelLaws];
  [[nodiscard]] const LawKernels& of(const RubberConstants& rubber) const { return laws[int(rubber.law)]; }
  /// forces -= W^T local: 8 elements, or one element (W [unknowns * d]) and 8 loads.
  void (*condense)(const double* elimination, const double* local, double* forces);
  void (*condenseLoads)(const double* elimination, const double* local, double* forces);
  /// dx = -Kxx^-1 local - W du, in the same two ways.
  void (*recover)(const double* elimination, const double* localInverse, const double* local, const double* du,
                  double* dx);
  void (*recoverLoads)(const double* elimination, const double* localInverse, const double* local, const double* du,
                       double* dx);
};

/// What the kernels are compiled for.
enum class InstructionSet { Baseline, Avx2, Avx512 };
/// The processor's widest instruction set that this program has, or the narrower one that PALP_INSTRUCTION_SET names.
InstructionSet instructionSet();

/// Kernels for the shape, by the widest instruction set of this processor; numbers in the order of TetLayout and
/// HexLayout.
const ElementKernels& elementKernels(ElementShape shape);
/// The same for one instruction set; null where this program or processor has not got it.
const ElementKernels* elementKernels(ElementShape shape, InstructionSet set);

} // namespace palp
