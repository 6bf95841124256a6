// An array of zeros that costs no time before it is used.
//
// The memory comes from calloc: on a large array the system maps pages of zeros when they are first
// touched, so a search that stays near its start neither waits for the rest nor occupies it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace grid_path_planner {

template <class T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>,
                "zero bytes must be a value");

 public:
  ZeroedArray() = default;
  // Throws std::bad_alloc.
  explicit ZeroedArray(std::size_t size)
      : values_(static_cast<T*>(std::calloc(size, sizeof(T)))), size_(size) {
    if (!values_ && size > 0) throw std::bad_alloc();
  }

  std::size_t size() const { return size_; }
  const T& operator[](std::size_t index) const { return values_.get()[index]; }
  T& operator[](std::size_t index) { return values_.get()[index]; }
  void clear() { std::fill_n(values_.get(), size_, T()); }

 private:
  struct Free {
    void operator()(T* values) const { std::free(values); }
  };
  std::unique_ptr<T, Free> values_;
  std::size_t size_ = 0;
};

}  // namespace grid_path_planner
