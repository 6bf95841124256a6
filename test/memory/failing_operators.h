// operator new that fails where whoever links failing_operators.cpp says so.
#pragma once

#include <cstddef>

namespace grid_path_planner::test {

// Whether this allocation throws std::bad_alloc. Defined by the program; in it, nothing is allocated by operator new.
bool allocationFails(std::size_t bytes);

}  // namespace grid_path_planner::test
