#include "support/cost_maps.h"

#include <stdexcept>
#include <utility>

#include "grid_path_planner/costmap/costmap_builder.h"

namespace grid_path_planner::test {

using costmap::CostGrid;
using costmap::CostmapBuilder;
using costmap::CostmapOptions;
using costmap::MotionModel;
using grid::Cell;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;
using grid::OccupancyGrid;

namespace {

CostGrid::Weight weightOf(char letter) {
  if (letter >= '1' && letter <= '9') return static_cast<CostGrid::Weight>(letter - '0');
  if (letter == '.') return 1;
  if (letter == '?') return 50;
  if (letter == '#') return CostGrid::kBlocked;
  throw std::invalid_argument(std::string("no such letter in a picture of costs: ") + letter);
}

Occupancy classOf(char letter) {
  return letter == '#' ? Occupancy::OCCUPIED : letter == '?' ? Occupancy::UNKNOWN : Occupancy::FREE;
}

}  // namespace

CostGrid costMap(const std::vector<std::string>& lines) {
  const GridGeometry geometry(static_cast<int>(lines.at(0).size()), static_cast<int>(lines.size()),
                              1.0);
  Weights weights(geometry);
  Grid<Occupancy> classes(geometry);
  for (int row = 0; row < geometry.height(); ++row) {
    if (lines[row].size() != lines[0].size())
      throw std::invalid_argument("the lines of a picture differ in length");
    for (int column = 0; column < geometry.width(); ++column) {
      weights[Cell{column, row}] = weightOf(lines[row][column]);
      classes[Cell{column, row}] = classOf(lines[row][column]);
    }
  }
  return CostGrid(std::move(weights), std::move(classes), MotionModel());
}

CostGrid costMap(Weights weights, const MotionModel& motion) {
  Grid<Occupancy> classes(weights.geometry(), Occupancy::FREE);
  return CostGrid(std::move(weights), std::move(classes), motion);
}

std::shared_ptr<const CostGrid> costsOf(const std::vector<std::string>& lines) {
  return std::make_shared<const CostGrid>(costMap(lines));
}

std::shared_ptr<const CostGrid> costsOf(Weights weights, const MotionModel& motion,
                                        std::uint64_t revision) {
  auto map = std::make_shared<CostGrid>(costMap(std::move(weights), motion));
  map->setRevision(revision);
  return map;
}

std::shared_ptr<const CostGrid> costsOf(const FreeCells& free, std::uint64_t revision) {
  Weights weights(free.geometry());
  for (std::size_t i = 0; i < free.values().size(); ++i)
    weights.values()[i] = free.values()[i] != 0 ? 1 : CostGrid::kBlocked;
  return costsOf(std::move(weights), MotionModel(), revision);
}

std::shared_ptr<const CostGrid> costsOf(const OccupancyGrid& map, const CostmapOptions& options) {
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<const OccupancyGrid>(map));
  return builder.downsampled(base::StopToken());
}

std::vector<Cell> cellsOf(const CostGrid& map) {
  std::vector<Cell> cells;
  for (std::uint32_t i = 0; i < map.geometry().size(); ++i)
    cells.push_back(map.geometry().cell(grid::CellIndex(i)));
  return cells;
}

}  // namespace grid_path_planner::test
