#include "ros/planning/record/plan_recorder.h"

namespace grid_path_planner::nodes {

PlanRecorder::PlanRecorder(ros::NodeHandle nh)
    : map_topic_(nh.resolveName("projected_map")),
      updates_topic_(nh.resolveName("projected_map_updates")),
      publisher_(nh.advertise<PlanRecord>("plan_record", 100)) {}

void PlanRecorder::publish(PlanRecord record, Asked asked) const {
  record.header.stamp = ros::Time::now();
  record.map_topic = map_topic_;
  record.updates_topic = updates_topic_;
  record.question = asked == Asked::BY_QUESTION;
  publisher_.publish(record);
}

}  // namespace grid_path_planner::nodes
