#include "grid/formats/image_formats.h"

#include <opencv2/imgcodecs.hpp>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::grid {

using base::InputError;

void refuseImage(const std::string& file, const std::string& reason) {
  throw InputError(file, "is not an image that can be read: " + reason);
}

void refuseEarlyEnd(const std::string& file, std::size_t size) {
  refuseImage(file, "it ends early, after " + std::to_string(size) + " bytes");
}

void refuseTooManyPixels(const std::string& file, int width, int height, std::size_t size) {
  refuseImage(file, "its " + std::to_string(size) + " bytes cannot hold the " +
                        std::to_string(width) + "x" + std::to_string(height) +
                        " pixels of its header");
}

cv::Mat decodeWithOpenCv(const std::string& content, const std::string& file) {
  cv::Mat image;
  try {
    const cv::Mat bytes(1, static_cast<int>(content.size()), CV_8UC1,
                        const_cast<char*>(content.data()));
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    refuseImage(file, error.err);
  }
  if (image.empty()) throw InputError(file, "is not an image that can be read");
  if (image.depth() != CV_8U && image.depth() != CV_16U)
    throw InputError(file, "must be an image of 8 or 16 bits a channel");
  if (image.depth() == CV_16U) image.convertTo(image, CV_8U, 255.0 / 65535);
  return image;
}

}  // namespace grid_path_planner::grid
