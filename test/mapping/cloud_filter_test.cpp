#include "grid_path_planner/mapping/cloud_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "grid_path_planner/mapping/octree_map.h"
#include "mapping/insertion/ground_filter.h"
#include "support/error_text.h"
#include "support/option_laws.h"

namespace grid_path_planner::mapping {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

// A noisy floor `z` below the origin that leans by `tilt` (rad) and a box that stands on it, by
// turns.
Points floorWithBox(double z, double tilt, int size = 20) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.005);
  Points points;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      const double x = 1.0 + 0.2 * i;
      points.emplace_back(x, 0.2 * (j - size / 2), z + std::tan(tilt) * x + noise(random));
      points.emplace_back(3.0, 0.05 * j, z + 0.3 + std::tan(tilt) * 3.0 + 0.05 * i);
    }
  return points;
}

int groundOf(const GroundSplit& split) {
  return static_cast<int>(std::count(split.is_ground.begin(), split.is_ground.end(), true));
}

TEST(CloudFilter, OptionsHoldTheirLaws) {
  test::expectOptionLaws<CloudFilterOptions>();
  CloudFilterOptions options;
  options.min_z = 2.0;
  options.max_z = 1.0;
  EXPECT_TRUE(test::contains(test::errorText([&] { checkCloudFilterOptions(options); }),
                             "pointcloud_min_z must not be above pointcloud_max_z"));
}

TEST(CloudFilter, PointsAreMovedIntoTheFrameOfTheTree) {
  CloudFrames frames;
  frames.map_from_sensor =
      at(10.0, 0.0, 1.0) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  const Scan scan = filterCloud({{2.0, 0.0, 0.5}}, frames, {}).scan;
  EXPECT_EQ(scan.origin, octomap::point3d(10.0F, 0.0F, 1.0F));
  ASSERT_EQ(scan.hits.size(), 1u);
  EXPECT_LT((scan.hits[0] - octomap::point3d(10.0F, 2.0F, 1.5F)).norm(), 1e-6);
}

// octomap_mapping's filters dropped points, and with them what their rays had seen through.
TEST(CloudFilter, FilteredPointsStillClearTheRay) {
  CloudFilterOptions options;
  options.max_z = 1.0;
  const Scan scan = filterCloud({{4.0, 0.0, 4.0}, {4.0, 0.0, 0.5}}, {}, options).scan;
  EXPECT_EQ(scan.hits.size(), 1u);
  ASSERT_EQ(scan.clear_only.size(), 1u);
  OctreeMap map(OctreeOptions{});
  map.insert(scan);
  EXPECT_NE(map.tree().search(2.0, 0.0, 2.0), nullptr) << "seen through";
  const auto* end = map.tree().search(3.99, 0.0, 3.99);
  EXPECT_TRUE(end == nullptr || !map.tree().isNodeOccupied(end));
}

// octomap_mapping#82: the frame in which points were filtered changed with filter_ground.
TEST(CloudFilter, OM82TheBoxStandsInTheMapWhetherGroundIsFilteredOrNot) {
  CloudFilterOptions options;
  options.min_z = 5.0;
  CloudFrames frames;
  frames.map_from_sensor = at(0.0, 0.0, 5.5);
  frames.base_from_map = at(0.0, 0.0, -5.0);
  const Points points = floorWithBox(-0.5, 0.0);
  for (const bool filter_ground : {false, true}) {
    options.filter_ground = filter_ground;
    const Scan scan = filterCloud(points, frames, options).scan;
    for (const octomap::point3d& hit : scan.hits) EXPECT_GE(hit.z(), 5.0F);
    EXPECT_EQ(scan.hits.size() + scan.clear_only.size(), points.size());
  }
}

TEST(GroundFilter, FindsALeaningFloorAndLeavesWhatStandsOnIt) {
  for (const double tilt : {0.0, 0.02, -0.02}) {
    const GroundSplit split = splitGround(floorWithBox(-0.01, tilt), {});
    EXPECT_TRUE(split.plane_found);
    EXPECT_EQ(groundOf(split), 400) << tilt;
    for (std::size_t i = 0; i < split.is_ground.size(); ++i)
      ASSERT_EQ(split.is_ground[i], i % 2 == 0);
  }
}

TEST(GroundFilter, ASteepPlaneAndATableAreNoGround) {
  EXPECT_FALSE(splitGround(floorWithBox(-3.0, 0.3), {}).plane_found) << "leans more than 0.15 rad";
  EXPECT_FALSE(splitGround(floorWithBox(-0.5, 0.0), {}).plane_found)
      << "half a metre from the base's origin";
}

TEST(GroundFilter, WithoutAPlaneWhatIsNearZeroIsGround) {
  Points points;
  for (int i = 0; i < 100; ++i) points.emplace_back(0.1 * i, 0.0, i < 7 ? 0.05 : 1.0 + 0.1 * i);
  const GroundSplit split = splitGround(points, {});
  EXPECT_FALSE(split.plane_found);
  EXPECT_EQ(groundOf(split), 7);
}

TEST(GroundFilter, FewPointsHaveNoGround) {
  EXPECT_EQ(groundOf(splitGround(Points(49, Eigen::Vector3d::Zero()), {})), 0);
  EXPECT_TRUE(splitGround({}, {}).is_ground.empty());
  EXPECT_FALSE(splitGround(Points(500, Eigen::Vector3d::Zero()), {}).plane_found) << "one place";
}

TEST(GroundFilter, TheSamePointsGiveTheSameSplit) {
  const Points points = floorWithBox(-0.01, 0.02);
  EXPECT_EQ(splitGround(points, {}).is_ground, splitGround(points, {}).is_ground);
}

}  // namespace
}  // namespace grid_path_planner::mapping
