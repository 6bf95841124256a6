// zlib's deflate over whole strings, without zlib's own frame of header and checksum.
#pragma once

#include <string>

namespace grid_path_planner::base {

// By the zlib strategy that makes it smallest.
std::string deflated(const std::string& bytes);

// Throws InputError saying what is wrong where `packed` is not one whole deflated string or unpacks
// to more than `largest` bytes.
std::string inflated(const std::string& packed, std::size_t largest);

}  // namespace grid_path_planner::base
