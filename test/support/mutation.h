// Damaged copies of a good file, for the law that no reader crashes on one.
#pragma once

#include <random>
#include <string>

namespace grid_path_planner::test {

// `content` with one to four random injuries: bytes changed, put in or taken out, a piece repeated,
// digits replaced by others, the end cut off.
std::string mutated(const std::string& content, std::mt19937& random);

}  // namespace grid_path_planner::test
