// Tables that searches have paid for: what memory they take, and what becomes of those that cannot be used.
#include "planners/jump_point/paid_landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "planners/jump_point/walls.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planners {
namespace {

using base::Stopped, base::StopSource, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::Grid, grid::GridGeometry;
using test::costsOf, test::slopesBetweenWalls;

constexpr std::size_t kAnyRoom = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kPaid = std::size_t{1} << 40;

TEST(PaidLandmarkTables, AreWantedOncePaidForAndUntilTheyAreThere) {
  const auto map = costsOf(slopesBetweenWalls());
  const auto& weights = map->weights().values();
  const auto blocked = std::count(weights.begin(), weights.end(), CostGrid::kBlocked);
  PaidLandmarks landmarks(4);
  EXPECT_FALSE(landmarks.wanted(*map, kAnyRoom));
  landmarks.pay(8 * (weights.size() - static_cast<std::size_t>(blocked)) - 1);
  EXPECT_FALSE(landmarks.wanted(*map, kAnyRoom));
  landmarks.pay(1);
  EXPECT_TRUE(landmarks.wanted(*map, kAnyRoom));
  EXPECT_EQ(landmarks.bytes(), 0U);
  landmarks.make(map, kAnyRoom, StopToken());
  EXPECT_FALSE(landmarks.wanted(*map, kAnyRoom));
  EXPECT_TRUE(landmarks.boundTo(12345, kMediumScale));
  landmarks.release();
  EXPECT_EQ(landmarks.bytes(), 0U);
  EXPECT_FALSE(landmarks.wanted(*map, kAnyRoom));
}

TEST(PaidLandmarkTables, AreAsManyAsMemoryHolds) {
  const auto map = costsOf(Grid<CostGrid::Weight>(GridGeometry(100, 100, 1.0), 3));
  const GridGeometry& geometry = map->geometry();
  for (const int fit : {16, 12, 8, 4, 0}) {
    for (const int most : {10, 16}) {
      PaidLandmarks landmarks(most);
      landmarks.pay(kPaid);
      const std::size_t room =
          fit > 0 ? LandmarkTable::makingBytesFor(geometry, fit) : geometry.size();
      landmarks.make(map, room, StopToken());
      const int made = std::min(most, fit);
      EXPECT_EQ(landmarks.bytes(), made > 0 ? LandmarkTable::bytesFor(geometry, made) : 0U)
          << fit << " fit, " << most << " are allowed";
    }
  }
}

// They were held for ever, unused: the map that made them loose changed no more.
TEST(PaidLandmarkTables, ThatBecomeLooseWhileTheyAreMadeArePaidForAgain) {
  auto weights = slopesBetweenWalls();
  const auto before = costsOf(weights);
  PaidLandmarks landmarks(16);
  landmarks.pay(kPaid);
  StopSource at_once;
  at_once.cancel();
  EXPECT_THROW(landmarks.make(before, kAnyRoom, at_once.token()), Stopped);
  std::vector<CellRect> changed;
  for (const Cell cell : {Cell{5, 5}, Cell{630, 630}, Cell{5, 630}}) {
    weights[cell] = 1;
    changed.push_back({cell.column, cell.row, 1, 1});
  }
  const auto map = costsOf(weights, {}, before->revision() + 1);
  landmarks.update(*before, map, changed);
  landmarks.make(map, kAnyRoom, StopToken());
  EXPECT_FALSE(landmarks.boundTo(12345, kMediumScale));
  EXPECT_FALSE(landmarks.wanted(*map, kAnyRoom));
  EXPECT_EQ(landmarks.bytes(), 0U);
  landmarks.pay(kPaid);
  landmarks.make(map, kAnyRoom, StopToken());
  EXPECT_TRUE(landmarks.boundTo(12345, kMediumScale));
}

// A bound of 0 took the place of better ones, and 64 bytes a cell.
TEST(PaidLandmarkTables, AreNoneWhereCostsAreTooHighAndAreNotTriedAgain) {
  const auto map = costsOf(Grid<CostGrid::Weight>(GridGeometry(300, 300, 1.0), 65535));
  PaidLandmarks landmarks(16);
  landmarks.pay(kPaid);
  landmarks.make(map, kAnyRoom, StopToken());
  EXPECT_FALSE(landmarks.boundTo(12345, kMediumScale));
  EXPECT_LT(landmarks.bytes(), 1000U);
  landmarks.pay(kPaid);
  EXPECT_FALSE(landmarks.wanted(*map, kAnyRoom));
}

TEST(PaidLandmarkTables, KnowWithoutASearchThatNoPathLeadsToAPocket) {
  auto weights = slopesBetweenWalls();
  for (int column = 0; column < 640; ++column) weights[Cell{column, 320}] = CostGrid::kBlocked;
  const auto map = costsOf(weights);
  PaidLandmarks landmarks(8);
  landmarks.pay(kPaid);
  landmarks.make(map, kAnyRoom, StopToken());
  const auto index = [&](const Cell& cell) { return map->geometry().index(cell).value(); };
  const auto bound = landmarks.boundTo(index({610, 610}), kMediumScale);
  ASSERT_TRUE(bound);
  EXPECT_TRUE(bound->separates(index({600, 100})));
  EXPECT_FALSE(bound->separates(index({100, 500})));
}

}  // namespace
}  // namespace grid_path_planner::planners
