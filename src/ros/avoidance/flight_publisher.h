// What local_planner says of its flight; what it commands: flight_commander.h, what it sees: flight_views.h.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "grid_path_planner/avoidance/pilot.h"

namespace grid_path_planner::nodes {

class FlightPublisher {
 public:
  explicit FlightPublisher(ros::NodeHandle& nh);

  void path(const avoidance::Pilot& pilot, const std::string& map_frame, const ros::Time& stamp);
  // Where it differs from the last one.
  // The status of a new flight is told, though it be that of the one before.
  void beginFlight() { told_.clear(); }
  void status(const avoidance::PilotAnswer& answer, const std::string& map_frame,
              const ros::Time& stamp);
  // setpoint_trajectory, where someone listens: from where the vehicle is along the open part of the path,
  // with a stand at its end.
  void trajectory(const avoidance::Pilot& pilot, const avoidance::PilotAnswer& answer,
                  const avoidance::VehiclePose& at, const std::string& map_frame,
                  const std::string& base_frame, const ros::Time& stamp);

 private:
  ros::Publisher trajectory_, path_, status_;
  std::string told_;
};

}  // namespace grid_path_planner::nodes
