#include "base/zeroed_array.h"

#include <sys/mman.h>

#include <cstdlib>
#include <limits>
#include <new>

namespace grid_path_planner::base {
namespace {

// Below, small pages are quick to look up, and large ones would make a short query wait for zeros.
constexpr std::size_t kLargePagesFrom = std::size_t{16} << 20;

}  // namespace

void* zeroedMemory(std::size_t count, std::size_t size) {
  if (count > std::numeric_limits<std::size_t>::max() / size) throw std::bad_alloc();
  const std::size_t bytes = count * size;
  if (bytes < kLargePagesFrom) {
    void* memory = std::calloc(count, size);
    if (memory == nullptr && bytes > 0) throw std::bad_alloc();
    return memory;
  }
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: small pages are right, too
  return memory;
}

void freeZeroedMemory(void* memory, std::size_t bytes) {
  if (bytes < kLargePagesFrom)
    std::free(memory);
  else
    munmap(memory, bytes);
}

}  // namespace grid_path_planner::base
