// What a node with the option memory_limit says of it when it starts.
//
//   const std::string line = memoryLimitLine("Planning", 500, 500000000);
//
// "Planning may take 500 MB (memory_limit)", or of a limit of 0 "(memory_limit is 0: half of what was available at the start)".
#pragma once

#include <cstddef>
#include <string>

namespace grid_path_planner::nodes {

// `megabytes` is the option, of which `bytes` was made.
std::string memoryLimitLine(const std::string& what, int megabytes, std::size_t bytes);

}  // namespace grid_path_planner::nodes
