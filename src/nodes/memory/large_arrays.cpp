// What a node asks for by `new T[n]`, as roscpp does for what it receives and sends: large ones come by huge pages.
#include <cstddef>
#include <new>

#include "ros/guard/process/huge_pages.h"

namespace grid_path_planner::nodes {
namespace {

void* newArray(std::size_t bytes) {
  void* const memory = ::operator new(bytes);
  adviseHugePages(memory, bytes);
  return memory;
}

}  // namespace
}  // namespace grid_path_planner::nodes

void* operator new[](std::size_t bytes) {
  return grid_path_planner::nodes::newArray(bytes);
}

void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return grid_path_planner::nodes::newArray(bytes);
  } catch (...) {
    return nullptr;
  }
}

void operator delete[](void* memory) noexcept {
  ::operator delete(memory);
}

void operator delete[](void* memory, std::size_t) noexcept {
  ::operator delete(memory);
}

void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  ::operator delete(memory);
}
