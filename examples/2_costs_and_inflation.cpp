// What a cell costs, and how the costs bend a path.
//
// CostmapBuilder turns an occupancy map into a CostGrid: a weight for each cell, 0 where it is
// blocked. The vehicle's radius blocks the cells around obstacles, decay makes those beyond it
// expensive. A planner searches cells of a CostGrid and knows nothing of poses.
#include <iomanip>
#include <iostream>
#include <memory>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "text_map.h"

using grid_path_planner::base::StopToken;
using grid_path_planner::costmap::CostGrid;
using grid_path_planner::costmap::CostmapBuilder;
using grid_path_planner::costmap::CostmapOptions;
using grid_path_planner::grid::Cell;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::planners::makePlanner;
using grid_path_planner::planners::SearchResult;

namespace {

void printWeights(const CostGrid& costs) {
  for (int row = costs.geometry().height() - 1; row >= 0; --row) {
    for (int column = 0; column < costs.geometry().width(); ++column)
      std::cout << std::setw(4) << costs.weight({column, row});
    std::cout << '\n';
  }
}

void planWith(const CostmapOptions& options, const std::shared_ptr<const OccupancyGrid>& map) {
  CostmapBuilder builder(options);
  builder.setMap(map);
  const std::shared_ptr<const CostGrid> costs = builder.downsampled(StopToken());
  printWeights(*costs);

  const auto planner = makePlanner("a_star");
  planner->prepare(costs, StopToken());
  const SearchResult result = planner->search({Cell{0, 2}, {Cell{12, 2}}}, StopToken());
  std::cout << toString(result.status) << ", cost " << result.costValue() << ", cells:";
  for (const Cell cell : result.cells) std::cout << ' ' << cell;
  std::cout << "\n\n";
}

}  // namespace

int main() {
  const auto map = std::make_shared<const OccupancyGrid>(examples::mapOf(
      {".............",  //
       ".............", ".............", ".............", "......#......", "?????????????"}));
  CostmapOptions options;
  options.unknown_weight = 20;
  std::cout << "Unknown cells cost 20 times as much as free ones:\n";
  planWith(options, map);

  options.radius = 1.2;  // m: a cell whose centre is nearer than this to an obstacle is blocked
  std::cout << "A vehicle of radius 1.2 m:\n";
  planWith(options, map);

  options.decay = 0.7;  // 1/m
  options.inflation_weight = 12;
  std::cout << "The same, and cells near the obstacle are expensive:\n";
  planWith(options, map);
  return 0;
}
