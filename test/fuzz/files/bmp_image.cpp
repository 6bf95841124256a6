#include "fuzz/files/fuzz_images.h"
#include "fuzz/fuzz_target.h"
#include "grid/formats/image_formats.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfBmp() {
  return {encodedPicture(".bmp", 1), encodedPicture(".bmp", 3), encodedPicture(".bmp", 4)};
}

FUZZ_TARGET(bmp_image, seedsOfBmp) {
  LimitsOfPicture picture;
  mayRefuse([&] { grid::decodeBmp(input, "fuzz.bmp", picture.limits()); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
