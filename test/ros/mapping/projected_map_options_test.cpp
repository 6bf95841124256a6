#include "grid_path_planner/mapping/projected_map_options.h"

#include <gtest/gtest.h>

#include "support/error_text.h"
#include "support/option_laws.h"

namespace grid_path_planner::nodes {

using mapping::checkProjectedMapOptions;
using mapping::ProjectedMapOptions;
using mapping::projectionOptions;

namespace {

using test::contains;
using test::errorText;

template <class Change>
std::string refusal(Change change) {
  ProjectedMapOptions options;
  change(options);
  return errorText([&] { checkProjectedMapOptions(options); });
}

TEST(ProjectedMapOptions, HoldTheLaws) {
  test::expectOptionLaws<ProjectedMapOptions>();
  EXPECT_EQ(refusal([](auto&) {}), "");
}

TEST(ProjectedMapOptions, TheBandIsOccupancyZUnlessItIsANumber) {
  ProjectedMapOptions options;
  options.occupancy_min_z = -2.0;
  options.occupancy_max_z = 3.0;
  EXPECT_EQ(projectionOptions(options).min_z, -2.0);
  EXPECT_EQ(projectionOptions(options).max_z, 3.0);
  options.projection_min_z = "0.25";
  options.projection_max_z = "1e1";
  EXPECT_EQ(projectionOptions(options).min_z, 0.25);
  EXPECT_EQ(projectionOptions(options).max_z, 10.0);
}

TEST(ProjectedMapOptions, ContradictionsAreRefusedByName) {
  for (const char* text : {"", "low", "1m", "nan", "inf", "occupancy_min_z"})
    EXPECT_TRUE(contains(refusal([&](auto& o) { o.projection_min_z = text; }),
                         "projection_min_z must be a height in metres or occupancy"))
        << text;
  EXPECT_TRUE(contains(refusal([](auto& o) { o.projection_max_z = "-2e6"; }), "below its max_z"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.occupancy_max_z = -1e6; }), "occupancy_min_z"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.frame_id = ""; }), "frame_id"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.base_frame_id = ""; }), "base_frame_id"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.map_file = "map.pgm"; }), ".yaml or .yml"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.octree_file = "tree"; }), ".bt or .ot"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.cloud.max_x = -1e7; }), "pointcloud_min_x"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.octree.hit = 0.3; }), "hit"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
