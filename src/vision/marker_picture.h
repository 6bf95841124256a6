// The markers that were found, drawn into the image that they were found in.
#pragma once

#include <cstdint>
#include <vector>

#include "vision/marker_pose.h"

namespace grid_path_planner::vision {

// Red, green, blue of width x height pixels: the image in grey, around each marker a line, green where it is the
// layout's and else red, with its id, and at the bottom why there is no pose.
std::vector<std::uint8_t> markerPicture(const GreyImage& image,
                                        const std::vector<DetectedMarker>& markers,
                                        const MarkerLayout& layout, const MarkerFix& fix);

}  // namespace grid_path_planner::vision
