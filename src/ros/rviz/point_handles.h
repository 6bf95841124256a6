// Start, via-points and goal as handles in the view, which are dragged, and turned by their rings.
// The function that is given gets every point that is dragged or turned.
#pragma once

#include <interactive_markers/interactive_marker_server.h>

#include <functional>
#include <map>
#include <string>

#include "panel/route_points.h"

namespace grid_path_planner::nodes {

class PointHandles {
 public:
  using Moved =
      std::function<void(panel::RoutePoints::Id, const std::string& frame, const path::Pose&)>;

  // `topic` is of the interactive markers. `moved` is called in the thread that serves ROS's global
  // queue, in rviz that of its window.
  PointHandles(const std::string& topic, Moved moved);

  // Sends what differs from what is shown.
  void show(const panel::RoutePoints& points);

 private:
  struct Handle {
    panel::RoutePoints::Id id;
    std::string frame;
    path::Pose pose;
  };
  using Handles = std::map<std::string, Handle>;

  static Handles handlesOf(const panel::RoutePoints& points);
  void insert(const std::string& name, const Handle& handle);
  void onFeedback(const visualization_msgs::InteractiveMarkerFeedback& feedback);

  Moved moved_;
  Handles shown_;
  interactive_markers::InteractiveMarkerServer server_;
};

}  // namespace grid_path_planner::nodes
