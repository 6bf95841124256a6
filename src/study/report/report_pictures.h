// The pictures of a report: a map and kernel each, with the paths of the queries drawn over it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "study/study_data.h"

namespace grid_path_planner::study {

// What the report's script draws from: {"variants": [{"name", "colour", "dash"}], "pictures":
// [{"name", "width", "height", "image", "units": [{"weights", "query", "note", "paths":
// [{"variant", "points", "text", "command"}]}]}]}. Points are in cells of the full map, y
// downwards; the image is a PNG of the map as it was searched, as a data URI. Maps of more than
// kLargestPicture blocks get no picture.
nlohmann::json pictureData(const StudyData& data);

// The corners of a run's path in cells of the full map, y downwards, to a hundredth.
std::vector<Eigen::Vector2d> cornersInPicture(const StudyRun& run,
                                              const grid::GridGeometry& geometry);

// The full map as a PNG, as a data URI.
std::string mapImage(const grid::OccupancyGrid& map, const grid::OccupancyThresholds& thresholds);

constexpr std::size_t kLargestPicture = 4u << 20;  // blocks

}  // namespace grid_path_planner::study
