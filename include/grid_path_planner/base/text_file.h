// Reading a whole file into memory, with a sentence for each way in which that can go wrong.
#pragma once

#include <cstddef>
#include <string>

namespace grid_path_planner {

// The bytes of `file`. Throws InputError naming the file where it does not exist, is a directory,
// cannot be read, is empty or is larger than `largest` bytes.
std::string readWholeFile(const std::string& file, std::size_t largest);

// Throws InputError naming the file and the line (from 1) where `text` holds a NUL byte or another
// control character that no text file has: a picture or a bag given by mistake.
void checkIsText(const std::string& text, const std::string& file);

}  // namespace grid_path_planner
