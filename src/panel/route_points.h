// Where a plan begins, the via-points that it passes in their order, and its goal.
//
//   RoutePoints points;
//   points.set({RoutePoints::Kind::GOAL}, "map", goal);   // "": taken; else why not
//   if (points.goal()) plan(points.start(), points.via(), *points.goal());
//
// All points are in one frame: one that comes in another frame replaces all of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::panel {

class RoutePoints {
 public:
  enum class Kind { START, VIA, GOAL };
  struct Id {
    Kind kind = Kind::GOAL;
    std::size_t index = 0;  // of a via-point, from 0
  };
  static constexpr std::size_t kMostVia = 50;

  // Each takes the point, or leaves all as it is and returns one sentence that says why: a frame
  // without a name, coordinates that are not finite or beyond 1e6 m, one via-point too many.
  std::string set(Id id, const std::string& frame, const path::Pose& pose);
  std::string addVia(const std::string& frame, const path::Pose& pose);

  void startAtVehicle() { start_.reset(); }
  void removeLastVia();
  void clear();

  const std::string& frame() const { return frame_; }
  // None: where the vehicle is.
  const std::optional<path::Pose>& start() const { return start_; }
  const std::vector<path::Pose>& via() const { return via_; }
  const std::optional<path::Pose>& goal() const { return goal_; }

 private:
  void moveTo(const std::string& frame);

  std::string frame_;
  std::optional<path::Pose> start_, goal_;
  std::vector<path::Pose> via_;
};

}  // namespace grid_path_planner::panel
