#include "planning/cost_weights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "support/error_text.h"

namespace grid_path_planner::planning {

using base::StopToken;
using costmap::CostGrid, costmap::CostmapBuilder, costmap::CostmapOptions;
using grid::Cell, grid::GridGeometry, grid::Occupancy, grid::OccupancyGrid;

namespace {

CostWeightOptions weighing(int free, int inflation) {
  CostWeightOptions options;
  options.free_weight = free;
  options.inflation_weight = inflation;
  return options;
}

TEST(CostWeights, AHigherCostHasNoLowerWeight) {
  for (const auto& options : {CostWeightOptions(), weighing(1, 1), weighing(7, 8),
                              weighing(50, 806), weighing(1, 65535), weighing(65535, 65535)}) {
    const CostWeights table(options);
    EXPECT_EQ(table.weight(0), options.free_weight);
    EXPECT_EQ(table.weight(252), options.inflation_weight);
    for (int cost = 1; cost <= 252; ++cost)
      EXPECT_LE(table.weight(static_cast<Cost>(cost - 1)), table.weight(static_cast<Cost>(cost)))
          << cost << " of " << options.free_weight << ".." << options.inflation_weight;
  }
}

TEST(CostWeights, AllCostsDifferWhereThereIsRoomForTheirWeights) {
  const CostWeights table(
      weighing(50, 50 + 3 * 252));  // global_planner's neutral_cost, cost_factor
  for (int cost = 0; cost <= 252; ++cost)
    EXPECT_EQ(table.weight(static_cast<Cost>(cost)), 50 + 3 * cost);
}

TEST(CostWeights, WhatIsInCollisionIsBlockedAndUnknownIsByWish) {
  CostWeightOptions options;
  EXPECT_EQ(CostWeights(options).weight(kUnknownCost), options.unknown_weight);
  options.allow_unknown = false;
  const CostWeights table(options);
  for (const Cost cost : {kInscribedCost, kLethalCost, kUnknownCost})
    EXPECT_EQ(table.weight(cost), CostGrid::kBlocked) << int{cost};
  EXPECT_EQ(CostWeights::classOf(252), Occupancy::FREE);
  EXPECT_EQ(CostWeights::classOf(kInscribedCost), Occupancy::FREE);
  EXPECT_EQ(CostWeights::classOf(kLethalCost), Occupancy::OCCUPIED);
  EXPECT_EQ(CostWeights::classOf(kUnknownCost), Occupancy::UNKNOWN);
}

TEST(CostWeights, OptionsThatCannotBeUsedAreNamed) {
  EXPECT_EQ(test::errorText([] { checkCostWeightOptions(weighing(41, 40)); }),
            "inflation_weight must be at least free_weight, got 40 and 41");
  EXPECT_NE(test::errorText([] { checkCostWeightOptions(weighing(0, 40)); }), "");
  EXPECT_NE(test::errorText([] { checkCostWeightOptions(weighing(1, 65536)); }), "");
}

// The formula of costmap_2d's inflation layer, by the distance between centres.
Cost inflatedCost(double distance, double inscribed_radius, double scaling) {
  if (distance == 0.0) return kLethalCost;
  if (distance <= inscribed_radius) return kInscribedCost;
  return static_cast<Cost>(252 * std::exp(-scaling * (distance - inscribed_radius)));
}

// costmap_2d measures between centres and we to the edge: half a cell less on a straight line.
TEST(CostWeights, AreThoseOfAMapOfTheSameRadiusAndDecay) {
  const GridGeometry geometry(40, 1, 0.05);
  OccupancyGrid map(geometry, 0);
  map[Cell{0, 0}] = 100;
  CostmapOptions options;
  options.radius = 0.31;
  options.decay = 3.0;
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<const OccupancyGrid>(map));
  const auto ours = builder.fullResolution(StopToken());
  const CostWeights table({options.free_weight, options.inflation_weight, 50, true});
  for (int column = 0; column < geometry.width(); ++column) {
    const Cost cost = inflatedCost(0.05 * column, options.radius + 0.025, options.decay);
    EXPECT_NEAR(ours->weight({column, 0}), table.weight(cost), 1) << column;
    EXPECT_EQ(ours->passable({column, 0}), table.weight(cost) != 0) << column;
  }
}

}  // namespace
}  // namespace grid_path_planner::planning
