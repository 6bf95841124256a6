// A planner plugin that is given a costmap_2d: what is left to the plugins is the signature of their
// framework. Only they include this, as costmap_2d is there for them only.
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/Point.h>
#include <ros/console.h>

#include <boost/thread/locks.hpp>
#include <memory>
#include <optional>
#include <pluginlib/exceptions.hpp>
#include <string>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "ros/adapters/planner_adapter.h"

namespace grid_path_planner::nodes {

class PluginAdapter {
 public:
  // Throws pluginlib::PluginlibException, which ends move_base with its sentence, where a parameter in
  // the namespace ~name cannot be used. A second call is passed over with a warning.
  void initialize(const std::string& name, costmap_2d::Costmap2DROS* costmap) {
    if (adapter_) {
      ROS_WARN_STREAM(name << " is initialized already");
      return;
    }
    try {
      adapter_ = std::make_unique<PlannerAdapter>(ros::NodeHandle("~/" + name),
                                                  costmap->getGlobalFrameID());
    } catch (const base::InputError& error) {
      throw pluginlib::CreateClassException(error.what());
    }
    costmap_ = costmap;
  }

  // As PlannerAdapter's; NO_MAP before initialize().
  PlannerAdapter::Answer makePlan(const geometry_msgs::PoseStamped& start,
                                  const geometry_msgs::PoseStamped& goal,
                                  std::optional<double> tolerance) {
    if (!adapter_) {
      ROS_ERROR_STREAM(kNotInitialized);
      return {base::Status::NO_MAP, kNotInitialized, 0.0, {}};
    }
    return adapter_->makePlan(start, goal, tolerance, [this](planning::CostPlanner& planner) {
      giveCosts(*costmap_, planner);
    });
  }

  // Whether there is something that could be cancelled.
  bool cancel() {
    if (adapter_) adapter_->cancel();
    return adapter_ != nullptr;
  }

 private:
  static constexpr char kNotInitialized[] = "initialize() of the planner has not been called";

  // Holds the costmap's mutex while costs are compared and copied, not while they are planned on.
  // Throws InputError for a costmap without cells, as it is before its first map.
  static void giveCosts(costmap_2d::Costmap2DROS& costmap_ros, planning::CostPlanner& planner) {
    costmap_2d::Costmap2D& costmap = *costmap_ros.getCostmap();
    const boost::unique_lock<costmap_2d::Costmap2D::mutex_t> lock(*costmap.getMutex());
    const unsigned int width = costmap.getSizeInCellsX(), height = costmap.getSizeInCellsY();
    if (width == 0 || height == 0) throw base::InputError("the costmap has no cells yet");
    const grid::GridGeometry geometry(static_cast<int>(width), static_cast<int>(height),
                                      costmap.getResolution(),
                                      {costmap.getOriginX(), costmap.getOriginY(), 0.0});
    planner.setCosts(geometry, costmap.getCharMap(),
                     costmap_ros.getLayeredCostmap()->getInscribedRadius());
    if (planner.options().use_footprint) planner.setFootprint(footprintOf(costmap_ros));
  }

  // Padded: that of which costmap_2d takes the inscribed radius, and by which local planners judge. costmap_2d
  // guards it by no mutex: they read it so, too.
  static std::vector<Eigen::Vector2d> footprintOf(const costmap_2d::Costmap2DROS& costmap_ros) {
    std::vector<Eigen::Vector2d> corners;
    for (const geometry_msgs::Point& corner : costmap_ros.getRobotFootprint())
      corners.emplace_back(corner.x, corner.y);
    return corners;
  }

  costmap_2d::Costmap2DROS* costmap_ = nullptr;
  std::unique_ptr<PlannerAdapter> adapter_;
};

}  // namespace grid_path_planner::nodes
