// path_planner while the vehicle drives: maps that change, replans, goals that change.

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/advertise_options.h>

#include <atomic>

#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using test::AsciiMap;
using test::poseAt;

class ReplanTest : public test::PlannerTest {
 protected:
  void sendUpdate(int x, int y, unsigned width, unsigned height,
                  const std::vector<std::int8_t>& data, const ros::Time& stamp = ros::Time::now()) {
    map_msgs::OccupancyGridUpdate update;
    update.header.frame_id = "map";
    update.header.stamp = stamp;
    update.x = x;
    update.y = y;
    update.width = width;
    update.height = height;
    update.data = data;
    updates_.publish(update);
  }
  void sendNumbered(std::uint32_t number) {
    map_msgs::OccupancyGridUpdate update;
    update.header.seq = number;
    update.header.stamp = ros::Time::now();
    updates_.publish(update);
  }
  bool logged(const std::string& text, std::size_t seen) {
    return log_
        .waitFor(seen,
                 [&](const rosgraph_msgs::Log& line) {
                   return line.msg.find(text) != std::string::npos;
                 })
        .has_value();
  }
  // Whether row `row` of the map (1 m cells) is crossed in column `column`.
  bool passesCell(int column, int row) { return passes(path_, column + 0.5, row + 0.5, 0.1); }
};

const std::vector<std::string> kCorridors = {".......",  //
                                             ".#####.",  //
                                             ".......",  //
                                             ".#####.",  //
                                             "......."};

TEST_F(ReplanTest, AMapUpdateThatBlocksThePathTriggersAReplan) {
  startPlanner();
  publishMap(kCorridors);
  placeVehicleAndWait(0.5, 2.5);
  sendGoal(poseAt(6.5, 2.5));
  ASSERT_TRUE(passesCell(3, 2)) << "straight on";
  const std::size_t statistics = statistics_.count();
  const std::size_t paths = paths_.count();
  sendUpdate(3, 2, 1, 1, {100});
  waitForAnswer(statistics, paths);
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_FALSE(passesCell(3, 2));
  EXPECT_TRUE(passesCell(3, 0) || passesCell(3, 4));
  EXPECT_TRUE(endsAt(path_.poses.front(), 0.5, 2.5));
}

// The goal was placed anew with every plan: two metres ahead of the vehicle, wherever that was by then.
TEST_F(ReplanTest, AGoalInTheVehiclesFrameStandsWhereThatWas) {
  startPlanner();
  publishMap(kCorridors);
  placeVehicleAndWait(0.5, 2.5);
  sendGoal(poseAt(4.0, 0.0, 0.0, "base_link"));
  ASSERT_TRUE(endsAt(path_.poses.back(), 4.5, 2.5)) << answer_.message;
  placeVehicleAndWait(1.5, 2.5);
  const std::size_t statistics = statistics_.count(), paths = paths_.count();
  sendUpdate(3, 2, 1, 1, {100});
  waitForAnswer(statistics, paths);
  EXPECT_TRUE(endsAt(path_.poses.front(), 1.5, 2.5));
  EXPECT_TRUE(endsAt(path_.poses.back(), 4.5, 2.5));
}

// A vehicle that had reached its goal drove there again when the map changed: a driver could not tell
// a path that is planned again from one for a new goal.
TEST_F(ReplanTest, TheLastPoseIsStampedWithWhenTheGoalWasGiven) {
  startPlanner();
  publishMap(kCorridors);
  placeVehicleAndWait(0.5, 2.5);
  const ros::Time before = ros::Time::now();
  sendGoal(poseAt(6.5, 2.5));
  const ros::Time given = path_.poses.back().header.stamp;
  EXPECT_GE(given, before);
  EXPECT_LE(given, path_.header.stamp);
  const std::size_t statistics = statistics_.count();
  const std::size_t paths = paths_.count();
  sendUpdate(3, 2, 1, 1, {100});
  waitForAnswer(statistics, paths);
  EXPECT_EQ(path_.poses.back().header.stamp, given) << "the same goal";
  sendGoal(poseAt(6.5, 2.5));
  EXPECT_GT(path_.poses.back().header.stamp, given) << "given once more";
}

// The path kept the frame of the map that it was planned on, and its coordinates were looked up in a map of
// another frame: the vehicle was led through a wall.
TEST_F(ReplanTest, AWallInAMapOfAnotherFrameBlocksThePath) {
  startPlanner();
  publishMap(kCorridors);
  placeVehicleAndWait(0.5, 2.5);
  publishTransform("map", "odom", 0.0, -5.0, 0.0, 0.0);
  ASSERT_TRUE(test::waitFor([&] {
    makePlan({}, poseAt(0.5, 7.5, 0.0, "odom"));
    return answer_.status == "FOUND";
  }));
  sendGoal(poseAt(6.5, 2.5));
  ASSERT_TRUE(passesCell(3, 2)) << "straight on";
  OccupancyGrid map(GridGeometry(7, 12, 1.0), 0);
  map[Cell{3, 7}] = 100;  // row 2 of the map before
  const std::size_t statistics = statistics_.count(), paths = paths_.count();
  publishMap(map, "odom");
  waitForAnswer(statistics, paths);
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_EQ(path_.header.frame_id, "odom");
  EXPECT_TRUE(endsAt(path_.poses.front(), 0.5, 7.5));
  EXPECT_FALSE(passesCell(3, 7));
}

// navigation #750: stop when planning fails.
TEST_F(ReplanTest, AWholeMapThatClosesEveryCorridorEmptiesThePath) {
  startPlanner();
  publishMap(kCorridors);
  placeVehicleAndWait(0.5, 2.5);
  sendGoal(poseAt(6.5, 2.5));
  const std::size_t statistics = statistics_.count();
  const std::size_t paths = paths_.count();
  publishMap({"...#...", ".#####.", "...#...", ".#####.", "...#..."});
  waitForAnswer(statistics, paths);
  EXPECT_EQ(answer_.status, "UNREACHABLE");
  expectStampedAndEmpty(path_);
}

// By the code: the path stayed, FOUND and OK, since nothing that follows a map was done with one that has no room.
TEST_F(ReplanTest, AMapThatTakesTooMuchMemoryEmptiesThePath) {
  startPlanner({"_memory_limit:=20"});
  publishMap(kCorridors);
  placeVehicleAndWait(0.5, 2.5);
  sendGoal(poseAt(6.5, 2.5));
  ASSERT_EQ(answer_.status, "FOUND");
  OccupancyGrid map(GridGeometry(3000, 3000, 1.0), 0);
  for (int row = 0; row < 3000; ++row) map[Cell{3, row}] = 100;
  const std::size_t statistics = statistics_.count(), paths = paths_.count();
  maps_.publish(occupancyToMessage(map, "map", ros::Time::now()));
  waitForAnswer(statistics, paths);
  EXPECT_EQ(answer_.status, "INVALID_REQUEST");
  EXPECT_NE(answer_.message.find("memory_limit"), std::string::npos) << answer_.message;
  expectStampedAndEmpty(path_);
}

TEST_F(ReplanTest, UpdatesOlderThanTheMapAreDroppedAndThoseOutOfItRefused) {
  startPlanner();
  const ros::Time now = ros::Time::now();
  publishMap(AsciiMap(kCorridors).map, "map", now);
  sendUpdate(3, 2, 1, 1, {100}, now - ros::Duration(1.0));
  ASSERT_TRUE(logged("was dropped: the map is newer", 0));
  sendUpdate(6, 4, 2, 1, {100, 100}, now);
  ASSERT_TRUE(logged("does not lie in the map of 7x5", 0));
  makePlan(poseAt(0.5, 2.5), poseAt(6.5, 2.5));
  EXPECT_TRUE(passesCell(3, 2)) << "the map is as it was";
  const std::size_t seen = planning_maps_.count();
  sendUpdate(3, 2, 1, 1, {100}, now);
  ASSERT_TRUE(planning_maps_.waitForMoreThan(seen));
  makePlan(poseAt(0.5, 2.5), poseAt(6.5, 2.5));
  EXPECT_FALSE(passesCell(3, 2)) << "an update as old as the map is taken";
}

// navigation2 #2381, #2085, navigation #1194: replans flip left and right.
// The heartbeat of projected_map: an update of no cells was dropped with a warning as older than the
// map, or was a change of the map that everything was made anew for.
TEST_F(ReplanTest, AHeartbeatIsNoChangeOfTheMap) {
  startPlanner();
  const auto beat = [&] {
    for (const ros::Time& stamp : {ros::Time(0), ros::Time::now(), ros::TIME_MAX})
      sendUpdate(0, 0, 0, 0, {}, stamp);
  };
  beat();
  publishMap(kCorridors);
  const std::size_t maps = planning_maps_.count();
  beat();
  sendUpdate(3, 2, 1, 1, {100});
  const auto changed = planning_maps_.waitForMoreThan(maps);
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->data[2 * 7 + 3], 100) << "nothing was published for the heartbeats";
  for (const rosgraph_msgs::Log& line : log_.all()) {
    const bool is_of_the_master = line.msg.find("The master at") == 0;  // on a busy machine
    EXPECT_TRUE(line.level < line.WARN || is_of_the_master) << line.msg;
  }
}

// A lost update went unnoticed: until the next whole map, which might never come, plans led through
// what it had occupied.
TEST_F(ReplanTest, ALostUpdateIsNoticedAndAWholeMapAskedFor) {
  startPlanner();
  publishMap(kCorridors);
  updates_.shutdown();
  maps_.shutdown();
  std::atomic<int> links{0};
  maps_ = nh_.advertise<nav_msgs::OccupancyGrid>(
      "projected_map", 1, [&](const ros::SingleSubscriberPublisher&) { ++links; });
  auto numbered = ros::AdvertiseOptions::create<map_msgs::OccupancyGridUpdate>(
      "projected_map_updates", 10, {}, {}, {}, nullptr);
  numbered.has_header = false;  // header.seq is the test's
  updates_ = nh_.advertise(numbered);
  ASSERT_TRUE(test::waitFor([&] { return updates_.getNumSubscribers() > 0 && links > 0; }));
  const int before = links;
  sendNumbered(1);
  sendNumbered(2);
  sendNumbered(4);
  EXPECT_TRUE(logged("1 updates of the map were lost", 0));
  EXPECT_TRUE(test::waitFor([&] { return links > before; })) << "subscribes anew";
  ASSERT_TRUE(test::waitFor([&] { return maps_.getNumSubscribers() > 0; }));
  publishMap({".......", ".......", ".......", ".......", "......#"});
}

// A whole map that was sent before an update, and came after it since it takes longer, took the update's obstacle away.
TEST_F(ReplanTest, AWholeMapThatAnUpdateOvertookIsTakenWithIt) {
  startPlanner();
  const ros::Time now = ros::Time::now();
  publishMap(AsciiMap(kCorridors).map, "map", now - ros::Duration(3.0));
  const std::size_t seen = planning_maps_.count();
  sendUpdate(3, 2, 1, 1, {100}, now - ros::Duration(1.0));
  ASSERT_TRUE(planning_maps_.waitForMoreThan(seen));
  auto overtaken = AsciiMap(kCorridors).map;
  overtaken[Cell{6, 4}] = 100;
  publishMap(overtaken, "map", now - ros::Duration(2.0));
  makePlan(poseAt(0.5, 2.5), poseAt(6.5, 2.5));
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_FALSE(passesCell(3, 2));
  makePlan(poseAt(0.5, 2.5), poseAt(6.5, 4.5));
  EXPECT_NE(answer_.status, "FOUND") << "the rest of the whole map counts";
  for (const rosgraph_msgs::Log& line : log_.all())
    EXPECT_EQ(line.msg.find("a whole map is asked for"), std::string::npos) << line.msg;
}

TEST_F(ReplanTest, APathIsKeptWhileItIsAboutAsGoodAndReplacedWhenItIsNot) {
  startPlanner({"_replan_period:=0.02", "_replan_hysteresis:=0.2"});
  publishMap({"...........", ".....#.....", "...........", ".....#.....", "..........."});
  placeVehicleAndWait(0.5, 2.5);
  sendGoal(poseAt(10.5, 2.5));
  ASSERT_TRUE(passesCell(5, 2));
  const std::size_t statistics = statistics_.count();
  const std::size_t paths = paths_.count();
  // Nearer to one side and then to the other: other paths now cost the least, by less than a fifth.
  for (int i = 0; i < 30; ++i) {
    placeVehicle(0.5 + 0.1 * i, i % 2 == 0 ? 1.5 : 3.5);
    EXPECT_FALSE(
        test::waitFor([&] { return paths_.count() > paths; }, std::chrono::milliseconds(30)))
        << "after move " << i;
  }
  // The straight path becomes costly (unknown), so that the new one is cheaper by more than that.
  sendUpdate(4, 2, 3, 1, {-1, -1, -1});
  waitForAnswer(statistics, paths);
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_FALSE(passesCell(5, 2));
}

// navigation #949, navigation2 #2002: the old goal's plan for the new goal.
TEST_F(ReplanTest, ALateResultForAnOldGoalIsDropped) {
  startPlanner({"_timeout:=0", "_planner:=lazy_theta_star"});
  OccupancyGrid map(GridGeometry(2500, 2500, 1.0), 0);
  for (int row = 0; row < 2500; ++row) map[Cell{2498, row}] = 100;
  publishMap(map);
  placeVehicleAndWait(0.5, 0.5);
  const std::size_t statistics = statistics_.count();
  // No path: lazy_theta_star searches all of the map, for seconds, where a jump planner sees at
  // once that there is none and rightly answers before the second goal comes.
  goals_.publish(poseAt(2499.5, 1.5));
  goals_.publish(poseAt(5.5, 0.5));
  const auto answered = statistics_.waitFor(
      statistics, [](const PlanStatistics& answer) { return answer.goal.pose.position.x == 5.5; });
  ASSERT_TRUE(answered);
  EXPECT_EQ(answered->status, "FOUND");
  makePlan(poseAt(0.5, 0.5), poseAt(1.5, 0.5));  // comes after whatever was being planned
  for (const PlanStatistics& answer : statistics_.all())
    EXPECT_NE(answer.goal.pose.position.x, 2499.5) << answer.status;
  EXPECT_EQ(paths_.count(), 1u);
}

TEST_F(ReplanTest, AGoalWithoutAPathIsTriedAgainEveryPeriod) {
  startPlanner({"_replan_period:=0.05"});
  publishMap({"..#..", "..#..", "..#.."});
  placeVehicleAndWait(0.5, 0.5);
  sendGoal(poseAt(4.5, 0.5));
  ASSERT_EQ(answer_.status, "UNREACHABLE");
  sendUpdate(2, 0, 1, 1, {0});
  ASSERT_TRUE(paths_.waitFor(0, [](const nav_msgs::Path& path) { return !path.poses.empty(); }));
}

// It was given up: a door that opened later was of no use to a goal that had been given before.
TEST_F(ReplanTest, AGoalWithoutAPathStandsUntilTheMapHasOne) {
  startPlanner();
  publishMap({"..#..", "..#..", "..#.."});
  placeVehicleAndWait(0.5, 0.5);
  const std::size_t seen = log_.count();
  sendGoal(poseAt(4.5, 0.5));
  ASSERT_EQ(answer_.status, "UNREACHABLE");
  bool is_seldom = false;  // where this test is kept waiting between two changes, each may be tried
  for (int round = 0; round < 5 && !is_seldom; ++round) {
    const std::size_t answers = statistics_.count();
    for (int i = 0; i < 20; ++i) sendUpdate(0, 2, 1, 1, {static_cast<std::int8_t>(i % 2 * 100)});
    ASSERT_TRUE(statistics_.waitForMoreThan(answers)) << "it is tried again";
    is_seldom = statistics_.count() <= answers + 3;
  }
  EXPECT_TRUE(is_seldom) << "and not once for every change";
  sendUpdate(2, 0, 1, 1, {0});
  ASSERT_TRUE(paths_.waitFor(0, [](const nav_msgs::Path& path) { return !path.poses.empty(); }));
  ASSERT_TRUE(logged("FOUND", seen));
  const auto lines = log_.all();
  EXPECT_EQ(std::count_if(lines.begin() + static_cast<long>(seen), lines.end(),
                          [](const rosgraph_msgs::Log& line) {
                            return line.msg.find("UNREACHABLE") != std::string::npos;
                          }),
            1)
      << "one warning, not one a try";
}

TEST_F(ReplanTest, AGoalBeforeTheFirstMapStands) {
  startPlanner();
  placeVehicle(0.5, 0.5);
  sendGoal(poseAt(4.5, 0.5));
  ASSERT_EQ(answer_.status, "NO_MAP");
  publishMap({".....", "....."});
  ASSERT_TRUE(paths_.waitFor(0, [](const nav_msgs::Path& path) { return !path.poses.empty(); }));
}

// A goal that came before the localiser had a pose was answered with TRANSFORM_ERROR and forgotten:
// a map that stands never changes.
TEST_F(ReplanTest, AGoalBeforeTheFirstTransformStands) {
  startPlanner({"_tf_timeout:=0.3"});
  publishMap({".....", "....."});
  sendGoal(poseAt(4.5, 0.5));
  ASSERT_EQ(answer_.status, "TRANSFORM_ERROR");
  const std::size_t answers = statistics_.count();
  ASSERT_TRUE(test::waitFor([&] {
    placeVehicle(0.5, 0.5);
    const std::vector<nav_msgs::Path> paths = paths_.all();
    return !paths.empty() && !paths.back().poses.empty();
  }));
  EXPECT_LE(statistics_.count(), answers + 2) << "nothing is tried before there are transforms";
}

// A radius that was raised changed nothing until the next goal.
TEST_F(ReplanTest, AChangedParameterPlansTheGoalAnew) {
  startPlanner();
  publishMap({".....", ".....", "..#..", ".....", "....."});
  placeVehicleAndWait(0.5, 2.5);
  sendGoal(poseAt(4.5, 2.5));
  ASSERT_EQ(answer_.status, "FOUND");
  const double near = answer_.clearance_m;
  const std::size_t statistics = statistics_.count(), paths = paths_.count();
  dynamic_reconfigure::Reconfigure call;
  call.request.config.doubles.resize(1);
  call.request.config.doubles[0].name = "radius";
  call.request.config.doubles[0].value = 0.9;
  ASSERT_TRUE(ros::service::call("/path_planner/set_parameters", call));
  waitForAnswer(statistics, paths);
  EXPECT_LT(near, 0.9);
  EXPECT_GE(answer_.clearance_m, 0.9);
}

// It changed nothing: only a goal that had its answer was planned anew.
TEST_F(ReplanTest, AParameterThatChangesWhileTheGoalIsPlannedPlansItAnew) {
  startPlanner({"_tf_timeout:=60"});
  publishMap(kCorridors);
  placeVehicleAndWait(0.5, 2.5);
  const std::size_t seen = log_.count();
  goals_.publish(poseAt(6.5, 2.5, 0.0, "late"));
  ASSERT_TRUE(logged("Waiting for tf: no transform from late to map", seen));
  dynamic_reconfigure::Reconfigure call;
  call.request.config.strs.resize(1);
  call.request.config.strs[0].name = "heading";
  call.request.config.strs[0].value = "backward";
  ASSERT_TRUE(ros::service::call("/path_planner/set_parameters", call));
  publishTransform("map", "late", 0.0, 0.0, 0.0, 0.0);
  EXPECT_TRUE(paths_.waitFor(0, [](const nav_msgs::Path& path) {
    return path.poses.size() > 2 && std::abs(path.poses[1].pose.orientation.z) > 0.99;
  })) << "the vehicle looks back";
}

// With a large tf_timeout nothing was said before its end.
TEST_F(ReplanTest, AGoalThatAnUnknownFrameHoldsUpIsWarnedOf) {
  startPlanner({"_tf_timeout:=30"});
  publishMap(kCorridors);
  const std::size_t seen = log_.count();
  goals_.publish(poseAt(6.5, 2.5, 0.0, "nowhere"));
  EXPECT_TRUE(logged("Waiting for tf: no transform from nowhere to map", seen));
}

}  // namespace
}  // namespace grid_path_planner::nodes
