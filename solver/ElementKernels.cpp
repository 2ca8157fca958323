#include "solver/ElementKernels.h"

#include "model/Mesh.h"

namespace palp {

namespace baseline {
extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
} // namespace baseline
#ifdef PALP_WIDE_KERNELS
namespace avx2 {
extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
} // namespace avx2
namespace avx512 {
extern const ElementKernels tetKernels;
extern const ElementKernels hexKernels;
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

} // namespace palp
