#include "ros/rviz/point_tools.h"

#include <geometry_msgs/PoseStamped.h>
#include <rviz/display_context.h>

#include "grid_path_planner/ros/conversions.h"

namespace grid_path_planner::nodes {

PointTool::PointTool(const std::string& topic, char shortcut)
    : publisher_(nh_.advertise<geometry_msgs::PoseStamped>(topic, 10)) {
  shortcut_key_ = shortcut;
}

void PointTool::onPoseSet(double x, double y, double theta) {
  path::Pose pose;
  pose.position = {x, y, 0.0};
  pose.yaw = theta;
  geometry_msgs::PoseStamped message;
  message.header.frame_id = context_->getFixedFrame().toStdString();
  message.header.stamp = ros::Time::now();
  message.pose = poseToMessage(pose);
  publisher_.publish(message);
}

}  // namespace grid_path_planner::nodes
