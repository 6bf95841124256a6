// A vehicle that is not round, through the node: its parameter as users of costmap_2d write it, changes of it, and a map that
// closes beside the path.
#include <dynamic_reconfigure/Reconfigure.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::OccupancyGrid;

namespace {

using test::AsciiMap;
using test::poseAt;

// A wall between x = 3 and x = 3.2 with a door of 0.8 m, in cells of 0.2 m.
OccupancyGrid mapWithADoor() {
  std::vector<std::string> lines(15, "...............#................");
  for (int row = 6; row < 10; ++row) lines[row] = "................................";
  return AsciiMap(lines, 0.2).map;
}

// As rosparam loads [[0.8, 0.3], ...].
XmlRpc::XmlRpcValue cornerList(double front, double side) {
  XmlRpc::XmlRpcValue list;
  const double corners[][2] = {{front, side}, {-front, side}, {-front, -side}, {front, -side}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 2; ++j) list[i][j] = corners[i][j];
  return list;
}

class FootprintTest : public test::PlannerTest {
 protected:
  void startWith(const XmlRpc::XmlRpcValue& footprint) {
    ros::param::del("/path_planner");
    ros::param::set("/path_planner/footprint", footprint);
    startPlanner(std::make_unique<test::Process>("path_planner", std::vector<std::string>()));
  }
  // The node's answer: the value in force.
  std::string reconfigure(const std::string& footprint) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::StrParameter parameter;
    parameter.name = "footprint";
    parameter.value = footprint;
    call.request.config.strs.push_back(parameter);
    EXPECT_TRUE(ros::service::call("/path_planner/set_parameters", call));
    for (const auto& value : call.response.config.strs)
      if (value.name == "footprint") return value.value;
    return "";
  }
  bool says(const std::string& text) const {
    return answer_.message.find(text) != std::string::npos;
  }
};

TEST_F(FootprintTest, AListParameterIsTakenAndTheVehicleDrivesStraightThroughTheDoor) {
  startWith(cornerList(0.7, 0.3));
  publishMap(mapWithADoor());
  makePlan(poseAt(1.1, 2.5), poseAt(5.1, 0.9));
  EXPECT_EQ(answer_.status, "FOUND");
  EXPECT_TRUE(says("the footprint fits")) << answer_.message;
  std::string text;
  ASSERT_TRUE(ros::param::get("/path_planner/footprint", text));
  EXPECT_EQ(text, "[[0.7, 0.3], [-0.7, 0.3], [-0.7, -0.3], [0.7, -0.3]]");
  makePlan(poseAt(1.1, 2.5), poseAt(3.1, 1.5, M_PI / 2));
  EXPECT_EQ(answer_.status, "GOAL_OCCUPIED");
  EXPECT_TRUE(says("with heading 90 deg: the footprint meets the occupied cell at"))
      << answer_.message;
}

TEST_F(FootprintTest, ANewFootprintPlansTheGoalAnewAndABadOneIsRefused) {
  startPlanner();
  publishMap(mapWithADoor());
  placeVehicleAndWait(1.1, 1.5);
  sendGoal(poseAt(5.1, 1.5));
  EXPECT_EQ(answer_.status, "FOUND");
  std::size_t statistics = statistics_.count(), paths = paths_.count();
  const std::string wide = "[[0.6, 0.5], [-0.6, 0.5], [-0.6, -0.5], [0.6, -0.5]]";
  EXPECT_EQ(reconfigure(wide), wide);
  waitForAnswer(statistics, paths);
  EXPECT_EQ(answer_.status, "UNREACHABLE") << "1 m wide";
  EXPECT_EQ(reconfigure("[[0.6, 0.5], [-0.6, -0.5]]"), wide) << "the old one stays";
}

// A cell that the inscribed radius passes and the front does not.
TEST_F(FootprintTest, WhatComesBesideThePathTriggersAReplan) {
  startWith(cornerList(0.6, 0.3));
  OccupancyGrid map = mapWithADoor();
  publishMap(map);
  placeVehicleAndWait(1.1, 1.5);
  sendGoal(poseAt(5.1, 1.5));
  ASSERT_EQ(answer_.status, "FOUND");
  const std::size_t statistics = statistics_.count(), paths = paths_.count();
  map[Cell{28, 7}] = 100;  // 0.5 m before the goal
  publishMap(map);
  waitForAnswer(statistics, paths);
  EXPECT_EQ(answer_.status, "GOAL_OCCUPIED") << answer_.message;
}

TEST_F(FootprintTest, ItsOutlineMovesWithTheVehicle) {
  startWith(cornerList(0.7, 0.3));
  publishMap(mapWithADoor());
  placeVehicleAndWait(1.1, 1.5);
  test::Latest<visualization_msgs::MarkerArray> markers(nh_, "search_markers");
  ASSERT_TRUE(test::waitFor([&] { return markers.connected(); }));
  sendGoal(poseAt(5.1, 1.5));
  const auto shown = markers.waitForMoreThan(0);
  ASSERT_TRUE(shown && shown->markers.size() == 6u);
  EXPECT_EQ(shown->markers[4].type, visualization_msgs::Marker::LINE_STRIP);
  EXPECT_EQ(shown->markers[4].header.frame_id, "base_link");
  ASSERT_EQ(shown->markers[4].points.size(), 5u);
  EXPECT_EQ(shown->markers[4].points[4].x, 0.7);
}

}  // namespace
}  // namespace grid_path_planner::nodes
