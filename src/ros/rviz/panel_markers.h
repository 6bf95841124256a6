// What the panel draws into the view: its path, the paths of a comparison, why there is no path.
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "grid_path_planner/ExplainPlan.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::nodes {

struct ComparedPath {
  std::string planner;
  path::Path path;  // empty: nothing is drawn
};

// The path in blue with arrowheads along it, and of a comparison each path in its planner's colour:
// the first one widest and lowest, so that those that coincide are seen as stripes. All that was drawn
// before is removed by the first marker.
visualization_msgs::MarkerArray panelMarkers(const path::Path& path,
                                             const std::vector<ComparedPath>& compared);

// The narrowest gap as a disc as wide as it is, the nearest place in reach, and the sentence there.
// Empty where there is neither.
visualization_msgs::MarkerArray explanationMarkers(const ExplainPlan::Response& explanation,
                                                   const std::string& frame);

}  // namespace grid_path_planner::nodes
