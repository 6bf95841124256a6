#include "support/shortest_any_angle.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "grid_path_planner/terrain/segment.h"
#include "support/random_map.h"
#include "support/visibility_graph.h"

namespace grid_path_planner::test {

std::shared_ptr<const CostGrid> randomUniform(std::mt19937& random, int largest_side) {
  const auto below = [&random](int limit) { return static_cast<int>(random() % limit); };
  const auto weight = static_cast<CostGrid::Weight>(1 + below(3));
  Grid<CostGrid::Weight> weights(
      GridGeometry(1 + below(largest_side), 1 + below(largest_side), 1.0), weight);
  const bool rectangles = below(2) == 0;
  const double share = below(500) * 1e-3;
  const int wanted =
      static_cast<int>(share * (rectangles ? 20.0 : double(weights.values().size())));
  for (int i = 0; i < wanted; ++i) {
    const Cell low = randomCell(random, weights.geometry());
    const CellRect rect =
        CellRect{low.column, low.row, rectangles ? 1 + below(5) : 1, rectangles ? 1 + below(5) : 1}
            .intersection(weights.geometry().rect());
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      std::fill_n(weights.row(row) + rect.column, rect.width, CostGrid::kBlocked);
  }
  const Grid<Occupancy> classes(weights.geometry(), Occupancy::FREE);
  return std::make_shared<const CostGrid>(weights, classes, MotionModel());
}

void expectShortest(Planner& planner, const std::shared_ptr<const CostGrid>& map, Cell start,
                    Cell goal, int& found) {
  planner.prepare(map, StopToken());
  const PlanResult result = planner.plan({start, {goal}, false}, StopToken());
  const auto shortest = shortestAnyAngle(*map, start, goal);
  ASSERT_EQ(result.status, shortest ? Status::FOUND : Status::UNREACHABLE);
  if (!shortest) return;
  ++found;
  const double scale = map->cheapest() * map->kernel();
  EXPECT_NEAR(result.costValue(), *shortest * scale, 1e-9 * *shortest * scale);
  double cost = 0.0;
  for (std::size_t i = 1; i < result.points.size(); ++i) {
    ASSERT_TRUE(segmentLegal(*map, result.points[i - 1], result.points[i]));
    cost += segmentCost(*map, result.points[i - 1], result.points[i]);
  }
  EXPECT_NEAR(result.costValue(), cost, 1e-9 * cost);
}

}  // namespace grid_path_planner::test
