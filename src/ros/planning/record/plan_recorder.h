// The topic `plan_record`: every plan with all that repeats it, for whoever records.
//
//   const PlanRecorder recorder(nh);
//   if (recorder.wanted()) recorder.publish(record, PlanRecorder::Asked::BY_GOAL);
//
// Nothing is made while nobody listens. Not latched: who comes later gets the plans that follow. Any
// thread may call.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "grid_path_planner/PlanRecord.h"

namespace grid_path_planner::nodes {

class PlanRecorder {
 public:
  enum class Asked { BY_GOAL, BY_QUESTION };

  explicit PlanRecorder(ros::NodeHandle nh);

  bool wanted() const { return publisher_.getNumSubscribers() > 0; }
  // With the stamp of now, and the names of the topics of the map.
  void publish(PlanRecord record, Asked asked) const;

 private:
  std::string map_topic_, updates_topic_;
  ros::Publisher publisher_;
};

}  // namespace grid_path_planner::nodes
