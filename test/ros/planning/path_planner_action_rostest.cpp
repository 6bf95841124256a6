// The action of path_planner.
#include <actionlib/client/simple_action_client.h>

#include <atomic>

#include "grid_path_planner/PlanPathAction.h"
#include "grid_path_planner/PlanRecord.h"
#include "ros/planning/record/map_checksum.h"
#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using test::kRoom;
using test::poseAt;
using Client = actionlib::SimpleActionClient<PlanPathAction>;

class ActionTest : public test::PlannerTest {
 protected:
  void connect() {
    ASSERT_TRUE(test::waitFor([&] { return client_.isServerConnected(); }));
  }
  bool ended() {
    return test::waitFor([&] { return client_.getState().isDone(); });
  }
  PlanPathGoal goal(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                    const std::string& planner = "") {
    PlanPathGoal message;
    message.start = start;
    message.goal = goal;
    message.planner = planner;
    return message;
  }
  // Asked of lazy_theta_star, a question that takes many seconds: 9 million cells in vain. The jump
  // planners see at once that the goal is walled in.
  void publishHugeMap() {
    OccupancyGrid map(GridGeometry(3000, 3000, 1.0), 0);
    for (int row = 0; row < 3000; ++row) map[Cell{2998, row}] = 100;
    publishMap(map);
  }

  // Sends the goal, until its feedback says that the search has begun.
  bool searches(const PlanPathGoal& goal) {
    client_.sendGoal(goal, {}, {}, [this](const PlanPathFeedbackConstPtr& feedback) {
      if (feedback->phase == "searching") searching_ = true;
    });
    return test::waitFor([&] { return searching_.load(); });
  }

  std::atomic<bool> searching_{false};
  Client client_{"plan_path", false};
};

TEST_F(ActionTest, SucceedsWithThePath) {
  startPlanner();
  publishMap(kRoom);
  connect();
  client_.sendGoal(goal(poseAt(0.5, 0.5), poseAt(5.5, 2.5), "dijkstra"));
  ASSERT_TRUE(ended());
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::SUCCEEDED);
  const auto result = client_.getResult();
  EXPECT_EQ(result->status, "FOUND");
  EXPECT_EQ(result->statistics.planner, "dijkstra");
  ASSERT_FALSE(result->path.poses.empty());
  EXPECT_TRUE(endsAt(result->path.poses.back(), 5.5, 2.5));
}

TEST_F(ActionTest, PassesViaPointsInTheBestOrderAndComesBack) {
  startPlanner();
  publishMap(kRoom);
  connect();
  PlanPathGoal trip = goal(poseAt(0.5, 0.5), geometry_msgs::PoseStamped());
  trip.via_points = {poseAt(5.5, 2.5), poseAt(0.5, 2.5), poseAt(5.5, 0.5)};
  trip.via_points[0].pose.orientation.w = 0.0;  // which is not asked for
  trip.order = "best";
  trip.closed = true;
  client_.sendGoal(trip);
  ASSERT_TRUE(ended());
  const auto result = client_.getResult();
  ASSERT_EQ(result->status, "FOUND") << result->message;
  EXPECT_TRUE(result->order_exact);
  ASSERT_EQ(result->order.size(), 3u);
  EXPECT_EQ(result->order[1], 0u) << "the far corner is in the middle";
  EXPECT_TRUE(endsAt(result->path.poses.back(), 0.5, 0.5));
}

TEST_F(ActionTest, NamesTheViaPointsThatAreOccupied) {
  startPlanner();
  publishMap(kRoom);
  connect();
  PlanPathGoal trip = goal(poseAt(0.5, 0.5), poseAt(5.5, 2.5));
  trip.via_points = {poseAt(5.5, 0.5), poseAt(2.5, 1.5)};
  for (const char* order : {"", "best"}) {
    trip.order = order;
    client_.sendGoal(trip);
    ASSERT_TRUE(ended());
    EXPECT_EQ(client_.getResult()->status, "GOAL_OCCUPIED");
    EXPECT_EQ(client_.getResult()->unreachable, std::vector<std::uint32_t>{1});
    EXPECT_NE(client_.getResult()->message.find("via-point 2"), std::string::npos);
    expectStampedAndEmpty(client_.getResult()->path);
  }
  for (const char* order : {"fastest", "\x1b[2J"}) {
    trip.order = order;
    client_.sendGoal(trip);
    ASSERT_TRUE(ended());
    EXPECT_EQ(client_.getResult()->status, "INVALID_REQUEST");
  }
  trip.order = "";
  trip.closed = true;
  client_.sendGoal(trip);
  ASSERT_TRUE(ended());
  EXPECT_NE(client_.getResult()->message.find("must be left empty"), std::string::npos);
}

TEST_F(ActionTest, AbortsWithTheStatusAndAnEmptyStampedPath) {
  startPlanner();
  publishMap(kRoom);
  connect();
  client_.sendGoal(goal(poseAt(0.5, 0.5), poseAt(2.5, 1.5)));
  ASSERT_TRUE(ended());
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::ABORTED);
  EXPECT_EQ(client_.getResult()->status, "GOAL_OCCUPIED");
  expectStampedAndEmpty(client_.getResult()->path);
  client_.sendGoal(goal(poseAt(0.5, 0.5), poseAt(5.5, 2.5)));
  ASSERT_TRUE(ended());
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::SUCCEEDED) << "the next one";
}

// navigation2 #4139, #2584: cancel waits for the search.
TEST_F(ActionTest, CancelEndsTheSearchAndTheNextGoalSucceeds) {
  startPlanner({"_timeout:=0", "_planner:=lazy_theta_star"});
  publishHugeMap();
  connect();
  ASSERT_TRUE(searches(goal(poseAt(0.5, 0.5), poseAt(2999.5, 1.5))));
  const double begin = planner_->processorSeconds();
  client_.cancelGoal();
  ASSERT_TRUE(ended());
  EXPECT_LT(planner_->processorSeconds() - begin, 1.0) << "of the processor: it searches on";
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::PREEMPTED);
  EXPECT_EQ(client_.getResult()->status, "CANCELLED");
  expectStampedAndEmpty(client_.getResult()->path);

  client_.sendGoal(goal(poseAt(0.5, 0.5), poseAt(5.5, 2.5)));
  ASSERT_TRUE(ended());
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::SUCCEEDED);
}

// The record named the map that explained the answer, which came during the search: a replay found a path.
TEST_F(ActionTest, ARecordNamesTheMapThatWasSearched) {
  const test::Latest<PlanRecord> records(nh_, "plan_record");
  startPlanner({"_timeout:=0", "_planner:=lazy_theta_star"});
  OccupancyGrid map(GridGeometry(1500, 1500, 1.0), 0);
  for (int row = 0; row < 1500; ++row) map[Cell{1498, row}] = 100;
  publishMap(map);
  connect();
  ASSERT_TRUE(test::waitFor([&] { return records.connected(); }));
  ASSERT_TRUE(searches(goal(poseAt(0.5, 0.5), poseAt(1499.5, 1.5))));
  publishMap(OccupancyGrid(map.geometry(), 0));
  ASSERT_TRUE(ended());
  ASSERT_EQ(client_.getResult()->status, "UNREACHABLE");
  const auto record = records.waitForMoreThan(0);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->map_checksum, MapChecksum(map).value());
}

TEST_F(ActionTest, TheTimeLimitEndsTheSearch) {
  startPlanner({"_timeout:=0.05", "_planner:=lazy_theta_star"});
  publishHugeMap();
  connect();
  client_.sendGoal(goal(poseAt(0.5, 0.5), poseAt(2999.5, 1.5)));
  ASSERT_TRUE(ended());
  EXPECT_EQ(client_.getResult()->status, "TIMEOUT");
}

}  // namespace
}  // namespace grid_path_planner::nodes
