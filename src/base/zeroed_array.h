// An array of zeros whose memory is mapped when it is first used.
//
// The system maps pages of zeros at the first access, so a search that stays near its start neither
// waits for the rest of a large array nor occupies it. Very large arrays request huge pages: with
// small ones a search over a map of 4096x4096 cells spends half its time in TLB misses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace grid_path_planner::base {

// `count` x `size` bytes of zeros. Throws std::bad_alloc.
void* zeroedMemory(std::size_t count, std::size_t size);
void freeZeroedMemory(void* memory, std::size_t bytes);

template <class T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>,
                "zero bytes must be a value");

 public:
  ZeroedArray() = default;
  // Throws std::bad_alloc.
  explicit ZeroedArray(std::size_t size)
      : values_(static_cast<T*>(zeroedMemory(size, sizeof(T))), Free{size * sizeof(T)}),
        size_(size) {}

  std::size_t size() const { return size_; }
  const T& operator[](std::size_t index) const { return values_.get()[index]; }
  T& operator[](std::size_t index) { return values_.get()[index]; }
  void clear() { std::fill_n(values_.get(), size_, T()); }

 private:
  struct Free {
    std::size_t bytes = 0;
    void operator()(T* values) const { freeZeroedMemory(values, bytes); }
  };
  std::unique_ptr<T, Free> values_;
  std::size_t size_ = 0;
};

}  // namespace grid_path_planner::base
