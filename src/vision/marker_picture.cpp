#include "vision/marker_picture.h"

#include <opencv2/imgproc.hpp>
#include <string>

namespace grid_path_planner::vision {
namespace {

const cv::Scalar kUsed(0, 255, 0), kUnknown(255, 0, 0), kText(255, 255, 0);

cv::Point pixelOf(const Eigen::Vector2d& corner) {
  return {cvRound(corner.x()), cvRound(corner.y())};
}

void draw(const DetectedMarker& marker, const cv::Scalar& colour, cv::Mat& picture) {
  for (int i = 0; i < 4; ++i)
    cv::line(picture, pixelOf(marker.corners[i]), pixelOf(marker.corners[(i + 1) % 4]), colour, 2);
  cv::putText(picture, std::to_string(marker.id), pixelOf(marker.corners[0]),
              cv::FONT_HERSHEY_SIMPLEX, 0.6, kText, 2);
}

}  // namespace

std::vector<std::uint8_t> markerPicture(const GreyImage& image,
                                        const std::vector<DetectedMarker>& markers,
                                        const MarkerLayout& layout, const MarkerFix& fix) {
  std::vector<std::uint8_t> pixels(3 * static_cast<std::size_t>(image.width) * image.height);
  const cv::Mat grey(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels),
                     image.row_step);  // only read
  cv::Mat picture(image.height, image.width, CV_8UC3, pixels.data());
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2RGB);
  for (const DetectedMarker& marker : markers)
    draw(marker, layout.has(marker.id) ? kUsed : kUnknown, picture);
  cv::putText(picture, fix.reason, {4, image.height - 8}, cv::FONT_HERSHEY_SIMPLEX, 0.4, kText);
  return pixels;
}

}  // namespace grid_path_planner::vision
