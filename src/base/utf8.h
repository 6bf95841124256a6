// Where characters of UTF-8 begin and end in text of strangers.
#pragma once

#include <cstddef>
#include <string>

namespace grid_path_planner::base {

// The number of bytes of the character that begins at byte `at`, from 1 to 4; 0 where none does: a byte that
// cannot begin one, one that is cut off, an overlong form, half of a surrogate pair, above U+10FFFF.
std::size_t characterBytes(const std::string& text, std::size_t at);

}  // namespace grid_path_planner::base
