// path_planner tells the map that it searches as rectangles, where that is wanted.
#include <dynamic_reconfigure/Reconfigure.h>
#include <visualization_msgs/MarkerArray.h>

#include <optional>

#include "grid_path_planner/planners/decomposition.h"
#include "ros/planning/rectangle_messages.h"
#include "ros/support/planner_fixture.h"
#include "support/free_cells.h"

namespace grid_path_planner::nodes {

using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;
using planners::largestFirst;
using planners::Touching;

namespace {

using test::AsciiMap;
using test::kRoom;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

class PathPlannerRectanglesTest : public test::PlannerTest {
 protected:
  // What is published after `seen` messages of each topic must be the decomposition of `lines`.
  void expectRectanglesOf(const std::vector<std::string>& lines, std::size_t seen) {
    const std::vector<CellRect> expected =
        largestFirst(test::bitMapsOf(test::freeCells(lines)), {}, StopToken());
    const auto told = maps_told_->waitFor(seen, [&](const RectangleMap& message) {
      return rectanglesFromMessage(message, Touching::BORDERS).rectangles() == expected;
    });
    ASSERT_TRUE(told);
    EXPECT_EQ(told->header.frame_id, "map");
    EXPECT_FALSE(told->header.stamp.isZero());
    EXPECT_EQ(told->info.height, lines.size());
    const auto shown = markers_.waitFor(seen, [&](const MarkerArray& array) {
      return array.markers.size() == 3 + expected.size();
    });
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->markers[0].action, Marker::DELETEALL);
    EXPECT_EQ(shown->markers[1].points.size(), 6 * expected.size());
    EXPECT_EQ(shown->markers[2].points.size(), 8 * expected.size());
  }
  void setWanted(bool wanted) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::BoolParameter parameter;
    parameter.name = "publish_rectangles";
    parameter.value = wanted;
    call.request.config.bools.push_back(parameter);
    ASSERT_TRUE(ros::service::call("/path_planner/set_parameters", call));
  }

  std::optional<test::Latest<RectangleMap>> maps_told_{std::in_place, nh_, "rectangle_map"};
  test::Latest<MarkerArray> markers_{nh_, "rectangle_markers"};
};

TEST_F(PathPlannerRectanglesTest, TheSearchedMapIsToldAndToldAgainWhenItChanges) {
  startPlanner({"_publish_rectangles:=true"});
  publishMap(kRoom);
  expectRectanglesOf(kRoom, 0);
  std::size_t seen = maps_told_->count();
  publishMap({"#..", ".#."});
  expectRectanglesOf({"#..", ".#."}, seen);

  seen = maps_told_->count();
  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = "map";
  update.header.stamp = ros::Time::now();
  update.x = 1;
  update.width = update.height = 1;
  update.data = {100};
  updates_.publish(update);
  expectRectanglesOf({"##.", ".#."}, seen);
}

TEST_F(PathPlannerRectanglesTest, AreOfTheMapAsSearched) {
  startPlanner({"_publish_rectangles:=true", "_unknown_is_passable:=false", "_kernel:=2"});
  publishMap({"......?.", "........", "..#.....", "........"});
  const auto told = maps_told_->waitForMoreThan(0);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->info.width, 4u);
  EXPECT_EQ(told->info.resolution, 2.0F);
  EXPECT_EQ(rectanglesFromMessage(*told, Touching::BORDERS).freeCells(), 6u);
}

TEST_F(PathPlannerRectanglesTest, NothingIsToldUnlessWantedAndThatMayChange) {
  startPlanner();
  publishMap(kRoom);
  makePlan(test::poseAt(0.5, 0.5), test::poseAt(5.5, 2.5));
  EXPECT_FALSE(maps_told_->connected());
  EXPECT_FALSE(markers_.connected());
  setWanted(true);
  expectRectanglesOf(kRoom, 0);
  const std::size_t markers = markers_.count();
  setWanted(false);
  const auto cleared = markers_.waitForMoreThan(markers);
  ASSERT_TRUE(cleared) << "rviz would keep them";
  ASSERT_EQ(cleared->markers.size(), 1u);
  EXPECT_EQ(cleared->markers[0].action, visualization_msgs::Marker::DELETEALL);
  maps_told_.reset();  // who comes now gets nothing that is out of date
  maps_told_.emplace(nh_, "rectangle_map");
  EXPECT_TRUE(test::waitFor([&] { return maps_told_->connected(); }));
  setWanted(true);
  expectRectanglesOf(kRoom, 0);
  EXPECT_EQ(maps_told_->count(), 1u);
}

// Noise takes many times as long to cut as a path to find: the answer is there before, once the planner
// has seen the map (a Debug build prepares a planner for longer than it cuts).
TEST_F(PathPlannerRectanglesTest, PlansDoNotWaitForTheRectangles) {
  startPlanner({"_publish_rectangles:=true", "_timeout:=20"});  // a Debug build took more than 5 s
  std::mt19937 random(1);
  OccupancyGrid noise(GridGeometry(2000, 2000, 1.0));
  for (std::int8_t& value : noise.values()) value = random() % 3 == 0 ? 100 : 0;
  noise[Cell{0, 0}] = noise[Cell{1, 0}] = 0;
  publishMap(noise);
  makePlan(test::poseAt(0.5, 0.5), test::poseAt(1.5, 0.5));
  ASSERT_TRUE(maps_told_->waitForMoreThan(0));
  noise[Cell{1000, 1000}] ^= 100;
  publishMap(noise);
  makePlan(test::poseAt(0.5, 0.5), test::poseAt(1.5, 0.5));
  EXPECT_EQ(answer_.status, "FOUND");
  const auto told = maps_told_->waitForMoreThan(1);
  ASSERT_TRUE(told);
  EXPECT_GT(told->header.stamp, answer_.header.stamp);
  EXPECT_GT(told->rectangles.size(), 100000u);
}

TEST_F(PathPlannerRectanglesTest, AMapThatWouldTakeTooMuchMemoryIsRefused) {
  startPlanner({"_publish_rectangles:=true", "_memory_limit:=5"});  // costmaps take 4
  publishMap(kRoom);
  expectRectanglesOf(kRoom, 0);
  OccupancyGrid stripes(GridGeometry(600, 600, 1.0));
  for (std::size_t i = 0; i < stripes.values().size(); i += 2) stripes.values()[i] = 100;
  const std::size_t seen = log_.count();
  publishMap(stripes);
  EXPECT_TRUE(log_.waitFor(seen, [](const rosgraph_msgs::Log& line) {
    return line.msg.find("more than memory_limit, 5 MB: they are not published") !=
           std::string::npos;
  }));
  EXPECT_EQ(maps_told_->count(), 1u);
}

}  // namespace
}  // namespace grid_path_planner::nodes
