// What rviz loads: rviz_plugins.xml names the same classes.
#include <pluginlib/class_list_macros.hpp>

#include "ros/rviz/plan_panel.h"
#include "ros/rviz/point_tools.h"

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::PlanPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::PlanGoalTool, rviz::Tool)
PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::ViaPointTool, rviz::Tool)
PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::PlanStartTool, rviz::Tool)

namespace grid_path_planner {}
