// test/data/survey.bag through projected_map and path_planner: a coarse camera's recording of the
// site whose map, seen by a finer camera on another run, is maps/dexrov_site.yaml.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/GetPlan.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "grid_path_planner/SaveFile.h"
#include "grid_path_planner/grid/map_file.h"
#include "ros/guard/node_files.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::Occupancy;
using grid::OccupancyGrid;
using grid::OccupancyThresholds;
using grid::readMapFile;

namespace {

using diagnostic_msgs::DiagnosticArray;
using test::Latest;

const std::string kBag = GPP_TEST_DATA "/survey.bag";

int cloudsInBag() {
  rosbag::Bag bag(kBag);
  return static_cast<int>(rosbag::View(bag, rosbag::TopicQuery("/depth_camera/points")).size());
}

bool isOccupied(const OccupancyGrid& map, Cell cell) {
  return OccupancyThresholds().classify(map[cell]) == Occupancy::OCCUPIED;
}

// Whether an occupied cell is within `reach` columns and rows of `cell`.
bool hasOccupiedNear(const OccupancyGrid& map, Cell cell, int reach) {
  for (int row = cell.row - reach; row <= cell.row + reach; ++row)
    for (int column = cell.column - reach; column <= cell.column + reach; ++column)
      if (map.geometry().contains(Cell{column, row}) && isOccupied(map, {column, row})) return true;
  return false;
}

// The share of the occupied cells of `map` that have one of `other` within `reach`.
double shareFoundIn(const OccupancyGrid& other, const OccupancyGrid& map, int reach) {
  int occupied = 0, found = 0;
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      if (!isOccupied(map, {column, row})) continue;
      ++occupied;
      if (hasOccupiedNear(other, {column, row}, reach)) ++found;
    }
  return occupied == 0 ? 0.0 : static_cast<double>(found) / occupied;
}

double shareKnown(const OccupancyGrid& map) {
  const auto unknown = std::count(map.values().begin(), map.values().end(), -1);
  return 1.0 - static_cast<double>(unknown) / static_cast<double>(map.values().size());
}

// What projected_map says of its clouds.
int countOf(const Latest<DiagnosticArray>& diagnostics, const std::string& key) {
  const std::vector<DiagnosticArray> all = diagnostics.all();
  for (auto array = all.rbegin(); array != all.rend(); ++array)
    for (const auto& status : array->status) {
      if (status.name.find("clouds") == std::string::npos) continue;
      for (const auto& pair : status.values)
        if (pair.key == key) return std::stoi(pair.value);
    }
  return -1;
}

class RecordedSurvey : public testing::Test {
 protected:
  // Once for all tests: the nodes of the launch file live as long as this program.
  static void SetUpTestSuite() {
    ros::NodeHandle nh;
    const int clouds = cloudsInBag();
    ASSERT_GT(clouds, 50);
    Latest<DiagnosticArray> diagnostics(nh, "/diagnostics");
    ASSERT_TRUE(test::waitFor([] {
      return ros::service::exists("/projected_map/save_map", false) &&
             ros::service::exists("/path_planner/make_plan", false);
    }));
    test::Process player(
        {"rosbag", "play", "--clock", "--quiet", "--wait-for-subscribers", "--rate=10", kBag});
    ASSERT_TRUE(player.waitForExit(std::chrono::seconds(60)));
    EXPECT_TRUE(test::waitFor(
        [&] {
          return countOf(diagnostics, "inserted") + countOf(diagnostics, "dropped") >= clouds - 2;
        },
        std::chrono::seconds(60)))
        << countOf(diagnostics, "inserted") << " clouds are in the map";
    EXPECT_LE(countOf(diagnostics, "dropped"), 2);
  }

  static OccupancyGrid savedMap() {
    const test::TemporaryFolder folder(NodeFiles().saveFolder().path());
    SaveFile call;
    call.request.filename = folder.path("map.yaml");
    EXPECT_TRUE(ros::service::call("/projected_map/save_map", call));
    EXPECT_TRUE(call.response.success) << call.response.message;
    return readMapFile(call.request.filename);
  }

  static geometry_msgs::PoseStamped poseAt(double x, double y, double z) {
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = "map";
    pose.pose.position.x = x;
    pose.pose.position.y = y;
    pose.pose.position.z = z;
    pose.pose.orientation.w = 1.0;
    return pose;
  }

  const OccupancyGrid committed_ = readMapFile(GPP_TEST_DATA "/../../maps/dexrov_site.yaml");
};

TEST_F(RecordedSurvey, BecomesTheSitesMap) {
  const OccupancyGrid map = savedMap();
  ASSERT_EQ(map.width(), committed_.width());
  ASSERT_EQ(map.height(), committed_.height());
  EXPECT_NEAR(map.geometry().origin().x, committed_.geometry().origin().x, 1e-6);
  EXPECT_NEAR(map.geometry().origin().y, committed_.geometry().origin().y, 1e-6);
  EXPECT_GT(shareKnown(map), 0.95);
  EXPECT_GT(shareFoundIn(committed_, map, 2), 0.98) << "nothing stands where nothing is";
  EXPECT_GT(shareFoundIn(map, committed_, 3), 0.98) << "what is there was seen";
}

// The path is planned on what the coarse camera saw; the finer map says what it passes.
TEST_F(RecordedSurvey, APathOnItKeepsClearOfWhatIsReallyThere) {
  nav_msgs::GetPlan call;
  call.request.start = poseAt(10.6115, -12.4845, 2.947);
  call.request.goal = poseAt(1.2191, 4.8549, 2.883);
  ASSERT_TRUE(test::waitFor([&] {  // until the planner has the last update
    return ros::service::call("/path_planner/make_plan", call) && !call.response.plan.poses.empty();
  }));
  const auto& poses = call.response.plan.poses;
  EXPECT_EQ(poses.front().pose.position.x, 10.6115);
  EXPECT_EQ(poses.back().pose.position.y, 4.8549);
  double length = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto& a = poses[i - 1].pose.position;
    const auto& b = poses[i].pose.position;
    length += std::hypot(b.x - a.x, b.y - a.y);
    const auto cell = committed_.geometry().cellAt({b.x, b.y});
    ASSERT_TRUE(cell) << b.x << ", " << b.y;
    EXPECT_FALSE(hasOccupiedNear(committed_, *cell, 4)) << b.x << ", " << b.y;  // 0.2 m
  }
  EXPECT_GT(length, 19.7) << "the straight line";
  EXPECT_LT(length, 36.0);
}

}  // namespace
}  // namespace grid_path_planner::nodes
