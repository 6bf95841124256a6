#include "ros/guard/process/freed_memory.h"

#include <malloc.h>

#include "ros/guard/process/huge_pages.h"

namespace grid_path_planner::nodes {

void returnFreedMemory() {
#ifdef M_MMAP_THRESHOLD
  constexpr int kLeast = kLargeBlock;  // bytes
  ::mallopt(M_MMAP_THRESHOLD, kLeast);
  // Else 128 kB now: the memory of each cloud would go back, and come again with the next.
  ::mallopt(M_TRIM_THRESHOLD, kLeast);
#endif
}

}  // namespace grid_path_planner::nodes
