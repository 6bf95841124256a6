// Whether an image file is whole, told before it is decoded: the decoders print errors of their own
// on the standard error, name no file, and make a picture of half a JPEG without a word.
//
// Guaranteed to be refused: PNG, JPEG, PBM, PGM, PPM and uncompressed BMP files that end early, and
// PNG files with a damaged byte. Not noticed: damage inside the pixels of the other formats, which
// have no checksums.
#pragma once

#include <string>

namespace grid_path_planner {

// Throws InputError naming `file`, whose bytes are `content`, and what is missing or damaged.
// Formats that it does not know are left to the decoder.
void checkImageIsWhole(const std::string& content, const std::string& file);

}  // namespace grid_path_planner
