#include "vision/marker_detection.h"

#include <algorithm>
#include <map>
#include <opencv2/aruco.hpp>

#include "vision/corner_refinement.h"

namespace grid_path_planner::vision {
namespace {

using Quad = std::vector<cv::Point2f>;

// The plate around a tag is a square too, a cell of the tag away: 0.044 of its perimeter. Where that counts as
// near, OpenCV takes the larger of the two squares and finds no tag in it.
constexpr double kNearSquares = 0.015;

cv::Ptr<cv::aruco::DetectorParameters> parametersOf() {
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_NONE;  // done below
  parameters->minMarkerDistanceRate = kNearSquares;
  parameters->errorCorrectionRate = 1.0;  // of the dictionary's own number of bits
  return parameters;
}

// OpenCV's own says that no bit of this family may be wrong.
cv::Ptr<cv::aruco::Dictionary> dictionaryWith(int wrong_bits) {
  const auto known = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  return cv::makePtr<cv::aruco::Dictionary>(known->bytesList, known->markerSize, wrong_bits);
}

DetectedMarker markerOf(int id, const Quad& corners) {
  DetectedMarker marker{id, {}};
  for (int i = 0; i < 4; ++i) marker.corners[i] = {corners[i].x, corners[i].y};
  return marker;
}

}  // namespace

std::vector<DetectedMarker> detectMarkers(const GreyImage& image,
                                          const MarkerPoseOptions& options) {
  const cv::Mat pixels(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels),
                       image.row_step);  // only read
  std::vector<Quad> quads;
  std::vector<int> ids;
  cv::aruco::detectMarkers(pixels, dictionaryWith(options.max_wrong_bits), quads, ids,
                           parametersOf());
  std::map<int, int> times;
  for (const int id : ids) ++times[id];
  std::vector<DetectedMarker> markers;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (times[ids[i]] > 1) continue;
    const DetectedMarker marker = markerOf(ids[i], quads[i]);
    if (const auto corners = refinedCorners(image, marker.corners))
      markers.push_back({marker.id, *corners});
  }
  std::sort(markers.begin(), markers.end(),
            [](const DetectedMarker& a, const DetectedMarker& b) { return a.id < b.id; });
  return markers;
}

}  // namespace grid_path_planner::vision
