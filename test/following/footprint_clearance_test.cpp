// What a vehicle that is not round meets on the path ahead.
#include "following/footprint_clearance.h"

#include <gtest/gtest.h>

#include "support/ascii_map.h"

namespace grid_path_planner::following {

using grid::OccupancyGrid;
using vehicle::Footprint;

namespace {

using Ahead = std::vector<Eigen::Vector3d>;

// 2 m long, 0.8 m wide.
Footprint longFootprint() {
  return Footprint::fromText("footprint", "[[1, 0.4], [-1, 0.4], [-1, -0.4], [1, -0.4]]");
}

std::optional<Obstruction> contactOn(const std::vector<std::string>& lines, const Ahead& ahead,
                                     bool stop_at_unknown = false) {
  const test::AsciiMap picture(lines);
  return firstFootprintContact(picture.map, {{25, 65}, 0.0, stop_at_unknown}, longFootprint(),
                               ahead);
}

const std::vector<std::string> kLane = {"......#",  //
                                        ".......",  //
                                        "..#..?."};

TEST(FootprintClearance, TheSidesOfALaneAreFreeAndTheCornerIsNot) {
  EXPECT_FALSE(contactOn(kLane, {{1.5, 1.5, 0}, {1.5, 1.5, 0}, {4.5, 1.5, 0}}));
  const auto turning =
      contactOn(kLane, {{1.5, 1.5, 0}, {1.5, 1.5, 0}, {5.8, 1.5, 0}, {5.8, 0.5, 0}});
  ASSERT_TRUE(turning);
  EXPECT_EQ(turning->kind, Obstruction::Kind::OCCUPIED);
  EXPECT_EQ(turning->at, Eigen::Vector2d(6.5, 0.5));
}

TEST(FootprintClearance, UnknownCellsAndTheOutsideStopWhereTheyShall) {
  const Ahead over_unknown = {{4.5, 1.5, 0}, {4.5, 1.5, 0}, {5.4, 1.9, 0}};
  EXPECT_FALSE(contactOn(kLane, over_unknown));
  const auto unknown = contactOn(kLane, over_unknown, true);
  ASSERT_TRUE(unknown);
  EXPECT_EQ(unknown->kind, Obstruction::Kind::UNKNOWN);
  const Ahead out = {{1.5, 1.5, 0}, {1.5, 1.5, 0}, {0.5, 1.5, 0}};
  EXPECT_FALSE(contactOn(kLane, out));
  ASSERT_TRUE(contactOn(kLane, out, true));
  EXPECT_EQ(contactOn(kLane, out, true)->kind, Obstruction::Kind::OUTSIDE);
}

// How the vehicle gets back onto its path, sideways perhaps, is not judged by where that leads.
TEST(FootprintClearance, TheReturnToThePathHasNoHeading) {
  EXPECT_FALSE(contactOn(kLane, {{2.5, 1.1, 0}, {2.5, 1.5, 0}}));
  EXPECT_FALSE(contactOn(kLane, {{2.5, 1.1, 0}, {2.5, 1.5, 0}, {3.5, 1.5, 0}}));
  EXPECT_FALSE(contactOn(kLane, {}));
}

// What was seen before, by reading: a millimetre beyond its end all that is ahead of the vehicle is that end, where the
// footprint was laid looking along x. In a lane that it fits in it was blocked for good.
TEST(FootprintClearance, TheEndOfAPathHasNoHeading) {
  const std::vector<std::string> lane = {"#.#", "#.#", "#.#", "#.#"};
  const Eigen::Vector3d end(1.5, 2.0, 0);
  EXPECT_FALSE(contactOn(lane, {{1.5, 2.001, 0}, end, end}));
  EXPECT_FALSE(contactOn(lane, {{1.5, 2.001, 0}, end, {1.5 + 1e-15, 2.0, 0}, end}));
  EXPECT_FALSE(contactOn(lane, {{1.5, 1.5, 0}, {1.5, 1.5, 0}, end, {1.5 + 1e-15, 2.0, 0}}));
  EXPECT_TRUE(contactOn(lane, {{1.5, 1.5, 0}, {1.5, 1.5, 0}, {1.6, 1.5, 0}})) << "across it";
}

}  // namespace
}  // namespace grid_path_planner::following
