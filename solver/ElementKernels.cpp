#include "solver/ElementKernels.h"

#include "model/Mesh.h"
#include "solver/LaneKernels.h"

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

const ElementKernels& elementKernels(ElementShape shape) {
  const bool tets = shape == ElementShape::Tetrahedron10;
#ifdef PALP_WIDE_KERNELS
  if (__builtin_cpu_supports("x86-64-v4")) return tets ? avx512::tetKernels : avx512::hexKernels;
  if (__builtin_cpu_supports("x86-64-v3")) return tets ? avx2::tetKernels : avx2::hexKernels;
#endif
  return tets ? baseline::tetKernels : baseline::hexKernels;
}

const LaneKernels& laneKernels() {
#ifdef PALP_WIDE_KERNELS
  if (__builtin_cpu_supports("x86-64-v4")) return avx512::laneKernelSet;
  if (__builtin_cpu_supports("x86-64-v3")) return avx2::laneKernelSet;
#endif
  return baseline::laneKernelSet;
}

} // namespace palp
