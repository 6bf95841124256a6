// What a real rosbag records beside a running path_planner is planned again, to the bit.
#include <dynamic_reconfigure/Reconfigure.h>
#include <unistd.h>

#include <random>

#include "grid_path_planner/ComparePlans.h"
#include "grid_path_planner/PlanRecord.h"
#include "ros/guard/master/xmlrpc_call.h"
#include "ros/support/links.h"
#include "ros/support/planner_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using test::poseAt;
using test::Process;

constexpr int kRecordedSide = 90;

// Whether the planner has somebody at the other end of the topic beside this test.
bool isRecorded(const std::string& topic) {
  return test::linksOf(uriOfNode("/path_planner", 1.0), topic, "o") > 1;
}

class ReplayTest : public test::PlannerTest {
 protected:
  ReplayTest() {
    startPlanner({"_radius:=1.2", "_decay:=0.4"});
    recorder_ = std::make_unique<Process>(std::vector<std::string>{
        "rosbag", "record", "-O", file_, "plan_record", "projected_map", "projected_map_updates"});
    EXPECT_TRUE(test::waitFor([&] {
      return records_.connected() && maps_.getNumSubscribers() > 1 &&
             updates_.getNumSubscribers() > 1 && isRecorded("/plan_record");
    })) << "rosbag did not come up";
  }

  // Sets a rectangle of the map to one value, and waits until the planner has that.
  void edit() {
    std::uniform_int_distribution<int> corner(20, kRecordedSide - 30), side(1, 8);
    map_msgs::OccupancyGridUpdate update;
    update.header.frame_id = "map";
    update.header.stamp = ros::Time::now();
    update.x = corner(random_);
    update.y = corner(random_);
    update.width = static_cast<std::uint32_t>(side(random_));
    update.height = static_cast<std::uint32_t>(side(random_));
    update.data.assign(update.width * update.height, random_() % 3 == 0 ? 0 : 100);
    const std::size_t seen = shown_.count() + planning_maps_.count();
    updates_.publish(update);
    test::waitFor([&] { return shown_.count() + planning_maps_.count() > seen; },
                  std::chrono::seconds(1));  // a planning map is as it was where nothing changed
  }

  void compare(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal) {
    ComparePlans call;
    call.request.start = start;
    call.request.goal = goal;
    call.request.planners = {"weighted_jump_point", "lazy_theta_star", "dijkstra"};
    ASSERT_TRUE(ros::service::call("/path_planner/compare_plans", call));
  }

  void setRadius(double radius) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.doubles.resize(1);
    call.request.config.doubles[0].name = "radius";
    call.request.config.doubles[0].value = radius;
    ASSERT_TRUE(ros::service::call("/path_planner/set_parameters", call));
  }

  // rosbag leaves its recorder a quarter of a second to end, and ends itself then. The file has its name once
  // it is whole.
  void endRecorder() {
    recorder_->end(SIGINT);
    ASSERT_TRUE(test::waitFor([&] { return ::access(file_.c_str(), R_OK) == 0; }))
        << "rosbag's recorder did not end";
  }

  const test::TemporaryFolder folder_;
  const std::string file_ = folder_.path("plans.bag");
  std::mt19937 random_{1723};
  test::Latest<PlanRecord> records_{nh_, "plan_record"};
  test::Latest<map_msgs::OccupancyGridUpdate> shown_{nh_, "planning_map_updates"};
  std::unique_ptr<Process> recorder_;
};

TEST_F(ReplayTest, EveryRecordedPlanIsIdentical) {
  OccupancyGrid map(GridGeometry(kRecordedSide, kRecordedSide, 0.25, {-3.0, 2.0, 0.0}), 0);
  for (int row = 10; row < kRecordedSide - 10; ++row) map[Cell{45, row}] = -1;
  publishMap(map);
  placeVehicle(-1.1, 3.3);
  for (int step = 0; step < 8; ++step) {
    edit();
    sendGoal(poseAt(18.3 - 0.1 * step, 23.1, 0.3 * step));
    compare(poseAt(-2.2 + 0.7 * step, 4.0, 1.0), poseAt(17.0, 22.2 - step, 2.0));
    if (step == 4) setRadius(0.7);
  }
  makePlan(poseAt(0.0, 4.0), poseAt(-30.0, 0.0));
  EXPECT_EQ(answer_.status, "GOAL_OUTSIDE_MAP");
  ASSERT_GE(records_.count(), 8u * 4u + 1u);
  endRecorder();

  Process replay("grid_path", {"replay", file_});
  ASSERT_TRUE(replay.waitForExit());
  EXPECT_EQ(replay.exitCode(), 0) << replay.output();
  for (const char* planner : {"weighted_jump_point", "lazy_theta_star", "dijkstra"})
    EXPECT_TRUE(replay.hasSaid(std::string("poses, by ") + planner)) << replay.output();
}

}  // namespace
}  // namespace grid_path_planner::nodes
