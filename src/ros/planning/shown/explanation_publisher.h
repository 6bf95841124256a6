// Shows why there is no path, as latched markers on `explanation_markers`: the gap as a disc as wide as
// it is, with its sentence, and the place nearest the goal that can be reached.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <atomic>
#include <string>

#include "planning/explanation.h"

namespace grid_path_planner::nodes {

// Any thread may call.
class ExplanationPublisher {
 public:
  explicit ExplanationPublisher(ros::NodeHandle nh);

  void publish(const planning::Explanation& explanation, const std::string& frame);
  // Removes what is shown.
  void clear();

 private:
  ros::Publisher publisher_;
  std::atomic<bool> shown_{false};
};

}  // namespace grid_path_planner::nodes
