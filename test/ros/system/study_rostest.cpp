// The whole study in small, through the real nodes of demo.launch: a survey of a few metres, the
// octree, the 2-D map, a plan around a rock, the waypoint file, the drive.
#include <actionlib/client/simple_action_client.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <std_msgs/UInt32.h>

#include <cmath>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/SaveFile.h"
#include "grid_path_planner/SaveWaypoints.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/guard/node_files.h"
#include "ros/support/latest.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using grid::Occupancy;
using grid::OccupancyGrid;
using grid::OccupancyThresholds;
using grid::readMapFile;
using path::Path;
using path::readWaypointFile;
using path::writeWaypointFile;

namespace {

using nav_msgs::Odometry;
using test::Latest;

const Eigen::Vector3d kStart(4.0, -11.3, 2.9);  // where the survey ends
const Eigen::Vector2d kRock(5.5, -11.2);        // between start and goal
const Eigen::Vector3d kGoal(8.0, -12.0, 2.9);

// West above the rock, about, and down behind it.
Path surveyPath() {
  Path path;
  path.poses = {{{10.5, -11.5, 4.5}, M_PI},
                {{2.5, -11.5, 4.5}, M_PI},
                {{4.0, -11.3, 4.5}, 0.0},
                {kStart, 0.0}};
  return path;
}

class Study : public testing::Test {
 protected:
  bool survey() {
    writeWaypointFile(folder_.path("survey.yaml"), surveyPath());
    actionlib::SimpleActionClient<NavigatePathAction> client("/survey/navigate_path", true);
    if (!test::waitFor([&] { return client.isServerConnected(); })) return false;
    NavigatePathGoal goal;
    goal.filename = folder_.path("survey.yaml");
    client.sendGoal(goal);
    return test::waitFor([&] { return client.getState().isDone(); }, std::chrono::seconds(60)) &&
           client.getResult()->status == "ARRIVED";
  }

  Occupancy seenAt(const Eigen::Vector2d& point) {
    SaveFile call;
    call.request.filename = folder_.path("map.yaml");
    if (!ros::service::call("/projected_map/save_map", call) || !call.response.success)
      return Occupancy::UNKNOWN;
    const OccupancyGrid map = readMapFile(call.request.filename);
    return OccupancyThresholds().classify(map[*map.geometry().cellAt(point)]);
  }

  // Until the planner has the map and tf.
  bool plan() {
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "map";
    goal.pose.position.x = kGoal.x();
    goal.pose.position.y = kGoal.y();
    goal.pose.position.z = kGoal.z();
    goal.pose.orientation.w = 1.0;
    return test::waitFor([&] {
      const std::size_t seen = statistics_.count();
      goals_.publish(goal);
      const auto answer = statistics_.waitForMoreThan(seen);
      return answer && answer->status == "FOUND";
    });
  }

  double distanceTo(const Eigen::Vector3d& point) {
    const auto all = truth_.all();
    const auto& p = all.back().pose.pose.position;
    return (Eigen::Vector3d(p.x, p.y, p.z) - point).norm();
  }

  ros::NodeHandle nh_;
  const test::TemporaryFolder folder_{NodeFiles().saveFolder().path()};
  Latest<Odometry> truth_{nh_, "ground_truth"};
  Latest<std_msgs::UInt32> contacts_{nh_, "contacts"};
  Latest<PlanStatistics> statistics_{nh_, "plan_statistics"};
  Latest<nav_msgs::Path> paths_{nh_, "path"};
  ros::Publisher goals_ = nh_.advertise<geometry_msgs::PoseStamped>("/move_base_simple/goal", 1);
};

TEST_F(Study, SurveyMapPlanAndDrive) {
  ASSERT_TRUE(truth_.waitForMoreThan(0));
  ASSERT_TRUE(test::waitFor([&] {
    return goals_.getNumSubscribers() > 0 && paths_.connected() && statistics_.connected();
  }));
  ASSERT_TRUE(survey());
  EXPECT_LT(distanceTo(kStart), 0.1);
  EXPECT_TRUE(test::waitFor([&] { return seenAt(kRock) == Occupancy::OCCUPIED; })) << "the rock";
  EXPECT_TRUE(test::waitFor([&] { return seenAt(kGoal.head<2>()) == Occupancy::FREE; }));

  ASSERT_TRUE(plan());
  const auto path = paths_.waitFor(0, [](const nav_msgs::Path& p) { return !p.poses.empty(); });
  ASSERT_TRUE(path);
  for (const auto& pose : path->poses)
    EXPECT_GT(std::hypot(pose.pose.position.x - kRock.x(), pose.pose.position.y - kRock.y()), 0.4);
  SaveWaypoints call;
  call.request.filename = folder_.path("waypoints.yaml");
  ASSERT_TRUE(ros::service::call("/path_planner/save_waypoints", call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  EXPECT_EQ(readWaypointFile(call.request.filename).path.poses.back().position, kGoal);

  EXPECT_TRUE(test::waitFor([&] { return distanceTo(kGoal) < 0.1; }, std::chrono::seconds(40)));
  ASSERT_TRUE(contacts_.waitForMoreThan(0));
  EXPECT_EQ(contacts_.all().back().data, 0u);
}

}  // namespace
}  // namespace grid_path_planner::nodes
