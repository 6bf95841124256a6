// The map that a vehicle makes of what it sees, to plan on when its local planner makes no progress: an
// octree, projected at the vehicle's height, and the planner of planning/ on that.
//
//   map.see(frame);                              // every frame
//   const auto path = map.plan(position, goal);  // empty: none
//
// Frames are kept, thinned out, and become a map when a plan is asked for (most flights ask for none), by
// insertWaiting() or when a hundred are there. The same frames and questions give the same paths; no clock is read.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "grid_path_planner/avoidance/frame.h"
#include "grid_path_planner/avoidance/pilot_options.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/mapping/octree_map.h"

namespace grid_path_planner::seen_map {

class SeenMap {
 public:
  explicit SeenMap(const avoidance::PilotOptions& options);

  void see(const avoidance::Frame& frame);

  // Takes time in proportion to the frames that wait, some 20 ms for each.
  void insertWaiting();
  // For frames and plans from now on.
  void setOptions(const avoidance::PilotOptions& options) { options_ = options; }

  // A path at the height of `from` that keeps d_safe to what was seen, through unknown space where
  // that is shorter by far; empty where there is none, and to goals more than 300 m away.
  std::vector<Eigen::Vector3d> plan(const Eigen::Vector3d& from, const Eigen::Vector3d& goal,
                                    const base::StopSource& stop = {});

 private:
  mapping::Scan scanOf(const avoidance::Frame& frame) const;

  avoidance::PilotOptions options_;
  mapping::OctreeMap map_;
  std::vector<mapping::Scan> waiting_;
  std::map<int, double> kept_at_;  // s, of the last frame that was kept, by sensor
};

}  // namespace grid_path_planner::seen_map
