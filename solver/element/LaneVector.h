#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace palp {

/// Memory on cache lines, so that a load of 8 lanes never crosses one. Large pieces are mapped from the system and
/// unmapped immediately, since the heap would keep them; they are on huge pages where available, whose first access
/// takes a third of the time.
void* lineMemory(std::size_t bytes);
void freeLineMemory(void* memory, std::size_t bytes);
/// Returns the first `first` bytes of a large piece to the system; the remainder stays.
void freeFirst(void* memory, std::size_t bytes, std::size_t first);

template <class T> struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U> CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(lineMemory(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { freeLineMemory(p, n * sizeof(T)); }
  template <class U> bool operator==(const CacheLineAllocator<U>&) const { return true; }
};

/// Numbers in blocks of 8 lanes (ElementKernels.h).
using LaneVector = std::vector<double, CacheLineAllocator<double>>;
using FloatLanes = std::vector<float, CacheLineAllocator<float>>;

/// Numbers that are unset until they are written.
template <class T> class UnsetArray {
public:
  UnsetArray() = default;
  explicit UnsetArray(std::size_t size) { resize(size); }
  /// Forgets the numbers where the size changes.
  void resize(std::size_t size) {
    if (size == this->size()) return;
    memory_.reset(); // before the new memory is allocated
    if (size > 0) memory_ = {static_cast<T*>(lineMemory(size * sizeof(T))), Free{size}};
  }
  /// Unsets the first `count` values and releases their memory where possible.
  void forgetFirst(std::size_t count) { freeFirst(data(), size() * sizeof(T), count * sizeof(T)); }
  [[nodiscard]] std::size_t size() const { return memory_ ? memory_.get_deleter().size : 0; }
  [[nodiscard]] T* data() { return memory_.get(); }
  [[nodiscard]] const T* data() const { return memory_.get(); }

private:
  struct Free {
    std::size_t size;
    void operator()(T* p) const { freeLineMemory(p, size * sizeof(T)); }
  };
  std::unique_ptr<T[], Free> memory_{nullptr, Free{0}};
};

} // namespace palp
