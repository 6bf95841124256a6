#include "ros/mapping/octree_messages.h"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

namespace grid_path_planner::nodes {
namespace {

constexpr HeightRange kAllHeights{-1e3, 1e3};

// Under the sanitizers projected_map ended when its map was empty and someone asked for
// octomap_point_cloud_centers: the iterator over a cloud without points took a reference to its
// first byte.
TEST(OccupiedCentres, OfAnEmptyMapAreACloudWithoutPoints) {
  const sensor_msgs::PointCloud2 cloud = occupiedCentres(octomap::OcTree(0.1), kAllHeights);
  EXPECT_EQ(cloud.width, 0U);
  EXPECT_EQ(cloud.fields.size(), 3U);
  EXPECT_TRUE(cloud.data.empty());
}

TEST(OccupiedCentres, AreInsideOfTheHeights) {
  octomap::OcTree tree(0.1);
  tree.updateNode(0.05, 0.15, 0.25, true);
  tree.updateNode(0.05, 0.15, 5.05, true);
  tree.updateNode(0.05, 0.55, 0.25, false);
  const sensor_msgs::PointCloud2 cloud = occupiedCentres(tree, {0.0, 1.0});
  ASSERT_EQ(cloud.width, 1U);
  const sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x");
  EXPECT_FLOAT_EQ(x[0], 0.05F);
  EXPECT_FLOAT_EQ(x[1], 0.15F);
  EXPECT_FLOAT_EQ(x[2], 0.25F);
}

}  // namespace
}  // namespace grid_path_planner::nodes
