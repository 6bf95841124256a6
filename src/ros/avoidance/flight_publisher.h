// What local_planner publishes: commands, the path, what is near, and what it does.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "grid_path_planner/avoidance/pilot.h"

namespace grid_path_planner::nodes {

class FlightPublisher {
 public:
  explicit FlightPublisher(ros::NodeHandle& nh);

  // cmd_vel in `base_frame`, and the same in the map's frame as setpoint_velocity.
  void command(const base::BodyVelocity& velocity, double yaw, const std::string& map_frame,
               const ros::Time& stamp);
  void path(const avoidance::Pilot& pilot, const std::string& map_frame, const ros::Time& stamp);
  // Where it differs from the last one.
  void status(const avoidance::PilotAnswer& answer, const std::string& map_frame,
              const ros::Time& stamp);
  // obstacle_distance and remembered_points, where someone listens.
  void surroundings(const avoidance::Pilot& pilot, const std::string& map_frame, double yaw,
                    const std::string& base_frame, const ros::Time& stamp);
  bool anyListener() const { return velocity_.getNumSubscribers() > 0; }

 private:
  ros::Publisher velocity_, setpoint_, path_, status_, distances_, points_;
  std::string told_;
};

}  // namespace grid_path_planner::nodes
