// Decoders of image files, one a format. image_file.cpp chooses by the first bytes of a file.
//
// Each gives what cv::imdecode(..., IMREAD_UNCHANGED) gives of the same bytes: the pixels by rows
// from the top, in 1, 3 or 4 channels, of which the fourth is alpha; but always in 8 bits a
// channel, scaled so that white is 255. The order of the colours is not defined.
//
// Guaranteed: bytes that are no such image throw InputError naming `file`, and nothing is printed;
// PNG, JPEG, PNM and uncompressed BMP files that end early are refused, PNG files with a damaged
// byte too; `limits` are asked before memory is taken for pixels, and those of PNG and JPEG between
// some rows. Not noticed: damage inside the pixels of the formats without checksums, where the file
// could be whole.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::grid {

struct ImageLimits {
  // Told the width and height that an image's header gives. Throws InputError to refuse the image.
  std::function<void(int width, int height)> checkSize;
  // Of which the memory of the pixels is taken, and that of the decoder where it grows with them.
  base::ReadLimits& limits;
};

cv::Mat decodePng(const std::string& content, const std::string& file, const ImageLimits& limits);
cv::Mat decodeJpeg(const std::string& content, const std::string& file, const ImageLimits& limits);
// PBM, PGM and PPM, as text and binary. Bytes behind the pixels do not matter.
cv::Mat decodePnm(const std::string& content, const std::string& file, const ImageLimits& limits);
cv::Mat decodeBmp(const std::string& content, const std::string& file, const ImageLimits& limits);
// Compressed by PackBits, LZW, Deflate, JPEG, or as a fax; not BigTIFF. OpenCV prints errors of its own.
cv::Mat decodeTiff(const std::string& content, const std::string& file, const ImageLimits& limits);
// What the two before have in common. Whoever calls it knows the size.
cv::Mat decodeWithOpenCv(const std::string& content, const std::string& file);

// The bytes of so many channels of pixels.
inline std::size_t bytesOfPixels(int width, int height, std::size_t channels) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels;
}

[[noreturn]] void refuseImage(const std::string& file, const std::string& reason);
[[noreturn]] void refuseEarlyEnd(const std::string& file, std::size_t size);
// Of an image whose pixels no `size` bytes can hold, however well they are compressed.
[[noreturn]] void refuseTooManyPixels(const std::string& file, int width, int height,
                                      std::size_t size);

}  // namespace grid_path_planner::grid
