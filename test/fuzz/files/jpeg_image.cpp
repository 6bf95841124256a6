#include "fuzz/files/fuzz_images.h"
#include "fuzz/fuzz_target.h"
#include "grid/formats/image_formats.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfJpeg() {
  return {encodedPicture(".jpg", 1), encodedPicture(".jpg", 3),
          encodedPicture(".jpg", 3, {cv::IMWRITE_JPEG_PROGRESSIVE, 1})};
}

FUZZ_TARGET(jpeg_image, seedsOfJpeg) {
  LimitsOfPicture picture;
  mayRefuse([&] { grid::decodeJpeg(input, "fuzz.jpg", picture.limits()); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
