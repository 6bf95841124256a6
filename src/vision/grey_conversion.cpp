#include "vision/grey_conversion.h"

#include <opencv2/imgproc.hpp>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::vision {

using base::InputError;

namespace {

constexpr std::uint32_t kLargestSide = 8192;  // pixels
constexpr int kNotBayer = -1;

struct Encoding {
  const char* name;
  std::uint32_t bytes;   // of a pixel
  int red, green, blue;  // which of them
  int bayer =
      kNotBayer;  // OpenCV's code, whose names are those of the second row's second and third pixel
};

constexpr Encoding kEncodings[] = {{"mono8", 1, 0, 0, 0},
                                   {"8UC1", 1, 0, 0, 0},
                                   {"rgb8", 3, 0, 1, 2},
                                   {"bgr8", 3, 2, 1, 0},
                                   {"rgba8", 4, 0, 1, 2},
                                   {"bgra8", 4, 2, 1, 0},
                                   {"bayer_rggb8", 1, 0, 0, 0, cv::COLOR_BayerBG2GRAY},
                                   {"bayer_bggr8", 1, 0, 0, 0, cv::COLOR_BayerRG2GRAY},
                                   {"bayer_gbrg8", 1, 0, 0, 0, cv::COLOR_BayerGR2GRAY},
                                   {"bayer_grbg8", 1, 0, 0, 0, cv::COLOR_BayerGB2GRAY}};

Encoding encodingOf(const EncodedImage& image) {
  if (image.encoding == "mono16") {  // of which the higher byte
    const int high = image.big_endian ? 0 : 1;
    return {"mono16", 2, high, high, high};
  }
  for (const Encoding& known : kEncodings)
    if (image.encoding == known.name) return known;
  throw InputError(
      "its encoding must be mono8, mono16, rgb8, bgr8, rgba8, bgra8 or an 8-bit bayer_");
}

std::string sizeOf(const EncodedImage& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels";
}

void checkSizes(const EncodedImage& image, const Encoding& encoding) {
  if (image.width == 0 || image.height == 0) throw InputError("it has " + sizeOf(image));
  if (image.width > kLargestSide || image.height > kLargestSide)
    throw InputError("it has " + sizeOf(image) + ", more than " + std::to_string(kLargestSide) +
                     " in a row or column");
  if (image.step < image.width * encoding.bytes)
    throw InputError("its rows have " + std::to_string(image.step) + " bytes, " +
                     std::to_string(image.width) + " pixels of " + image.encoding + " take " +
                     std::to_string(image.width * encoding.bytes));
  const std::size_t rows = static_cast<std::size_t>(image.step) * image.height;
  if (image.size != rows)
    throw InputError("it has " + std::to_string(image.size) + " bytes, its rows take " +
                     std::to_string(rows));
}

std::vector<std::uint8_t> withoutBayer(const EncodedImage& image, int code) {
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(image.width) * image.height);
  const int rows = static_cast<int>(image.height), columns = static_cast<int>(image.width);
  const cv::Mat raw(rows, columns, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                    image.step);  // only read
  cv::Mat converted(rows, columns, CV_8UC1, grey.data());
  cv::cvtColor(raw, converted, code);
  return grey;
}

}  // namespace

std::vector<std::uint8_t> greyPixels(const EncodedImage& image) {
  const Encoding encoding = encodingOf(image);
  checkSizes(image, encoding);
  if (encoding.bayer != kNotBayer) return withoutBayer(image, encoding.bayer);
  std::vector<std::uint8_t> grey;
  grey.reserve(static_cast<std::size_t>(image.width) * image.height);
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const std::uint8_t* pixel = image.data + static_cast<std::size_t>(row) * image.step;
    for (std::uint32_t column = 0; column < image.width; ++column, pixel += encoding.bytes)
      grey.push_back(
          static_cast<std::uint8_t>((77 * pixel[encoding.red] + 150 * pixel[encoding.green] +
                                     29 * pixel[encoding.blue] + 128) /
                                    256));
  }
  return grey;
}

}  // namespace grid_path_planner::vision
