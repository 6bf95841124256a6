// planning_map and planning_map_updates: who gets what of a map that changes. ~cost_to_go follows
// goal and map.
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <random>

#include "ros/messages/map_topic.h"
#include "ros/support/map_listeners.h"
#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

constexpr int kEdits = 100;
constexpr int kSide = 60;

class PlannerMaps : public test::PlannerTest {};

class PlanningMaps : public test::PlannerTest {
 protected:
  // The fixture and shown_ are one node, which takes updates.
  PlanningMaps() {
    startPlanner({"_full_map_period:=3600", "_decay:=0"});
    EXPECT_TRUE(test::waitFor([&] { return shown_.connected(); }));
    publishMap(map_);
    EXPECT_TRUE(editArrives());
  }

  // Sets a rectangle of the map to one value.
  void edit() {
    std::uniform_int_distribution<int> corner(0, kSide - 5), side(1, 4), value(0, 2);
    map_msgs::OccupancyGridUpdate update;
    update.header.frame_id = "map";
    update.header.stamp = ros::Time::now();
    update.x = corner(random_);
    update.y = corner(random_);
    update.width = static_cast<std::uint32_t>(side(random_));
    update.height = static_cast<std::uint32_t>(side(random_));
    const std::int8_t values[] = {-1, 0, 100};
    update.data.assign(update.width * update.height, values[value(random_)]);
    for (std::size_t i = 0; i < update.data.size(); ++i)
      map_[Cell{update.x + static_cast<int>(i % update.width),
                update.y + static_cast<int>(i / update.width)}] = update.data[i];
    updates_.publish(update);
  }

  bool editArrives() {
    edit();
    return arrives();
  }
  void editOften() {
    for (int i = 0; i < kEdits; ++i) ASSERT_TRUE(editArrives()) << "edit " << i;
  }

  // With no radius and no decay what is searched is shown as it is.
  bool arrives() const {
    return test::waitFor(
        [&] { return shown_.maps() > 0 && shown_.grid().values() == map_.values(); });
  }

  std::mt19937 random_{1404};
  // One cell keeps the largest weight in the map.
  OccupancyGrid map_ = [] {
    OccupancyGrid map(GridGeometry(kSide, kSide, 1.0));
    map[Cell{kSide - 1, kSide - 1}] = -1;
    return map;
  }();
  test::MapCopy shown_{nh_, "planning_map"};
};

TEST_F(PlanningMaps, UpdatesAreAllThatIsSentToWhoTakesThem) {
  const std::size_t maps = shown_.maps();
  editOften();
  EXPECT_GT(shown_.updates(), 0u);
  EXPECT_LE(shown_.maps(), maps + 1) << "but one that was being sent";
}

TEST_F(PlanningMaps, WhoTakesUpdatesAndWhoDoesNotHaveTheSameMap) {
  test::WholeMapListener other("/planning_map");
  ASSERT_TRUE(other.hasMap());
  const std::size_t updates = shown_.updates();
  editOften();
  EXPECT_EQ(shown_.updates(), updates) << "whole maps serve both";
  EXPECT_TRUE(test::waitFor([&] { return other.grid().values() == map_.values(); }));
}

// Two far edits were one rectangle, the whole map.
TEST_F(PlanningMaps, TwoCornersAreTwoRectangles) {
  map_[Cell{0, 0}] = map_[Cell{kSide - 1, kSide - 2}] = 100;
  const std::size_t updates = shown_.updates();
  maps_.publish(occupancyToMessage(map_, "map", ros::Time::now()));
  EXPECT_TRUE(arrives());
  EXPECT_EQ(shown_.updates(), updates + 2);
}

TEST_F(PlanningMaps, ANewSubscriberHasTheMapAsItIsAfterUpdates) {
  editOften();
  test::WholeMapListener late("/planning_map");
  ASSERT_TRUE(late.hasMap());
  EXPECT_TRUE(test::waitFor([&] { return late.grid().values() == map_.values(); }));
}

// As octomap_server does: its first map has no cells and no frame, each later one no orientation. The first was refused as
// bad, and so were all others.
TEST_F(PlannerMaps, OctomapServersAreTaken) {
  startPlanner();
  placeVehicle(0.5, 0.5);
  maps_.publish(nav_msgs::OccupancyGrid());
  sendGoal(test::poseAt(5.5, 0.5));
  EXPECT_EQ(answer_.status, "NO_MAP") << answer_.message;
  auto message = occupancyToMessage(test::AsciiMap(test::kRoom).map, "map", ros::Time::now());
  message.info.origin.orientation.w = 0.0;
  publishMap(message);
  makePlan({}, test::poseAt(5.5, 2.5));
  EXPECT_EQ(answer_.status, "FOUND") << answer_.message;
  maps_.publish(nav_msgs::OccupancyGrid());  // as its ~reset does
  map_msgs::OccupancyGridUpdate wall;
  wall.header.stamp = ros::Time::now();
  wall.x = 5;
  wall.width = 1;
  wall.height = 3;
  wall.data = {100, 100, 100};
  updates_.publish(wall);
  EXPECT_TRUE(test::waitFor([&] {
    makePlan({}, test::poseAt(5.5, 2.5));
    return answer_.status == "GOAL_OCCUPIED";
  })) << "the map before stays, and its updates are laid on it: "
      << answer_.message;
  for (const rosgraph_msgs::Log& line : log_.all())
    EXPECT_LT(line.level, rosgraph_msgs::Log::ERROR) << line.msg;
}

// gmapping's maps change their size and origin, and have no map_load_time.
TEST_F(PlannerMaps, AGoalThatStandsIsJudgedInEachNewMap) {
  startPlanner();
  placeVehicle(0.5, 0.5);
  const auto sendMap = [&](const std::vector<std::string>& picture, double x) {
    const std::size_t seen = statistics_.count(), seen_paths = paths_.count();
    auto message = occupancyToMessage(test::AsciiMap(picture, 1.0, {x, 0.0, 0.0}).map, "map",
                                      ros::Time::now());
    message.info.map_load_time = ros::Time();
    maps_.publish(message);
    return std::pair(seen, seen_paths);
  };
  sendMap({"......"}, 0.0);
  ASSERT_TRUE(planning_maps_.waitForMoreThan(0));
  sendGoal(test::poseAt(8.5, 0.5));
  EXPECT_EQ(answer_.status, "GOAL_OUTSIDE_MAP") << answer_.message;
  const auto grown = sendMap({"............"}, -2.0);
  waitForAnswer(grown.first, grown.second);
  EXPECT_EQ(answer_.status, "FOUND") << answer_.message;
  EXPECT_TRUE(endsAt(path_.poses.back(), 8.5, 0.5));
  const auto walled = sendMap({"........#......"}, -3.0);
  waitForAnswer(walled.first, walled.second);
  EXPECT_EQ(answer_.status, "UNREACHABLE") << answer_.message;
}

class CostsToGo : public test::PlannerTest {
 protected:
  using Map = nav_msgs::OccupancyGrid;
  using Values = std::vector<std::int8_t>;

  static constexpr char kTopic[] = "/path_planner/cost_to_go";

  static bool isOf(const Map& message, const Values& values) { return message.data == values; }
};

TEST_F(CostsToGo, AreOfTheGoalTheMapAndWhoeverComesLate) {
  startPlanner({"_decay:=0"});
  test::Latest<Map> first(nh_, kTopic);
  ASSERT_TRUE(test::waitFor([&] { return first.connected(); }));
  placeVehicle(0.5, 0.5);
  publishMap({"....."});
  sendGoal(test::poseAt(4.5, 0.5));
  const Values to_the_right = {100, 75, 50, 25, 0}, beyond_a_wall = {-1, -1, 100, 50, 0};
  ASSERT_TRUE(first.waitFor(0, [&](const Map& message) { return isOf(message, to_the_right); }));

  publishMap({".#..."});
  const auto told =
      first.waitFor(0, [&](const Map& message) { return isOf(message, beyond_a_wall); });
  ASSERT_TRUE(told) << "the vehicle has no path, others may have one";
  EXPECT_EQ(told->header.frame_id, "map");

  test::WholeMapListener late(kTopic);
  ASSERT_TRUE(late.hasMap());
  EXPECT_EQ(late.grid().values(), beyond_a_wall);
}

// A goal far outside the map, or in a frame that nobody knows, has no costs; the next one has.
TEST_F(CostsToGo, AGoalThatIsNowhereHasNone) {
  startPlanner({"_decay:=0", "_tf_timeout:=0.1"});
  test::Latest<Map> costs(nh_, kTopic);
  test::Latest<sensor_msgs::Image> images(nh_, "/path_planner/cost_to_go_image");
  ASSERT_TRUE(test::waitFor([&] { return costs.connected() && images.connected(); }));
  placeVehicle(0.5, 0.5);
  publishMap({"..."});
  sendGoal(test::poseAt(1e6, 0.5));
  sendGoal(test::poseAt(0.5, 0.5, 0.0, "nowhere"));
  sendGoal(test::poseAt(2.5, 0.5));
  const auto told = costs.waitForMoreThan(0);
  const auto image = images.waitForMoreThan(0);
  ASSERT_TRUE(told && image);
  EXPECT_TRUE(isOf(*told, {100, 50, 0}));
  EXPECT_EQ(costs.all().front().data, told->data) << "nothing was told before";
  EXPECT_EQ(image->encoding, "32FC1");
  EXPECT_EQ(image->width, 3u);
}

// What was latched when the last subscriber left is not the newest map that a later one gets first; who has
// subscribed stays.
TEST(MapTopic, WhatIsForgottenIsNotLatched) {
  ros::NodeHandle nh;
  const auto mapOf = [](std::int8_t value) {
    return occupancyToMessage(OccupancyGrid(GridGeometry(1, 1, 1.0), {value}), "map",
                              ros::Time::now());
  };
  MapTopic topic(nh, "forgotten_map", true, [] {});
  const test::Latest<nav_msgs::OccupancyGrid> early(nh, "forgotten_map");
  ASSERT_TRUE(test::waitFor([&] { return topic.takeNewSubscriber(); }));
  topic.send(mapOf(100));
  ASSERT_TRUE(early.waitForMoreThan(0));
  topic.forget();
  EXPECT_TRUE(topic.hasSubscribers());
  test::WholeMapListener late("/forgotten_map");
  ASSERT_TRUE(test::waitFor([&] { return topic.takeNewSubscriber(); }));
  topic.send(mapOf(0));
  ASSERT_TRUE(late.hasMap());
  EXPECT_EQ(late.firstGrid().values(), std::vector<std::int8_t>{0});
  EXPECT_TRUE(early.waitForMoreThan(1));
}

}  // namespace
}  // namespace grid_path_planner::nodes
