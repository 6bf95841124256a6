#include "support/random_map.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "grid_path_planner/costmap/costmap_builder.h"

namespace grid_path_planner::test {

using base::StopToken;
using costmap::CostGrid;
using costmap::CostmapBuilder;
using costmap::CostmapOptions;
using costmap::MotionModel;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;
using grid::OccupancyGrid;

namespace {

int between(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

GridGeometry randomGeometry(std::mt19937& random, int largest_side) {
  return GridGeometry(between(random, 1, largest_side), between(random, 1, largest_side), 1.0);
}

void fewValues(std::mt19937& random, Grid<CostGrid::Weight>& weights) {
  const int values[] = {1, 2, 3, 50};
  for (auto& weight : weights.values())
    weight = static_cast<CostGrid::Weight>(values[between(random, 0, 3)]);
}

void plateaus(std::mt19937& random, Grid<CostGrid::Weight>& weights) {
  for (int i = 0; i < 6; ++i) {
    const Cell low = randomCell(random, weights.geometry());
    const Cell high = randomCell(random, weights.geometry());
    const auto weight = static_cast<CostGrid::Weight>(between(random, 1, 100));
    for (int row = low.row; row <= high.row; ++row)
      for (int column = low.column; column <= high.column; ++column)
        weights[Cell{column, row}] = weight;
  }
}

void rings(std::mt19937& random, Grid<CostGrid::Weight>& weights) {
  for (int i = 0; i < 4; ++i) {
    const Cell middle = randomCell(random, weights.geometry());
    for (std::uint32_t j = 0; j < weights.values().size(); ++j) {
      const Cell cell = weights.geometry().cell(CellIndex(j));
      const double distance = std::hypot(cell.column - middle.column, cell.row - middle.row);
      const auto weight = static_cast<CostGrid::Weight>(1.0 + 40.0 * std::exp(-distance / 3.0));
      weights[cell] = std::max(weights[cell], weight);
    }
  }
}

// A rectangle of at most eight cells a side.
void fill(std::mt19937& random, OccupancyGrid& map, int value) {
  const Cell low = randomCell(random, map.geometry());
  const CellRect rect =
      CellRect{low.column, low.row, between(random, 1, 8), between(random, 1, 8)}.intersection(
          map.geometry().rect());
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      map[Cell{column, row}] = static_cast<std::int8_t>(value);
}

void noise(std::mt19937& random, Grid<CostGrid::Weight>& weights) {
  for (auto& weight : weights.values())
    weight = static_cast<CostGrid::Weight>(between(random, 1, 65535));
}

}  // namespace

Cell randomCell(std::mt19937& random, const GridGeometry& geometry) {
  const int column = between(random, 0, geometry.width() - 1);
  return {column, between(random, 0, geometry.height() - 1)};
}

OccupancyGrid randomOccupancy(std::mt19937& random, int largest_side, double occupied,
                              double unknown) {
  OccupancyGrid map(randomGeometry(random, largest_side));
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  for (auto& value : map.values()) {
    const double drawn = chance(random);
    value = drawn < occupied ? 100 : drawn < occupied + unknown ? -1 : 0;
  }
  return map;
}

CostGrid randomCosts(std::mt19937& random, int largest_side, const MotionModel& motion) {
  return randomCosts(random, randomGeometry(random, largest_side), motion);
}

CostGrid randomCosts(std::mt19937& random, const GridGeometry& geometry,
                     const MotionModel& motion) {
  Grid<CostGrid::Weight> weights(geometry, 1);
  switch (between(random, 0, 4)) {
    case 0:
      break;
    case 1:
      fewValues(random, weights);
      break;
    case 2:
      plateaus(random, weights);
      break;
    case 3:
      rings(random, weights);
      break;
    default:
      noise(random, weights);
      break;
  }
  const double blocked = std::uniform_real_distribution<double>(0.0, 0.45)(random);
  std::bernoulli_distribution drawn(blocked);
  for (auto& weight : weights.values())
    if (drawn(random)) weight = CostGrid::kBlocked;
  Grid<Occupancy> classes(weights.geometry(), Occupancy::FREE);
  return CostGrid(std::move(weights), std::move(classes), motion);
}

CostGrid randomPotential(std::mt19937& random, const GridGeometry& geometry,
                         const MotionModel& motion) {
  std::vector<CellRect> obstacles;
  for (int i = between(random, 1, 8); i > 0; --i) {
    const Cell low = randomCell(random, geometry);
    obstacles.push_back({low.column, low.row, between(random, 1, 20), between(random, 1, 20)});
  }
  const double decay = between(random, 2, 30) / 100.0;
  const int highest = between(random, 10, 200);
  Grid<CostGrid::Weight> weights(geometry, 1);
  for (std::uint32_t i = 0; i < weights.values().size(); ++i) {
    const Cell cell = geometry.cell(CellIndex(i));
    double nearest = 1e9;
    for (const CellRect& rect : obstacles) {
      const int column =
          std::max({0, rect.column - cell.column, cell.column - (rect.column + rect.width - 1)});
      const int row = std::max({0, rect.row - cell.row, cell.row - (rect.row + rect.height - 1)});
      nearest = std::min(nearest, std::hypot(column, row));
    }
    weights[cell] = nearest == 0.0
                        ? CostGrid::kBlocked
                        : static_cast<CostGrid::Weight>(1.0 + highest * std::exp(-decay * nearest));
  }
  return CostGrid(std::move(weights), Grid<Occupancy>(geometry, Occupancy::FREE), motion);
}

CostGrid randomInflated(std::mt19937& random, const GridGeometry& geometry,
                        const MotionModel& motion) {
  const auto map = std::make_shared<OccupancyGrid>(geometry);
  const auto area = static_cast<int>(geometry.size());
  for (int left = between(random, 0, 4 + area / 300); left > 0; --left)
    fill(random, *map, between(random, 0, 3) == 0 ? -1 : 100);
  CostmapOptions options;
  options.motion = motion;
  options.radius = between(random, 0, 2);
  options.decay = between(random, 0, 3) * 0.25;
  options.unknown_weight = between(random, 1, 50);
  CostmapBuilder builder(options);
  builder.setMap(map);
  return *builder.downsampled(StopToken());
}

std::vector<grid::CellRect> randomRects(std::mt19937& random, const grid::GridGeometry& geometry,
                                        int largest_side) {
  const auto side = [&] { return 1 + static_cast<int>(random() % unsigned(largest_side)); };
  std::vector<grid::CellRect> rects;
  for (unsigned count = random() % 7; count > 0; --count) {
    grid::Cell low = randomCell(random, geometry);
    if (random() % 4 == 0) low.column = random() % 2 == 0 ? -1 : geometry.width() - 1;
    if (random() % 4 == 0) low.row = random() % 2 == 0 ? -1 : geometry.height() - 1;
    rects.push_back({low.column, low.row, side(), side()});
  }
  return rects;
}

}  // namespace grid_path_planner::test
