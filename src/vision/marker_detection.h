// Finds markers of the AprilTag family 36h11 in a grey image.
//
//   for (const DetectedMarker& marker : detectMarkers({pixels, 640, 480, 640}, options)) …
//
// Guaranteed: the same image gives the same
// markers, in the order of their ids; an id that was found twice is left out, since one of the two is wrong.
#pragma once

#include <vector>

#include "vision/grey_image.h"
#include "vision/marker_pose_options.h"

namespace grid_path_planner::vision {

struct DetectedMarker {
  int id = 0;
  PixelCorners corners;  // clockwise from the marker's upper left
};

std::vector<DetectedMarker> detectMarkers(const GreyImage& image, const MarkerPoseOptions& options);

}  // namespace grid_path_planner::vision
