#include "ros/guard/process/memory_limit_line.h"

#include <limits>

namespace grid_path_planner::nodes {

std::string memoryLimitLine(const std::string& what, int megabytes, std::size_t bytes) {
  const std::string origin = megabytes == 0
                                 ? "memory_limit is 0: half of what was available at the start"
                                 : "memory_limit";
  // Half of what base::availableMemory() says where the system tells none.
  if (bytes >= std::numeric_limits<std::size_t>::max() / 2)
    return what + " may take any memory (memory_limit is 0, and the system tells no limit)";
  return what + " may take " + std::to_string(bytes / 1000000) + " MB (" + origin + ")";
}

}  // namespace grid_path_planner::nodes
