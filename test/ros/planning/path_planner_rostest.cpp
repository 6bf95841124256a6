// path_planner through its topics and ~make_plan: what a path is, and what a failure says.
#include <visualization_msgs/MarkerArray.h>

#include <limits>

#include "grid_path_planner/path/waypoint_file.h"
#include "ros/support/planner_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using grid::OccupancyGrid;
using grid::Origin;
using path::Path;
using path::readWaypointFile;

namespace {

using test::AsciiMap;
using test::kRoom;
using test::poseAt;

class PathPlannerTest : public test::PlannerTest {};

TEST_F(PathPlannerTest, AGoalGetsAPathFromWhereTheVehicleIs) {
  startPlanner();
  publishMap(kRoom);
  placeVehicleAndWait(0.5, 0.5);
  sendGoal(poseAt(5.5, 2.5, 1.0));
  EXPECT_EQ(answer_.status, "FOUND") << answer_.message;
  EXPECT_EQ(path_.header.frame_id, "map");
  EXPECT_FALSE(path_.header.stamp.isZero());
  ASSERT_GE(path_.poses.size(), 3u);
  EXPECT_TRUE(endsAt(path_.poses.front(), 0.5, 0.5));
  EXPECT_GT(answer_.expanded, 0u);
  EXPECT_GT(answer_.search_bytes, 0u);
  EXPECT_EQ(answer_.planner, "weighted_jump_point");
  EXPECT_EQ(answer_.heuristic, "") << "jumps are not guided by it";
}

// navigation #207, navigation2 PR#6270, #2482: the last pose is the goal, its yaw too.
TEST_F(PathPlannerTest, TheLastPoseIsTheGoalWithItsYaw) {
  startPlanner();
  publishMap(kRoom);
  makePlan(poseAt(0.3, 0.6), poseAt(5.2, 2.7, -2.0));
  ASSERT_GE(path_.poses.size(), 2u);
  EXPECT_TRUE(endsAt(path_.poses.front(), 0.3, 0.6));
  EXPECT_TRUE(endsAt(path_.poses.back(), 5.2, 2.7));
  EXPECT_NEAR(yawOf(path_.poses.back().pose.orientation), -2.0, 1e-9);
  const auto& before = path_.poses[path_.poses.size() - 2].pose.position;
  EXPECT_GT(std::hypot(before.x - 5.2, before.y - 2.7), 0.1) << "a near-duplicate of the goal";
}

// navigation2 #2494, #4792: start = goal fails.
TEST_F(PathPlannerTest, StartAtTheGoalIsFound) {
  startPlanner();
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5, 1.0), poseAt(0.5, 0.5, 1.0));
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_EQ(path_.poses.size(), 1u);
  makePlan(poseAt(0.2, 0.5), poseAt(0.7, 0.5));
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_EQ(path_.poses.size(), 2u);
}

// navigation PR#533, #964, navigation2 #2002: a failure says so and leaves no old path.
TEST_F(PathPlannerTest, AFailedGoalPublishesAnEmptyPathWithFrameAndStamp) {
  startPlanner();
  publishMap({"..#..", "..#..", "..#.."});
  placeVehicleAndWait(0.5, 0.5);
  sendGoal(poseAt(1.5, 2.5));
  EXPECT_EQ(path_.poses.empty(), false);
  sendGoal(poseAt(4.5, 2.5));
  EXPECT_EQ(answer_.status, "UNREACHABLE");
  expectStampedAndEmpty(path_);
  sendGoal(poseAt(2.5, 1.5));
  EXPECT_EQ(answer_.status, "GOAL_OCCUPIED");
  expectStampedAndEmpty(path_);
  sendGoal(poseAt(40.0, 1.5));
  EXPECT_EQ(answer_.status, "GOAL_OUTSIDE_MAP");
  expectStampedAndEmpty(path_);
}

TEST_F(PathPlannerTest, WithoutAMapTheAnswerIsNoMap) {
  startPlanner({"_tf_timeout:=0", "_map_frame:=site"});
  sendGoal(poseAt(1.5, 2.5));
  EXPECT_EQ(answer_.status, "NO_MAP");
  EXPECT_EQ(answer_.message, "no map has come on /projected_map yet") << "as it is remapped";
  expectStampedAndEmpty(path_, "site");
}

TEST_F(PathPlannerTest, AGoalWithoutAFrameIsInTheMaps) {
  startPlanner();
  publishMap(kRoom);
  placeVehicleAndWait(0.5, 0.5);
  sendGoal(poseAt(1.5, 2.5, 0.0, ""));
  EXPECT_EQ(answer_.status, "FOUND") << answer_.message;
}

TEST_F(PathPlannerTest, ABadGoalIsAnInvalidRequest) {
  startPlanner();
  publishMap(kRoom);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<geometry_msgs::PoseStamped> bad{poseAt(nan, 0.5), poseAt(1e180, 0.5)};
  bad.push_back(poseAt(0.5, 0.5));
  bad.back().pose.orientation.w = 0.0;
  bad.push_back(poseAt(0.5, 0.5));
  bad.back().pose.orientation.x = bad.back().pose.orientation.w = std::sqrt(0.5);
  for (const auto& goal : bad) {
    sendGoal(goal);
    EXPECT_EQ(answer_.status, "INVALID_REQUEST") << goal;
    EXPECT_NE(answer_.message.find("the goal: "), std::string::npos) << answer_.message;
    expectStampedAndEmpty(path_);
  }
}

// navigation2 #4432, navigation PR#703.
TEST_F(PathPlannerTest, ToleranceZeroEndsNowhereElseAndRadiusEndsNearby) {
  startPlanner();
  publishMap({"......", "....##", "....##"});
  makePlan(poseAt(0.5, 0.5), poseAt(4.5, 1.5, 0.7));
  EXPECT_EQ(answer_.status, "GOAL_OCCUPIED");
  expectStampedAndEmpty(path_);
  makePlan(poseAt(0.5, 0.5), poseAt(4.5, 1.5, 0.7), 1.2F);
  EXPECT_EQ(answer_.status, "FOUND") << answer_.message;
  ASSERT_FALSE(path_.poses.empty());
  const auto& end = path_.poses.back();
  EXPECT_NEAR(std::hypot(end.pose.position.x - 4.5, end.pose.position.y - 1.5), 1.0, 1e-6);
  EXPECT_NEAR(yawOf(end.pose.orientation), 0.7, 1e-9);
}

// navigation #223, #261, navigation2 #3285.
TEST_F(PathPlannerTest, UnknownIsNotCrossedWhenItMustNotBe) {
  startPlanner({"_unknown_is_passable:=false", "_kernel:=2"});
  publishMap({"..??..", "..??..", "..??.."});
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 0.5));
  EXPECT_EQ(answer_.status, "UNREACHABLE");
  expectStampedAndEmpty(path_);
}

TEST_F(PathPlannerTest, UnknownIsCrossedWhereItMayBe) {
  startPlanner();
  publishMap({"..??..", "..??..", "..??.."});
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 0.5));
  EXPECT_EQ(answer_.status, "FOUND");
}

// navigation #166, #661, navigation2 #1511: the map's yaw ignored.
TEST_F(PathPlannerTest, ARotatedMapWithANegativeOriginGivesTheRotatedPath) {
  startPlanner();
  publishMap(AsciiMap(kRoom).map);
  makePlan(poseAt(0.5, 0.5), poseAt(0.5, 2.5));
  const nav_msgs::Path straight = path_;
  const Origin origin{-7.0, -3.0, 2.0};
  const OccupancyGrid turned = AsciiMap(kRoom, 1.0, origin).map;
  publishMap(turned);
  const auto placed = [&](double x, double y) {
    const Eigen::Vector2d point = turned.geometry().worldFromGrid({x, y});
    return poseAt(point.x(), point.y());
  };
  makePlan(placed(0.5, 0.5), placed(0.5, 2.5));
  ASSERT_EQ(path_.poses.size(), straight.poses.size());
  for (std::size_t i = 0; i < straight.poses.size(); ++i) {
    const auto& expected = straight.poses[i].pose.position;
    const Eigen::Vector2d point = turned.geometry().worldFromGrid({expected.x, expected.y});
    EXPECT_TRUE(endsAt(path_.poses[i], point.x(), point.y())) << i;
  }
}

// navigation2 #2186, navigation #7: pose frames ignored.
TEST_F(PathPlannerTest, PosesInOtherFramesAreTransformed) {
  startPlanner();
  publishMap(kRoom);
  publishTransform("map", "station", 5.0, 0.0, 0.0, M_PI / 2);
  ASSERT_TRUE(test::waitFor([&] {
    makePlan(poseAt(0.5, 0.5, 0.0, "/map"), poseAt(2.5, -0.5, 0.0, "station"));
    return answer_.status == "FOUND";
  })) << answer_.message;
  EXPECT_EQ(path_.header.frame_id, "map");
  EXPECT_TRUE(endsAt(path_.poses.front(), 0.5, 0.5));
  EXPECT_TRUE(endsAt(path_.poses.back(), 5.5, 2.5));
  EXPECT_NEAR(yawOf(path_.poses.back().pose.orientation), M_PI / 2, 1e-9);
}

TEST_F(PathPlannerTest, AMapInSlashMapIsInMap) {
  startPlanner();
  publishMap(AsciiMap(kRoom).map, "/map");
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_EQ(path_.header.frame_id, "map");
}

// rospy's clients set no orientation, and the vehicle turned at the goal, or the goal was refused.
TEST_F(PathPlannerTest, AnOrientationOfZerosIsNoHeadingUnlessAnyWillDo) {
  geometry_msgs::PoseStamped zeros = poseAt(5.5, 2.5);
  zeros.pose.orientation = geometry_msgs::Quaternion();
  startPlanner();
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5), zeros);
  EXPECT_EQ(answer_.status, "INVALID_REQUEST");
  EXPECT_NE(answer_.message.find("zero_heading"), std::string::npos) << answer_.message;
  startPlanner({"_zero_heading:=any"});
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5), zeros);
  ASSERT_EQ(answer_.status, "FOUND") << answer_.message;
  const auto& last = path_.poses.back();
  const auto& before = path_.poses[path_.poses.size() - 2];
  EXPECT_NEAR(yawOf(last.pose.orientation), yawOf(before.pose.orientation), 1e-9)
      << "as it arrives";
  makePlan(zeros, poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "INVALID_REQUEST") << "a start has a heading";
}

TEST_F(PathPlannerTest, AnUnknownFrameIsATransformError) {
  startPlanner({"_tf_timeout:=0.05", "_base_frame:=nowhere"});
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5, 0.0, "atlantis"));
  EXPECT_EQ(answer_.status, "TRANSFORM_ERROR");
  EXPECT_EQ(answer_.message,
            "no transform from atlantis to map: nothing on /tf names the frame 'atlantis' or "
            "'map'");
  expectStampedAndEmpty(path_);
  makePlan({}, poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "TRANSFORM_ERROR");
  EXPECT_NE(answer_.message.find("nowhere"), std::string::npos) << answer_.message;
  sendGoal(poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "TRANSFORM_ERROR");
  expectStampedAndEmpty(path_);
}

TEST_F(PathPlannerTest, InitialPoseServesTheNextNewGoalOnly) {
  startPlanner();
  publishMap(kRoom);
  placeVehicleAndWait(0.5, 0.5);
  ASSERT_TRUE(test::waitFor([&] {  // two topics are not in order: until the start was there first
    setStart(poseAt(5.5, 0.5));
    sendGoal(poseAt(5.5, 2.5));
    return endsAt(path_.poses.front(), 5.5, 0.5);
  }));
  ASSERT_TRUE(test::waitFor([&] {  // a start that was late for its goal served this one
    sendGoal(poseAt(0.5, 2.5));
    return endsAt(path_.poses.front(), 0.5, 0.5);
  }));
}

TEST_F(PathPlannerTest, TheGoalsHeightCanBeTheVehicles) {
  startPlanner({"_goal_z_from:=vehicle"});
  publishMap(kRoom);
  placeVehicleAndWait(0.5, 0.5, -12.0);
  sendGoal(poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_EQ(path_.poses.back().pose.position.z, -12.0);
}

// Whatever is wrong with a map: it is refused and the one before stays in force.
TEST_F(PathPlannerTest, ABadMapIsRefusedAndTheOldOneStays) {
  startPlanner();
  publishMap(kRoom);
  const nav_msgs::OccupancyGrid good =
      occupancyToMessage(AsciiMap({"#"}).map, "map", ros::Time::now());
  std::vector<nav_msgs::OccupancyGrid> bad(6, good);
  bad[0].info.origin.orientation.x = bad[0].info.origin.orientation.w = std::sqrt(0.5);
  bad[1].data.push_back(0);
  bad[2].info.resolution = std::numeric_limits<float>::quiet_NaN();
  bad[3].data[0] = 101;
  bad[4].info.resolution = -0.05F;
  // One that lies where the good one does is compared with it.
  bad[5] = occupancyToMessage(AsciiMap(kRoom).map, "map", ros::Time::now());
  bad[5].data[16] = bad[5].data[2] = 100;
  bad[5].data[9] = -2;
  for (const auto& message : bad) {
    const std::size_t seen = log_.count();
    maps_.publish(message);
    ASSERT_TRUE(log_.waitFor(seen, [](const rosgraph_msgs::Log& line) {
      return line.msg.find("was refused, the map stays as it was") != std::string::npos;
    }));
  }
  nav_msgs::OccupancyGrid last = occupancyToMessage(AsciiMap(kRoom).map, "map", ros::Time::now());
  last.data[0] = -1;  // shows that the messages before it have been dealt with
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "FOUND");
  const std::size_t seen = planning_maps_.count();
  maps_.publish(last);
  ASSERT_TRUE(planning_maps_.waitForMoreThan(seen));
  EXPECT_EQ(planning_maps_.count(), seen + 1) << "a bad map was planned on";
  EXPECT_TRUE(planner_->running());
}

TEST_F(PathPlannerTest, ThePlanningMapShowsWhatIsSearched) {
  startPlanner({"_radius:=0.6", "_decay:=1.0"});
  publishMap({"?........", "....#....", "........."});
  const auto shown = planning_maps_.all().back();
  EXPECT_EQ(shown.header.frame_id, "map");
  EXPECT_FALSE(shown.header.stamp.isZero());
  const auto at = [&](int column, int row) {
    return static_cast<int>(shown.data[row * 9 + column]);
  };
  EXPECT_EQ(at(0, 0), -1) << "unknown, passable";
  EXPECT_EQ(at(4, 1), 100) << "occupied";
  EXPECT_EQ(at(3, 1), 100) << "nearer than the radius";
  EXPECT_GT(at(2, 1), at(1, 1));
  EXPECT_GT(at(1, 1), 0);
  EXPECT_LT(at(2, 1), 100);
}

TEST_F(PathPlannerTest, MarkersShowExpandedCellsAndWaypoints) {
  startPlanner();
  publishMap(kRoom);
  test::Latest<visualization_msgs::MarkerArray> markers(nh_, "search_markers");
  ASSERT_TRUE(test::waitFor([&] { return markers.connected(); }));
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5));
  const auto shown = markers.waitForMoreThan(0);
  ASSERT_TRUE(shown);
  ASSERT_EQ(shown->markers.size(), 6u);
  EXPECT_EQ(shown->markers[0].ns, "expanded");
  EXPECT_EQ(shown->markers[0].points.size(), answer_.expanded);
  EXPECT_EQ(shown->markers[0].header.frame_id, "map");
  EXPECT_EQ(shown->markers[1].ns, "waypoints");
  EXPECT_EQ(shown->markers[1].points.size(), 3u) << "the corners";
  EXPECT_EQ(shown->markers[2].ns, "start");
  EXPECT_EQ(shown->markers[2].pose.position.x, 0.5);
  EXPECT_EQ(shown->markers[3].ns, "goal");
  EXPECT_EQ(shown->markers[3].pose.position.x, 5.5);
  for (const std::size_t hidden : {4, 5})
    EXPECT_EQ(shown->markers[hidden].action, visualization_msgs::Marker::DELETE) << hidden;
  makePlan(poseAt(0.5, 0.5), poseAt(2.5, 1.5));
  const auto failed = markers.waitFor(1, [](const visualization_msgs::MarkerArray& array) {
    return array.markers[1].action == visualization_msgs::Marker::DELETE;
  });
  ASSERT_TRUE(failed) << "waypoints of the plan before";
  EXPECT_EQ(failed->markers[3].action, visualization_msgs::Marker::DELETE);
  EXPECT_EQ(failed->markers[5].text.find("GOAL_OCCUPIED: "), 0u) << failed->markers[5].text;
  EXPECT_EQ(failed->markers[5].pose.position.x, 2.5) << "at the goal";
  EXPECT_GT(failed->markers[5].pose.position.y - failed->markers[5].scale.z, 1.5)
      << "above it: a point that stands there could not be dragged away";
}

// Whether the vehicle fits could be seen nowhere.
TEST_F(PathPlannerTest, ADiscOfTheRadiusMovesWithTheVehicle) {
  startPlanner({"_radius:=0.4"});
  publishMap({"...", "...", "..."});
  placeVehicleAndWait(1.5, 1.5);
  test::Latest<visualization_msgs::MarkerArray> markers(nh_, "search_markers");
  ASSERT_TRUE(test::waitFor([&] { return markers.connected(); }));
  sendGoal(poseAt(2.5, 2.5));
  const auto shown = markers.waitForMoreThan(0);
  ASSERT_TRUE(shown && shown->markers.size() == 6u);
  EXPECT_EQ(shown->markers[4].ns, "vehicle");
  EXPECT_EQ(shown->markers[4].header.frame_id, "base_link");
  EXPECT_NEAR(shown->markers[4].scale.x, 0.8, 1e-6);
  EXPECT_TRUE(shown->markers[4].frame_locked);
}

// A search that nobody watches is not recorded; who comes later sees where it led.
TEST_F(PathPlannerTest, MarkersForALaterSubscriberShowTheNewestPath) {
  startPlanner();
  publishMap(kRoom);
  makePlan(poseAt(0.5, 0.5), poseAt(2.5, 0.5));
  makePlan(poseAt(0.5, 0.5), poseAt(5.5, 2.5));
  test::Latest<visualization_msgs::MarkerArray> markers(nh_, "search_markers");
  const auto shown = markers.waitForMoreThan(0);
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->markers[0].action, visualization_msgs::Marker::DELETE);
  EXPECT_EQ(shown->markers[1].points.size(), 3u) << "the corners";
}

TEST_F(PathPlannerTest, EveryFoundPlanIsWrittenToTheWaypointsFile) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("plan.yaml");
  startPlanner({"--waypoints-file", file});
  publishMap(kRoom);
  placeVehicleAndWait(0.5, 0.5);
  sendGoal(poseAt(5.5, 2.5, 1.0));
  ASSERT_EQ(answer_.status, "FOUND");
  ASSERT_TRUE(test::waitFor([&] {
    if (::access(file.c_str(), R_OK) != 0) return false;
    const Path written = readWaypointFile(file).path;
    return written.poses.size() == 3 && written.poses.back().position.x() == 5.5;
  })) << "the corners";
}

// A vehicle must not end up under two planners: the first ends in order, the second works.
TEST_F(PathPlannerTest, ASecondNodeOfTheSameNameEndsTheFirst) {
  startPlanner();
  const auto first = std::move(planner_);
  planner_ = std::make_unique<test::Process>("path_planner", std::vector<std::string>{});
  ASSERT_TRUE(first->waitForExit());
  EXPECT_EQ(first->exitCode(), 0);
  nav_msgs::GetPlan call;
  EXPECT_TRUE(test::waitFor([&] { return ros::service::call("/path_planner/make_plan", call); }));
  EXPECT_TRUE(planner_->running());
}

TEST_F(PathPlannerTest, BadParametersEndItBeforeAnythingStarts) {
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"_kernel:=0", "/path_planner/kernel must be a number from 1 to 1024 cells, got 0"},
      {"_kernel:=three", "/path_planner/kernel must be an integer, got the string three"},
      {"_planner:=crow", ", got 'crow'"},
      {"_free_max:=90", "free_max must be below occupied_min, got 90 and 65"}};
  for (const auto& [argument, reason] : bad) {
    ros::param::del("/path_planner");
    test::Process planner("path_planner", {argument});
    ASSERT_TRUE(planner.waitForExit()) << argument;
    EXPECT_EQ(planner.exitCode(), 1) << argument;
    EXPECT_TRUE(planner.hasSaid(reason)) << planner.output();
  }
  ros::param::del("/path_planner");
}

}  // namespace
}  // namespace grid_path_planner::nodes
