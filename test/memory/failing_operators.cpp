#include "memory/failing_operators.h"

#include <cstdlib>
#include <new>

namespace grid_path_planner::test {
namespace {

void* allocated(std::size_t bytes) {
  void* const memory = allocationFails(bytes) ? nullptr : std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace
}  // namespace grid_path_planner::test

void* operator new(std::size_t bytes) {
  return grid_path_planner::test::allocated(bytes);
}

void* operator new[](std::size_t bytes) {
  return operator new(bytes);
}

// Theirs, too: a sanitizer's own would hand out memory that the delete below gives to free().
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void* operator new[](std::size_t bytes, const std::nothrow_t& none) noexcept {
  return operator new(bytes, none);
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete[](void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
