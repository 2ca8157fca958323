#include "solver/element/LaneVector.h"

#include <cstdint>
#include <cstdlib>
#include <sys/mman.h>

namespace palp {

namespace {

constexpr std::size_t line = 64, hugePage = std::size_t(1) << 21U;
constexpr std::size_t page = std::size_t(1) << 16U; // a multiple of every system's
constexpr std::size_t large = hugePage / 2;

std::size_t roundedUp(std::size_t bytes, std::size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

/// From the system, at the start of a huge page.
void* mapped(std::size_t bytes) {
  void* memory = mmap(nullptr, bytes + hugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  char* begin = static_cast<char*>(memory);
  const std::size_t address = reinterpret_cast<std::uintptr_t>(memory);
  const std::size_t before = roundedUp(address, hugePage) - address;
  if (before > 0) munmap(begin, before);
  munmap(begin + before + bytes, hugePage - before);
#ifdef MADV_HUGEPAGE
  madvise(begin + before, bytes, MADV_HUGEPAGE); // a hint: refused, it costs time alone
#endif
  return begin + before;
}

} // namespace

void* lineMemory(std::size_t bytes) {
  if (bytes >= large) return mapped(roundedUp(bytes, page));
  void* memory = std::aligned_alloc(line, roundedUp(bytes, line));
  if (!memory) throw std::bad_alloc();
  return memory;
}

void freeFirst(void* memory, std::size_t bytes, std::size_t first) {
  if (bytes >= large && first >= page) madvise(memory, first / page * page, MADV_DONTNEED);
}

void freeLineMemory(void* memory, std::size_t bytes) {
  if (bytes >= large)
    munmap(memory, roundedUp(bytes, page));
  else
    std::free(memory); // NOLINT(cppcoreguidelines-no-malloc): aligned_alloc's counterpart
}

} // namespace palp
