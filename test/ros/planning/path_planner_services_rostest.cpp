// path_planner's services, its parameters while it runs, and its diagnostics.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "grid_path_planner/ComparePlans.h"
#include "grid_path_planner/ExplainPlan.h"
#include "grid_path_planner/SaveWaypoints.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "ros/support/planner_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::Path;
using path::readWaypointFile;
using planners::plannerNames;

namespace {

using dynamic_reconfigure::ConfigTools;
using test::kRoom;
using test::poseAt;

class ServicesTest : public test::PlannerTest {
 protected:
  SaveWaypoints::Response save(const std::string& file) {
    SaveWaypoints call;
    call.request.filename = file;
    EXPECT_TRUE(ros::service::call("/path_planner/save_waypoints", call));
    return call.response;
  }
  dynamic_reconfigure::Config reconfigure(const dynamic_reconfigure::Config& wanted) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config = wanted;
    EXPECT_TRUE(ros::service::call("/path_planner/set_parameters", call));
    return call.response.config;
  }
  const test::TemporaryFolder folder_;
};

TEST_F(ServicesTest, MakePlanReturnsTrueAndAnEmptyStampedPlanOnFailure) {
  startPlanner();
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "NO_MAP");
  expectStampedAndEmpty(path_);
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5), poseAt(2.5, 1.5));
  EXPECT_EQ(answer_.status, "GOAL_OCCUPIED");
  expectStampedAndEmpty(path_);
  makePlan(poseAt(2.5, 1.5), poseAt(0.5, 0.5));
  EXPECT_EQ(answer_.status, "START_OCCUPIED");
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5), -1.0F);
  EXPECT_EQ(answer_.status, "INVALID_REQUEST");
  EXPECT_NE(answer_.message.find("tolerance"), std::string::npos) << answer_.message;
  EXPECT_EQ(paths_.count(), 0u) << "the topic is for goals";
}

TEST_F(ServicesTest, ComparePlansAsksEveryPlannerAndNamesWhatItAsked) {
  startPlanner();
  publishMap(kRoom);
  ComparePlans call;
  call.request.start = poseAt(0.5, 0.5);
  call.request.goal = poseAt(5.5, 2.5);
  ASSERT_TRUE(ros::service::call("/path_planner/compare_plans", call));
  ASSERT_EQ(call.response.results.size(), plannerNames().size());
  ASSERT_EQ(call.response.paths.size(), plannerNames().size());
  for (std::size_t i = 0; i < plannerNames().size(); ++i) {
    EXPECT_EQ(call.response.results[i].planner, plannerNames()[i]);
    EXPECT_EQ(call.response.results[i].status, "FOUND");
    EXPECT_FALSE(call.response.paths[i].poses.empty());
  }
  EXPECT_EQ(call.response.results[0].cost, call.response.results[1].cost);

  call.request.planners = {"a_star", "dijkstra", "crow"};
  call.request.heuristics = {"zero", "octile", "guess"};
  ASSERT_TRUE(ros::service::call("/path_planner/compare_plans", call));
  ASSERT_EQ(call.response.results.size(), 3u + 1u + 1u) << "an unknown planner is refused once";
  EXPECT_EQ(call.response.results[0].heuristic, "zero");
  EXPECT_EQ(call.response.results[1].heuristic, "octile");
  EXPECT_GT(call.response.results[0].expanded, call.response.results[1].expanded);
  EXPECT_EQ(call.response.results[2].status, "INVALID_REQUEST");
  EXPECT_EQ(call.response.results[3].planner, "dijkstra");
  EXPECT_EQ(call.response.results[3].heuristic, "");
  EXPECT_EQ(call.response.results[4].status, "INVALID_REQUEST");
  expectStampedAndEmpty(call.response.paths[4]);
  EXPECT_EQ(statistics_.count(), 0u) << "a comparison is for who asked";
}

// follow_waypoints #20, navigation2 #2688: can't save.
TEST_F(ServicesTest, SaveWaypointsWritesTheLastPathOrSaysWhyNot) {
  startPlanner({"--save-folder", folder_.path("")});
  const std::string file = folder_.path("plan.yaml");
  EXPECT_FALSE(save(file).success);
  EXPECT_NE(save(file).message.find("no path"), std::string::npos);
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5, 1.0));
  EXPECT_NE(save("").message.find("filename"), std::string::npos);

  const auto saved = save(file);
  ASSERT_TRUE(saved.success) << saved.message;
  const Path path = readWaypointFile(file).path;
  EXPECT_EQ(path.frame_id, "map");
  EXPECT_EQ(path.poses.size(), 3u) << "the corners";
  EXPECT_NEAR(path.poses.back().yaw, 1.0, 1e-9);

  const auto refused = save(file + "/below/a/file.yaml");
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("/below/a/file.yaml"), std::string::npos) << refused.message;
}

TEST_F(ServicesTest, AWaypointsFileThatCannotBeWrittenSpoilsNothingElse) {
  startPlanner({"--waypoints-file", "/dev/null/waypoints.yaml"});
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_TRUE(log_.waitFor(0, [](const rosgraph_msgs::Log& line) {
    return line.msg.find("The waypoints were not saved: /dev/null/waypoints.yaml") == 0;
  }));
}

TEST_F(ServicesTest, AContradictionIsRevertedAndAGoodChangeIsInForce) {
  startPlanner({"_radius:=0.4"});
  publishMap(kRoom);
  dynamic_reconfigure::Config wanted;
  ConfigTools::appendParameter(wanted, "occupied_is_passable", true);
  bool passable = true;
  EXPECT_TRUE(ConfigTools::getParameter(reconfigure(wanted), "occupied_is_passable", passable));
  EXPECT_FALSE(passable) << "not with a radius";
  makePlan(poseAt(0.5, 0.5), poseAt(2.5, 1.5));
  EXPECT_EQ(answer_.status, "GOAL_OCCUPIED");

  ConfigTools::appendParameter(wanted, "radius", 0.0);
  EXPECT_TRUE(ConfigTools::getParameter(reconfigure(wanted), "occupied_is_passable", passable));
  EXPECT_TRUE(passable);
  makePlan(poseAt(0.5, 0.5), poseAt(2.5, 1.5));
  EXPECT_EQ(answer_.status, "FOUND") << answer_.message;
}

// smooth was ignored with polyanya without a word.
TEST_F(ServicesTest, OptionsThatChangeNothingAreWarnedOf) {
  startPlanner({"_planner:=polyanya", "_smooth:=false"});
  EXPECT_TRUE(planner_->says("smooth changes nothing with planner polyanya"));
  dynamic_reconfigure::Config wanted;
  ConfigTools::appendParameter(wanted, "inflation_weight", 30);
  reconfigure(wanted);
  EXPECT_TRUE(planner_->says("inflation_weight changes nothing with decay 0"));
  const std::string output = planner_->output();
  EXPECT_EQ(output.find("smooth changes"), output.rfind("smooth changes")) << "once is enough";
}

TEST_F(ServicesTest, DiagnosticsNameTheMapAndTheLastPlanning) {
  test::Latest<diagnostic_msgs::DiagnosticArray> diagnostics(nh_, "/diagnostics");
  startPlanner();
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5), poseAt(2.5, 1.5));
  const auto has = [](const char* name, int level, const char* text) {
    return [=](const diagnostic_msgs::DiagnosticArray& array) {
      for (const auto& status : array.status)
        if (status.name == name && status.level == level &&
            status.message.find(text) != std::string::npos)
          return true;
      return false;
    };
  };
  EXPECT_TRUE(diagnostics.waitFor(0, has("path_planner: map", 0, "a map is there")));
  EXPECT_TRUE(diagnostics.waitFor(0, has("path_planner: plan", 1, "GOAL_OCCUPIED: ")));
}

double largestStep(const nav_msgs::Path& path) {
  double largest = 0.0;
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    const auto &to = path.poses[i].pose.position, &from = path.poses[i - 1].pose.position;
    largest = std::max(largest, std::hypot(to.x - from.x, to.y - from.y));
  }
  return largest;
}

// A follower that goes from pose to pose cut across the room between the corners.
TEST_F(ServicesTest, PosesStandAsFarApartAsPoseSpacingSays) {
  for (const auto& [spacing, most] : std::vector<std::pair<std::string, double>>{
           {"-1", 1.0}, {"0.25", 0.25}, {"3", 3.0}, {"0", 5.0}}) {
    startPlanner({"_pose_spacing:=" + spacing});
    publishMap(kRoom);
    placeVehicleAndWait(0.5, 0.5);
    sendGoal(poseAt(5.5, 2.5, 1.0));
    EXPECT_LE(largestStep(path_), most + 1e-9) << spacing;
    EXPECT_GT(largestStep(path_), 0.6 * most) << spacing;
    const nav_msgs::Path published = path_;
    makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5, 1.0));
    EXPECT_EQ(path_.poses.size(), published.poses.size()) << spacing;
  }
}

// The answer of a service has the explanation; the vehicle's path does not wait for it.
TEST_F(ServicesTest, AFailureIsExplained) {
  startPlanner({"_radius:=2"});
  test::Latest<visualization_msgs::MarkerArray> markers(nh_, "explanation_markers");
  publishMap({"....#....",  //
              "....#....",  //
              ".........",  //
              ".........",  //
              ".........",  //
              "....#....",  //
              "....#...."});
  ExplainPlan call;
  call.request.start = poseAt(1.5, 3.5);
  call.request.goal = poseAt(7.5, 3.5);
  ASSERT_TRUE(ros::service::call("/path_planner/explain_plan", call));
  EXPECT_EQ(call.response.status, "UNREACHABLE");
  ASSERT_TRUE(call.response.has_gap) << call.response.message;
  EXPECT_NEAR(call.response.gap.x, 4.5, 1e-9);
  EXPECT_EQ(call.response.largest_radius_m, 1.5);
  EXPECT_NE(call.response.message.find("1.5 m would pass"), std::string::npos);
  makePlan(poseAt(1.5, 3.5), poseAt(7.5, 3.5));
  EXPECT_NE(answer_.message.find("1.5 m would pass"), std::string::npos) << answer_.message;
  placeVehicle(1.5, 3.5);
  sendGoal(poseAt(7.5, 3.5));
  EXPECT_EQ(answer_.status, "UNREACHABLE");
  EXPECT_TRUE(planner_->says("Why: no path leads from (1.5, 3.5) to (7.5, 3.5); the gap at"));
  const auto shown = markers.waitForMoreThan(0);
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->markers.size(), 4u)
      << "what was shown goes; the gap, the nearest place, the text";
  const std::size_t seen = markers.count();
  sendGoal(poseAt(2.5, 3.5));
  EXPECT_EQ(answer_.status, "FOUND");
  const auto cleared = markers.waitForMoreThan(seen);
  ASSERT_TRUE(cleared);
  EXPECT_EQ(cleared->markers.size(), 1u);
}

}  // namespace
}  // namespace grid_path_planner::nodes
