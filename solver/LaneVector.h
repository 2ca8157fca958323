#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace palp {

/// Memory on cache lines, so that a load of 8 lanes never crosses one; large pieces on huge pages where the system has
/// them, whose first touch takes a third of the time.
void* lineMemory(std::size_t bytes);
void freeLineMemory(void* memory);

template <class T> struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U> CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(lineMemory(n * sizeof(T))); }
  void deallocate(T* p, std::size_t) { freeLineMemory(p); }
  template <class U> bool operator==(const CacheLineAllocator<U>&) const { return true; }
};

/// Numbers in blocks of 8 lanes (ElementKernels.h).
using LaneVector = std::vector<double, CacheLineAllocator<double>>;

/// Numbers that are unset until they are written.
class UnsetArray {
public:
  UnsetArray() = default;
  explicit UnsetArray(std::size_t size) { resize(size); }
  UnsetArray(UnsetArray&& other) noexcept : memory_(std::move(other.memory_)), size_(std::exchange(other.size_, 0)) {}
  UnsetArray& operator=(UnsetArray&& other) noexcept {
    memory_ = std::move(other.memory_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }
  /// Forgets the numbers where the size changes.
  void resize(std::size_t size) {
    if (size == size_) return;
    memory_.reset(size > 0 ? static_cast<double*>(lineMemory(size * sizeof(double))) : nullptr);
    size_ = size;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double* data() { return memory_.get(); }
  [[nodiscard]] const double* data() const { return memory_.get(); }

private:
  struct Free {
    void operator()(double* p) const { freeLineMemory(p); }
  };
  std::unique_ptr<double[], Free> memory_;
  std::size_t size_ = 0;
};

} // namespace palp
