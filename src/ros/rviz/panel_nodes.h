// The topics by which the panel talks with one path_planner and one navigate_path.
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <ros/node_handle.h>
#include <std_msgs/String.h>

#include <functional>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/PlanPathAction.h"
#include "grid_path_planner/PlanStatistics.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/rviz/action_link.h"

namespace grid_path_planner::nodes {

class PanelNodes {
 public:
  // What the panel does with what comes.
  struct Heard {
    std::function<void(const dynamic_reconfigure::Config&)> parameters;
    std::function<void(const std::string& reason)> refused;
    std::function<void(const PlanStatistics&)> plan;
  };

  // `nh` has the nodes' namespace; what comes is called in its queue.
  PanelNodes(ros::NodeHandle nh, Heard heard)
      : plan(nh, "plan_path"),
        drive(nh, "navigate_path"),
        nh_(nh),
        parameters_(subscribeChecked<dynamic_reconfigure::Config>(
            nh, "path_planner/parameter_updates", 10,
            [heard](const dynamic_reconfigure::Config& m) { heard.parameters(m); })),
        refused_(subscribeChecked<std_msgs::String>(
            nh, "path_planner/parameter_refused", 10,
            [heard](const std_msgs::String& m) { heard.refused(m.data); })),
        plans_(subscribeChecked<PlanStatistics>(
            nh, "plan_statistics", 10, [heard](const PlanStatistics& m) { heard.plan(m); })) {}

  const ros::NodeHandle& nh() const { return nh_; }

  ActionLink<PlanPathAction> plan;
  ActionLink<NavigatePathAction> drive;

 private:
  ros::NodeHandle nh_;
  ros::Subscriber parameters_, refused_, plans_;
};

}  // namespace grid_path_planner::nodes
