// The latched topics of path_planner that tell of plans.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <mutex>
#include <optional>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/planning/plan.h"
#include "ros/planning/shown/plan_markers.h"

namespace grid_path_planner::nodes {

// Without a stamp, and without what the request says and the clearance.
PlanStatistics statisticsMessage(const planning::Plan& plan);

class PlanPublisher {
 public:
  explicit PlanPublisher(ros::NodeHandle nh);

  // `path`: empty but with frame and stamp unless found. Its last pose is stamped with when the goal was
  // given, by which a driver knows whether it is planned again for one that it has reached.
  void publishPath(const path::Path& path, const ros::Time& goal_given);
  // `plan_statistics`, stamped now, and `search_markers`, which are made for subscribers only: one that
  // comes later gets those of the newest plan.
  void publishSearch(ShownPlan shown);
  // Whether anyone wants to see which cells a search expands.
  bool searchIsShown() const { return markers_.getNumSubscribers() > 0; }

 private:
  void showUnseenSearch();

  std::mutex mutex_;
  std::optional<ShownPlan> unseen_;  // the newest, where nobody listened
  ros::Publisher path_;
  ros::Publisher statistics_;
  ros::Publisher markers_;
};

}  // namespace grid_path_planner::nodes
