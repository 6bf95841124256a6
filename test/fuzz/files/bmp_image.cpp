#include "fuzz/files/fuzz_images.h"
#include "fuzz/fuzz_target.h"
#include "grid/formats/image_formats.h"

namespace grid_path_planner::fuzz {
namespace {

// 705 million by 1,028 million pixels of 15,677 bits: what they take overflowed 64 bits.
std::string hugeBmp() {
  std::string content = encodedPicture(".bmp", 3);
  const std::string sides("\xbb\xe0\x05\x2a\x4f\x3d\x3d\x3d\x01\x00\x3d\x3d", 12);
  return content.replace(18, sides.size(), sides);
}

std::vector<std::string> seedsOfBmp() {
  return {encodedPicture(".bmp", 1), encodedPicture(".bmp", 3), encodedPicture(".bmp", 4),
          hugeBmp()};
}

FUZZ_TARGET(bmp_image, seedsOfBmp) {
  LimitsOfPicture picture;
  mayRefuse([&] { grid::decodeBmp(input, "fuzz.bmp", picture.limits()); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
