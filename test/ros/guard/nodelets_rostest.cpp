// map_publisher, projected_map and path_planner as nodelets of one manager.
#include <gtest/gtest.h>
#include <nav_msgs/GetPlan.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>

#include "ros/support/manager_client.h"
#include "ros/support/planner_fixture.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

TEST(Nodelets, PlanTogetherAndAreUnloaded) {
  test::ManagerClient manager("/manager");
  ASSERT_TRUE(test::waitFor([&] { return manager.loaded().size() == 3; }));
  nav_msgs::GetPlan call;
  call.request.start = test::poseAt(-1.5, -1.0);
  call.request.goal = test::poseAt(-0.2, -0.2);
  EXPECT_TRUE(test::waitFor([&] {  // until the map has come
    return ros::service::call("/path_planner/make_plan", call) && !call.response.plan.poses.empty();
  }));
  std_srvs::Empty reset;
  EXPECT_TRUE(ros::service::call("/octree_mapping/reset", reset));
  for (const char* name : {"/path_planner", "/octree_mapping", "/map_publisher"})
    EXPECT_TRUE(manager.unload(name)) << name;
  EXPECT_TRUE(manager.loaded().empty());
  EXPECT_FALSE(ros::service::exists("/path_planner/make_plan", false));
  EXPECT_FALSE(ros::service::exists("/octree_mapping/reset", false));
}

}  // namespace
}  // namespace grid_path_planner::nodes
