#include "fuzz/files/fuzz_images.h"
#include "fuzz/fuzz_target.h"
#include "grid/formats/image_formats.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfPnm() {
  return {encodedPicture(".pgm", 1), encodedPicture(".ppm", 3),           encodedPicture(".pbm", 1),
          "P1\n3 2\n101011",         "P2\n# a comment\n2 2 9\n0 1 8 9\n", "P3 1 1 255 1 2 3",
          "P5 1 2 65535\n1234"};
}

FUZZ_TARGET(pnm_image, seedsOfPnm) {
  LimitsOfPicture picture;
  mayRefuse([&] { grid::decodePnm(input, "fuzz.pgm", picture.limits()); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
