// Seeds and limits of the targets that read images.
#pragma once

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "fuzz/fuzz_target.h"
#include "grid/formats/image_formats.h"

namespace grid_path_planner::fuzz {

// A picture of a few cells, in this format and with this many channels.
inline std::string encodedPicture(const std::string& extension, int channels,
                                  const std::vector<int>& how = {}) {
  cv::Mat picture(5, 7, CV_8UC(channels));
  for (int byte = 0; byte < 5 * 7 * channels; ++byte)
    picture.data[byte] = static_cast<unsigned char>(byte * 37);
  std::vector<unsigned char> bytes;
  cv::imencode(extension, picture, bytes, how);
  return {bytes.begin(), bytes.end()};
}

// Of which each picture that is read takes its part.
class LimitsOfPicture {
 public:
  grid::ImageLimits limits() {
    return {[](int, int) {}, limits_};
  }

 private:
  base::ReadLimits limits_ = smallLimits();
};

}  // namespace grid_path_planner::fuzz
