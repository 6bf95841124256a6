#include <map_msgs/OccupancyGridUpdate.h>
#include <rosbag/bag.h>

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/planning/record/recorded_plans.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfRecordings() {
  const auto map = std::make_shared<const grid::OccupancyGrid>(grid::GridGeometry(4, 3, 0.5), 0);
  nodes::PlanQuestion question;
  question.request.goal.position = {1.2, 1.2, 0.0};
  planning::PathPlanner planner(question.options);
  planner.setMap(map);
  const planning::Plan plan = planning::planThrough(planner, question.request).plan;
  PlanRecord record = nodes::recordOf(question, *map, plan, plan.path);
  record.map_topic = "projected_map";
  record.updates_topic = "projected_map_updates";
  map_msgs::OccupancyGridUpdate update;
  update.width = update.height = 1;
  update.data = {0};
  const test::TemporaryFolder folder;
  rosbag::Bag bag(folder.path("fuzz.bag"), rosbag::bagmode::Write);
  bag.write("projected_map", ros::Time(1, 0),
            nodes::occupancyToMessage(*map, "map", ros::Time(0, 0)));
  bag.write("projected_map_updates", ros::Time(2, 0), update);
  bag.write("plan_record", ros::Time(3, 0), record);
  bag.close();
  return {test::contentOf(folder.path("fuzz.bag"))};
}

FUZZ_TARGET(recording, seedsOfRecordings) {
  const std::string file = fileOf("fuzz.bag", input);
  mayRefuse([&] {
    const nodes::Recording recording = nodes::readRecording(file, smallLimits());
    for (const PlanRecord& record : recording.plans) mayRefuse([&] { nodes::questionOf(record); });
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
