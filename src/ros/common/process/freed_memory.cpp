#include "ros/common/process/freed_memory.h"

#include <malloc.h>

namespace grid_path_planner::nodes {

void returnFreedMemory() {
#ifdef M_MMAP_THRESHOLD
  ::mallopt(M_MMAP_THRESHOLD, 8 << 20);
#endif
}

}  // namespace grid_path_planner::nodes
