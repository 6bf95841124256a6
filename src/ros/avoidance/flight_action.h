// The action `navigate_path` of local_planner: its goals are flown instead of what the topics say.
//
//   const FlightAction::Callbacks callbacks;
//   FlightAction action(nh, files, callbacks);
//   action.report(answer, pose);     // with every answer of the pilot
//
// A path is flown along as that of the topic; the waypoints of a file are flown to one after the other. A
// new goal replaces the one before. Files are read in a thread of their own.
#pragma once

#include <ros/node_handle.h>

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/path/path.h"
#include "ros/guard/node_files.h"
#include "ros/messages/navigate_path_action.h"

namespace grid_path_planner::nodes {

class FlightAction {
 public:
  // What the node does for it.
  struct Callbacks {
    // Returns it in the map's frame. `handovers`: as handovers() said when it was given. Throws InputError,
    // TransformError.
    std::function<path::Path(const path::Path&, bool along, unsigned handovers)> fly;
    std::function<unsigned()> handovers;
    std::function<void(const std::string& reason)> cancel;
    std::function<path::Path(const nav_msgs::Path&)> read;  // throws InputError
  };

  FlightAction(const ros::NodeHandle& nh, const NodeFiles& files, Callbacks callbacks);
  ~FlightAction();

  bool isActive() const { return active_; }
  // Ends a goal whose file is still read. Returns whether there was one.
  bool cancelReading(const std::string& reason);
  // Feedback, and the result once the flight has ended.
  void report(const avoidance::PilotAnswer& answer, const avoidance::VehiclePose& at);

 private:
  void onGoal();
  void onPreempt();
  void readFile(const std::string& filename);
  void start(const std::function<path::Path()>& read, bool along, unsigned handovers);
  void finish(avoidance::PilotStatus status, const std::string& message);
  void refuse(const std::string& message);
  NavigatePathResult endedWith(const std::string& status, const std::string& message);
  void giveFeedback(const avoidance::PilotAnswer& answer);
  double remaining(std::size_t waypoint) const;

  ros::NodeHandle nh_;
  NodeFiles files_;
  Callbacks callbacks_;
  bool active_ = false;
  bool is_read_ = false;  // its file, still
  unsigned goals_ = 0;    // accepted so far
  path::Path flown_;
  avoidance::VehiclePose at_;
  ros::SteadyTime told_;
  NavigatePathServer server_;
  base::TaskQueue reader_;
};

}  // namespace grid_path_planner::nodes
