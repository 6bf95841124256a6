// Tools of rviz that set the panel's points: press where the point is, drag to where the vehicle
// looks, as with 2D Nav Goal. Each publishes a geometry_msgs/PoseStamped in the view's fixed frame.
//
//   PlanGoal     plan_panel/goal
//   ViaPoint     plan_panel/via_point
//   PlanStart    plan_panel/start
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <rviz/default_plugin/tools/pose_tool.h>

#include <string>

namespace grid_path_planner::nodes {

class PointTool : public rviz::PoseTool {
 public:
  PointTool(const std::string& topic, char shortcut);

 protected:
  void onPoseSet(double x, double y, double theta) override;

 private:
  ros::NodeHandle nh_;
  ros::Publisher publisher_;
};

class PlanGoalTool : public PointTool {
 public:
  PlanGoalTool() : PointTool("plan_panel/goal", 'a') {}
};

class ViaPointTool : public PointTool {
 public:
  ViaPointTool() : PointTool("plan_panel/via_point", 'v') {}
};

class PlanStartTool : public PointTool {
 public:
  PlanStartTool() : PointTool("plan_panel/start", 'b') {}
};

}  // namespace grid_path_planner::nodes
