#include "ros/common/process/freed_memory.h"

#include <malloc.h>

namespace grid_path_planner::nodes {

void returnFreedMemory() {
#ifdef M_MMAP_THRESHOLD
  constexpr int kLargeBlock = 8 << 20;
  ::mallopt(M_MMAP_THRESHOLD, kLargeBlock);
  // Else 128 kB now: the memory of each cloud would go back, and come again with the next.
  ::mallopt(M_TRIM_THRESHOLD, kLargeBlock);
#endif
}

}  // namespace grid_path_planner::nodes
