// What dynamic_reconfigure cannot tell a client: its service always succeeds, and answers with the old
// values where the new ones were refused. The sentence is the latched message of ~parameter_refused
// (std_msgs/String), empty again after the next request that is taken, and from the first one on a
// status of /diagnostics once a second.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/steady_timer.h>

#include <string>

namespace grid_path_planner::nodes {

// All calls in the thread of the node handle's queue.
class RefusedParameter {
 public:
  explicit RefusedParameter(const ros::NodeHandle& private_nh);

  void refuse(const std::string& sentence);
  void accept();

 private:
  void tell(const std::string& sentence);
  void publishDiagnostics();

  ros::NodeHandle private_nh_;
  std::string sentence_;  // of the last request; empty where it was taken
  ros::Publisher publisher_;
  ros::Publisher diagnostics_;
  ros::SteadyTimer timer_;
};

}  // namespace grid_path_planner::nodes
