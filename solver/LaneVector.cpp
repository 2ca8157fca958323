#include "solver/LaneVector.h"

#include <cstdlib>
#include <sys/mman.h>

namespace palp {

namespace {

constexpr std::size_t line = 64, hugePage = std::size_t(1) << 21U;

} // namespace

void* lineMemory(std::size_t bytes) {
  const bool large = bytes >= 2 * hugePage;
  const std::size_t unit = large ? hugePage : line;
  void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
  if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (large) madvise(memory, bytes, MADV_HUGEPAGE); // a hint: refused, it costs time alone
#endif
  return memory;
}

void freeLineMemory(void* memory) {
  std::free(memory); // NOLINT(cppcoreguidelines-no-malloc): aligned_alloc's counterpart
}

} // namespace palp
