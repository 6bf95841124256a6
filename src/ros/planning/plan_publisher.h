// The latched topics of path_planner that tell of plans.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <mutex>
#include <optional>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/planning/plan.h"

namespace grid_path_planner::nodes {

// Without a stamp, and without what the request says and the clearance.
PlanStatistics statisticsMessage(const planning::Plan& plan);

// Namespaces "expanded" (cells; at most 50,000 of them, evenly chosen) and "waypoints"; a namespace
// without points is deleted from the display.
visualization_msgs::MarkerArray searchMarkers(const planning::Plan& plan, double cell_size,
                                              const ros::Time& stamp);

class PlanPublisher {
 public:
  explicit PlanPublisher(ros::NodeHandle nh);

  // `path`: empty but with frame and stamp unless found.
  void publishPath(const planning::Plan& plan);
  // `plan_statistics`, stamped now, and `search_markers`, which are made for subscribers only: one that
  // comes later gets those of the newest plan. `cell_size` in metres.
  void publishSearch(const planning::Plan& plan, PlanStatistics statistics, double cell_size);
  // Whether anyone wants to see which cells a search expands.
  bool searchIsShown() const { return markers_.getNumSubscribers() > 0; }

 private:
  struct Search {
    planning::Plan plan;
    double cell_size;
    ros::Time stamp;
  };

  void showUnseenSearch();

  std::mutex mutex_;
  std::optional<Search> unseen_;  // the newest search, where nobody listened
  ros::Publisher path_;
  ros::Publisher statistics_;
  ros::Publisher markers_;
};

}  // namespace grid_path_planner::nodes
