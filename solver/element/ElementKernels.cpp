#include "solver/element/ElementKernels.h"

#include "model/Mesh.h"
#include "solver/element/LaneKernels.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace palp {

namespace baseline {
extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
extern const LaneKernels laneKernelSet;
} // namespace baseline
#ifdef PALP_WIDE_KERNELS
namespace avx2 {
extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
extern const LaneKernels laneKernelSet;
} // namespace avx2
namespace avx512 {
extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
extern const LaneKernels laneKernelSet;
} // namespace avx512
#endif

namespace {

InstructionSet widest() {
#ifdef PALP_WIDE_KERNELS
  // x86-64-v4 and -v3; clang 14 does not have these names
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return InstructionSet::Avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma"))
    return InstructionSet::Avx2;
#endif
  return InstructionSet::Baseline;
}

} // namespace

InstructionSet instructionSet() {
  const char* asked = std::getenv("PALP_INSTRUCTION_SET");
  const std::string_view name = asked ? asked : "";
  if (name == "baseline") return InstructionSet::Baseline;
  if (name == "avx2") return std::min(InstructionSet::Avx2, widest());
  return widest();
}

const ElementKernels& elementKernels(ElementShape shape) {
  return *elementKernels(shape, instructionSet());
}

const ElementKernels* elementKernels(ElementShape shape, InstructionSet set) {
  const bool tets = shape == ElementShape::Tetrahedron10;
  if (set > widest()) return nullptr;
#ifdef PALP_WIDE_KERNELS
  if (set == InstructionSet::Avx512) return tets ? &avx512::tetKernels : &avx512::hexKernels;
  if (set == InstructionSet::Avx2) return tets ? &avx2::tetKernels : &avx2::hexKernels;
#endif
  return tets ? &baseline::tetKernels : &baseline::hexKernels;
}

const LaneKernels& laneKernels() {
  static const LaneKernels& chosen = [&]() -> const LaneKernels& {
#ifdef PALP_WIDE_KERNELS
    if (instructionSet() == InstructionSet::Avx512) return avx512::laneKernelSet;
    if (instructionSet() == InstructionSet::Avx2) return avx2::laneKernelSet;
#endif
    return baseline::laneKernelSet;
  }();
  return chosen;
}

} // namespace palp
