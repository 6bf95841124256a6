// How much memory this process may take: what defaults of memory limits are made of.
#pragma once

#include <cstddef>
#include <string>

namespace grid_path_planner::base {

// In bytes, now: MemAvailable of the machine, the limits of the process's control groups (versions 1
// and 2) and of its address space (ulimit -v), the least of them; the largest number where the
// system tells none. `root` stands before the names of the system's files, for tests.
std::size_t availableMemory(const std::string& root = "");

// Half of what was available when this was called first: at the start, where a main program or a
// node's constructor calls it. The other half is for the rest of the process and for other ones.
std::size_t halfOfAvailableMemory();

}  // namespace grid_path_planner::base
