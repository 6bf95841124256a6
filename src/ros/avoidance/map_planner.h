// Plans on the map of what was seen, in a thread of its own, for a pilot that makes no progress.
//
//   MapPlanner map;
//   map.see(frame, options);                       // every frame
//   pilot.setMapPlan([&](const auto& from, const auto& goal) { return map.plan(from, goal); });
//
// Guaranteed: no call waits for a map or a plan. Needs the component `mapping`: isBuilt().
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/avoidance/frame.h"
#include "grid_path_planner/avoidance/pilot_options.h"

namespace grid_path_planner::nodes {

class MapPlanner {
 public:
  static bool isBuilt();

  MapPlanner();
  // Gives up what is planned.
  ~MapPlanner();

  // Takes two frames a second of each sensor, and fewer while it cannot keep up.
  void see(const avoidance::Frame& frame, const avoidance::PilotOptions& options);
  void forget();

  // None while it is planned; the answer is given once, and the next question is another.
  std::optional<std::vector<Eigen::Vector3d>> plan(const Eigen::Vector3d& from,
                                                   const Eigen::Vector3d& goal);
  // What was asked for is of no use any more: another flight begins.
  void dropPlan();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace grid_path_planner::nodes
