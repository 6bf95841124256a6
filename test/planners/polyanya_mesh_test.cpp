#include "planners/any_angle/polyanya_mesh.h"

#include <gtest/gtest.h>

#include <set>

#include "grid_path_planner/planners/decomposition.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::SegmentPoint;

namespace {

using Mesh = PolyanyaMesh;

Mesh meshOf(const std::vector<std::string>& picture) {
  const auto map = test::costsOf(test::AsciiMap(picture).map);
  return Mesh(mergedRuns(map->bitMaps(StopToken()).rows, StopToken()), StopToken());
}

constexpr std::int32_t kUnit = static_cast<std::int32_t>(SegmentPoint::kUnitsPerCell);

// Rectangles: 0 is the first row, 1 and 2 the sides, 3 the last row.
TEST(PolyanyaMesh, KnowsBordersFromTheWest) {
  const Mesh mesh = meshOf({".....",  //
                            ".###.",  //
                            "....."});
  ASSERT_EQ(mesh.rectangles(), 4U);
  EXPECT_EQ(mesh.borders(), 8U);
  const Mesh::Rectangle& first = mesh.rectangle(0);
  EXPECT_EQ(first.first[0], first.first[1]);
  ASSERT_EQ(first.first[2] - first.first[1], 2U);
  EXPECT_EQ(mesh.border(first.first[1]).to, 1U);
  EXPECT_EQ(mesh.border(first.first[1]).west, 0);
  EXPECT_EQ(mesh.border(first.first[1]).east, kUnit);
  EXPECT_EQ(mesh.border(first.first[1] + 1).to, 2U);
}

TEST(PolyanyaMesh, HasCornersWhereAPathCanTurn) {
  const Mesh mesh = meshOf({".....",  //
                            ".###.",  //
                            "....."});
  ASSERT_EQ(mesh.corners(), 4U);
  std::set<int> quarters;
  for (std::uint32_t i = 0; i < 4; ++i) quarters.insert(mesh.corner(i).quarter);
  EXPECT_EQ(quarters, (std::set<int>{0, 1, 2, 3}));
  // Along the wall from one corner to the other, and no farther.
  const Mesh::Border& border = mesh.border(mesh.rectangle(0).first[1]);
  EXPECT_EQ(border.corner[Mesh::WEST], Mesh::kNone);
  const std::uint32_t corner = border.corner[Mesh::EAST];
  ASSERT_NE(corner, Mesh::kNone);
  EXPECT_EQ(mesh.corner(corner).at.x, kUnit);
  const std::uint32_t next = mesh.corner(corner).along[Mesh::EAST];
  ASSERT_NE(next, Mesh::kNone);
  EXPECT_EQ(mesh.corner(next).at.x, 4 * kUnit);
  EXPECT_EQ(mesh.corner(next).along[Mesh::EAST], Mesh::kNone);
}

TEST(PolyanyaMesh, HasNoCornersInStraightWallsAndPinches) {
  EXPECT_EQ(meshOf({"...", "...", "###"}).corners(), 0U);
  EXPECT_EQ(meshOf({".#", "#."}).corners(), 0U);
}

// Rows of rectangles: a ring (0 to 3), a passage (4), a hall (5) with a bay (6).
TEST(PolyanyaMesh, KnowsTheBlocksBetweenTwoRectangles) {
  const Mesh mesh = meshOf({".....",  //
                            ".###.",  //
                            ".....",  //
                            "##.##",  //
                            ".....",  //
                            ".####"});
  ASSERT_EQ(mesh.rectangles(), 7U);
  EXPECT_EQ(mesh.blocks(), 4U);
  std::vector<std::uint32_t> blocks;
  const auto between = [&](std::uint32_t start, std::uint32_t goal) {
    EXPECT_TRUE(mesh.blocksBetween(start, goal, blocks));
    return blocks.size();
  };
  EXPECT_EQ(between(0, 0), 0U);
  EXPECT_EQ(between(0, 3), 1U);
  EXPECT_EQ(between(1, 2), 1U);
  EXPECT_EQ(between(0, 5), 3U);
  EXPECT_EQ(between(6, 0), 4U);
  EXPECT_EQ(between(4, 6), 2U);
}

TEST(PolyanyaMesh, KnowsWhatIsApart) {
  const Mesh mesh = meshOf({"...", "###", "..."});
  std::vector<std::uint32_t> blocks;
  EXPECT_FALSE(mesh.blocksBetween(0, 1, blocks));
}

}  // namespace
}  // namespace grid_path_planner::planners
