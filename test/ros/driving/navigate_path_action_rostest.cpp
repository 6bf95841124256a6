// navigate_path told by services and by its action.
#include <actionlib/client/simple_action_client.h>

#include <limits>

#include "grid_path_planner/NavigatePathAction.h"
#include "ros/support/navigate_fixture.h"

namespace grid_path_planner::nodes {

using path::Path;

namespace {

using actionlib::SimpleClientGoalState;
using test::pathOf;
using Client = actionlib::SimpleActionClient<NavigatePathAction>;

class NavigateAction : public test::NavigateTest {
 protected:
  void SetUp() override {
    startSimulator();
    startNavigate();
    client_ = std::make_unique<Client>("navigate_path", false);  // waits for a clock
    ASSERT_TRUE(test::waitFor([&] { return client_->isServerConnected(); }));
  }

  void send(const Path& path) {
    NavigatePathGoal goal;
    goal.path = pathToMessage(path, ros::Time::now());
    client_->sendGoal(goal);
  }
  bool done() {
    return test::waitFor([&] { return client_->getState().isDone(); });
  }

  std::unique_ptr<Client> client_;
};

TEST_F(NavigateAction, ServicesFromEveryState) {
  EXPECT_FALSE(ask("resume")) << "idle";
  EXPECT_TRUE(ask("pause")) << "idle: of the next path";
  EXPECT_TRUE(ask("cancel")) << "idle";

  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(moves());
  EXPECT_TRUE(ask("resume")) << "driving: it is not paused";
  EXPECT_TRUE(ask("pause"));
  EXPECT_TRUE(staysStill());
  EXPECT_TRUE(ask("pause")) << "paused";
  EXPECT_TRUE(ask("resume"));
  ASSERT_TRUE(moves());
  EXPECT_TRUE(ask("cancel"));
  EXPECT_TRUE(staysStill());
  EXPECT_FALSE(ask("resume")) << "cancelled";
  EXPECT_TRUE(ask("pause")) << "cancelled";
  EXPECT_TRUE(ask("resume")) << "of the next path";

  publishPath(pathOf({{50, 0}}));
  ASSERT_TRUE(moves()) << "the next path after a cancel";
  EXPECT_TRUE(ask("pause"));
  EXPECT_TRUE(ask("cancel")) << "paused";
  EXPECT_TRUE(staysStill());
  const double x = pose().position.x();
  publishPath(pathOf({{x, 0}, {x, 1}}));
  EXPECT_TRUE(arrivesAt(x, 1)) << "the next path after a cancel of a pause";
}

TEST_F(NavigateAction, AGoalIsDrivenAndItsResultSaysHow) {
  send(pathOf({{0, 0}, {1, 0}, {1, 1, 0, 1}}));
  ASSERT_TRUE(done());
  EXPECT_EQ(client_->getState().state_, SimpleClientGoalState::SUCCEEDED);
  const NavigatePathResult result = *client_->getResult();
  EXPECT_EQ(result.status, "ARRIVED");
  EXPECT_TRUE(result.missed_waypoints.empty());
  EXPECT_LT(result.position_error_m, 0.06);
  EXPECT_LT(result.yaw_error_rad, 0.06);
  EXPECT_TRUE(arrivesAt(1, 1));
}

TEST_F(NavigateAction, ACancelledGoalStopsAndTheNextOneIsDriven) {
  send(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(moves());
  client_->cancelGoal();
  ASSERT_TRUE(done());
  EXPECT_EQ(client_->getState().state_, SimpleClientGoalState::PREEMPTED);
  EXPECT_EQ(client_->getResult()->status, "CANCELLED");
  EXPECT_TRUE(staysStill());
  const double x = pose().position.x();
  send(pathOf({{x, 1}}));
  ASSERT_TRUE(done());
  EXPECT_EQ(client_->getResult()->status, "ARRIVED");
}

TEST_F(NavigateAction, ANewGoalTakesThePlaceOfTheOldOne) {
  Client other("navigate_path", false);
  ASSERT_TRUE(test::waitFor([&] { return other.isServerConnected(); }));
  NavigatePathGoal goal;
  goal.path = pathToMessage(pathOf({{0, 0}, {50, 0}}), ros::Time::now());
  other.sendGoal(goal);
  ASSERT_TRUE(moves());
  send(pathOf({{0, 1}}));
  ASSERT_TRUE(test::waitFor([&] { return other.getState().isDone(); }));
  EXPECT_EQ(other.getResult()->status, "CANCELLED");
  ASSERT_TRUE(done());
  EXPECT_EQ(client_->getResult()->status, "ARRIVED");
  EXPECT_TRUE(arrivesAt(0, 1));
}

// It drove off: the pause was lost with the goal that it replaced.
TEST_F(NavigateAction, AGoalThatReplacesAPausedOneWaitsForResume) {
  send(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(moves());
  EXPECT_TRUE(ask("pause"));
  ASSERT_TRUE(standsStill());
  const double x = pose().position.x();
  send(pathOf({{x, 0}, {x, 1}}));
  EXPECT_TRUE(staysStill());
  EXPECT_TRUE(ask("resume"));
  ASSERT_TRUE(done());
  EXPECT_EQ(client_->getResult()->status, "ARRIVED");
  EXPECT_TRUE(arrivesAt(x, 1));
}

TEST_F(NavigateAction, PathsThatComeMeanwhileDoNotTakeItsPlace) {
  send(pathOf({{0, 0}, {20, 0}}));  // long enough for a test that stalls
  ASSERT_TRUE(moves());
  publishPath(pathOf({{0, 50}}));
  publishPath(Path());
  ASSERT_TRUE(done());
  EXPECT_EQ(client_->getResult()->status, "ARRIVED");
  EXPECT_TRUE(arrivesAt(20, 0));
}

TEST_F(NavigateAction, ACancelByServiceEndsTheGoal) {
  send(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(moves());
  EXPECT_TRUE(ask("pause"));
  EXPECT_TRUE(ask("cancel"));
  ASSERT_TRUE(done());
  EXPECT_EQ(client_->getState().state_, SimpleClientGoalState::ABORTED);
  EXPECT_EQ(client_->getResult()->status, "CANCELLED");
}

TEST_F(NavigateAction, GoalsThatCannotBeDrivenAreRefusedByName) {
  const auto refusal = [&](const NavigatePathGoal& goal) {
    client_->sendGoal(goal);
    EXPECT_TRUE(done());
    EXPECT_EQ(client_->getResult()->status, "INVALID_REQUEST");
    return client_->getResult()->message;
  };
  NavigatePathGoal goal;
  EXPECT_NE(refusal(goal).find("at least one waypoint"), std::string::npos);
  goal.path = pathToMessage(pathOf({{0, 0}, {0, 1e180}}), ros::Time::now());
  EXPECT_NE(refusal(goal).find("pose 2 of the path"), std::string::npos);
  goal.path =
      pathToMessage(pathOf({{std::numeric_limits<double>::quiet_NaN(), 0}}), ros::Time::now());
  EXPECT_NE(refusal(goal).find("pose 1 of the path"), std::string::npos);
  goal.path = pathToMessage(pathOf({{0, 1}}), ros::Time::now());
  goal.path.header.frame_id = "mars";
  goal.path.poses[0].header.frame_id = "mars";
  EXPECT_NE(refusal(goal).find("'mars'"), std::string::npos);
  // The vehicle's own pose is always 0 there: "2 m ahead" was driven for 15 m.
  goal.path.header.frame_id = goal.path.poses[0].header.frame_id = "base_link";
  EXPECT_NE(refusal(goal).find("which moves with 'base_link'"), std::string::npos);
  goal.path.poses.clear();
  goal.filename = "/no/such/file.yaml";
  EXPECT_NE(refusal(goal).find("/no/such/file.yaml"), std::string::npos);
  EXPECT_TRUE(staysStill(1.0));
}

}  // namespace
}  // namespace grid_path_planner::nodes
