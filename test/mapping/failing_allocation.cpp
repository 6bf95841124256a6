#include "mapping/failing_allocation.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

thread_local int left = -1;  // allocations before the one that fails; negative: none does

void* allocated(std::size_t bytes) {
  if (left >= 0 && left-- == 0) throw std::bad_alloc();
  if (void* const memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t bytes) {
  return allocated(bytes);
}

void* operator new[](std::size_t bytes) {
  return allocated(bytes);
}

void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return allocated(bytes);
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

namespace grid_path_planner::test {

FailingAllocation::FailingAllocation(int number) {
  left = number - 1;
}

FailingAllocation::~FailingAllocation() {
  left = -1;
}

bool FailingAllocation::happened() const {
  return left < 0;
}

}  // namespace grid_path_planner::test
