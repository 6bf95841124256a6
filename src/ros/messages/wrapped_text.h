// Sentences in the view of rviz, which breaks no lines by itself.
#pragma once

#include <cstddef>
#include <string>

namespace grid_path_planner::nodes {

// With line breaks in place of spaces, so that a line has at most `width` bytes; a longer word stands
// on a line of its own.
std::string wrappedText(const std::string& text, std::size_t width = 50);

}  // namespace grid_path_planner::nodes
