// Images of sensor_msgs' encodings in grey, as markers are looked for.
//
//   const std::vector<std::uint8_t> grey = greyPixels(image);
//   const GreyImage view = {grey.data(), int(image.width), int(image.height), image.width};
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grid_path_planner::vision {

// As in sensor_msgs/Image; the bytes are not owned.
struct EncodedImage {
  std::string encoding;
  std::uint32_t width = 0;  // pixels
  std::uint32_t height = 0;
  std::uint32_t step = 0;  // bytes of a row
  bool big_endian = false;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;  // bytes
};

// A byte for each pixel, row by row: the brightness (ITU-R BT.601). mono8, 8UC1, mono16, rgb8, bgr8, rgba8, bgra8
// and the 8-bit Bayer patterns are known. Throws InputError for another encoding, an image without pixels or with
// more than 8192 in a row or column, rows shorter than their pixels, and data of another length than the rows'.
std::vector<std::uint8_t> greyPixels(const EncodedImage& image);

}  // namespace grid_path_planner::vision
