#include "grid_path_planner/terrain/terrain.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "grid_path_planner/terrain/kernel.h"

namespace grid_path_planner {
namespace {

void classify(const OccupancyGrid& map, const OccupancyThresholds& thresholds, const CellRect& rect,
              Grid<Occupancy>& classes, const StopToken& stop) {
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const std::int8_t* from = map.row(row);
    Occupancy* to = classes.row(row);
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      to[column] = thresholds.classify(from[column]);
  }
}

void weigh(const Grid<Occupancy>& classes, const TerrainOptions& options, const CellRect& rect,
           Grid<CostGrid::Weight>& weights, const StopToken& stop) {
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const Occupancy* from = classes.row(row);
    CostGrid::Weight* to = weights.row(row);
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      to[column] = classWeight(from[column], options);
  }
}

void inflateStrip(const Grid<Occupancy>& classes, const Inflation& inflation, const CellRect& strip,
                  Grid<CostGrid::Weight>& weights, const StopToken& stop) {
  const std::vector<HalfCellsSquared> distances =
      obstacleDistances(classes, strip, inflation.reach(), stop);
  for (int row = 0; row < strip.height; ++row) {
    const HalfCellsSquared* distance = distances.data() + std::size_t(row) * strip.width;
    CostGrid::Weight* weight = weights.row(strip.row + row) + strip.column;
    for (int i = 0; i < strip.width; ++i) weight[i] = inflation.apply(weight[i], distance[i]);
  }
}

// In strips of columns: the distances of a whole large map would take more memory than the map.
void inflate(const Grid<Occupancy>& classes, const Inflation& inflation, const CellRect& rect,
             Grid<CostGrid::Weight>& weights, const StopToken& stop) {
  const int strip_width = std::max(128, 2 * inflation.reach());
  for (int column = rect.column; column < rect.column + rect.width; column += strip_width) {
    const int width = std::min(strip_width, rect.column + rect.width - column);
    inflateStrip(classes, inflation, {column, rect.row, width, rect.height}, weights, stop);
  }
}

}  // namespace

Terrain::Terrain(const TerrainOptions& options) : options_(options) {
  checkTerrainOptions(options);
}

void Terrain::setMap(std::shared_ptr<const OccupancyGrid> map) {
  assert(map);
  map_ = std::move(map);
  fine_.reset();
  searched_.reset();
  searched_dirty_ = {};
  fine_dirty_ = map_->geometry().rect();
}

void Terrain::updateMap(std::shared_ptr<const OccupancyGrid> map, const CellRect& changed) {
  assert(map && map_ && map->geometry() == map_->geometry());
  map_ = std::move(map);
  fine_dirty_ = fine_dirty_.hull(changed.intersection(map_->geometry().rect()));
}

std::shared_ptr<const CostGrid> Terrain::fine(const StopToken& stop) {
  assert(map_);
  if (!fine_ || !fine_dirty_.empty()) makeFine(stop);
  return fine_;
}

std::shared_ptr<const CostGrid> Terrain::searched(const StopToken& stop) {
  fine(stop);
  if (!searched_ || !searched_dirty_.empty()) makeSearched(stop);
  return searched_;
}

void Terrain::makeFine(const StopToken& stop) {
  const GridGeometry& geometry = map_->geometry();
  const Inflation inflation(options_, geometry.resolution());
  const CellRect rewritten =
      fine_ ? fine_dirty_.grown(inflation.reach()).intersection(geometry.rect()) : geometry.rect();
  Grid<Occupancy> classes = fine_ ? fine_->classes() : Grid<Occupancy>(geometry);
  Grid<CostGrid::Weight> weights = fine_ ? fine_->weights() : Grid<CostGrid::Weight>(geometry);

  classify(*map_, options_.thresholds, fine_ ? fine_dirty_ : rewritten, classes, stop);
  weigh(classes, options_, rewritten, weights, stop);
  if (!inflation.none()) inflate(classes, inflation, rewritten, weights, stop);

  auto made = std::make_shared<CostGrid>(std::move(weights), std::move(classes), options_.motion);
  made->setRevision(++revision_);
  fine_ = std::move(made);
  fine_dirty_ = {};
  searched_dirty_ = searched_dirty_.hull(rewritten);
}

void Terrain::makeSearched(const StopToken& stop) {
  if (options_.kernel == 1) {
    searched_change_ = searched_ ? searched_dirty_ : fine_->geometry().rect();
    searched_ = fine_;
    searched_dirty_ = {};
    return;
  }
  const GridGeometry blocks = blockGeometry(fine_->geometry(), options_.kernel);
  const CellRect cells = searched_ ? searched_dirty_ : fine_->geometry().rect();
  Grid<Occupancy> classes = searched_ ? searched_->classes() : Grid<Occupancy>(blocks);
  Grid<CostGrid::Weight> weights =
      searched_ ? searched_->weights() : Grid<CostGrid::Weight>(blocks);
  applyKernel(*fine_, options_, cells, weights, classes, stop);

  auto made = std::make_shared<CostGrid>(std::move(weights), std::move(classes), options_.motion,
                                         options_.kernel, fine_->geometry());
  made->setRevision(fine_->revision());
  const int k = options_.kernel;
  const Cell first{cells.column / k, cells.row / k};
  const Cell last{(cells.column + cells.width - 1) / k, (cells.row + cells.height - 1) / k};
  searched_change_ = {first.column, first.row, last.column - first.column + 1,
                      last.row - first.row + 1};
  searched_ = std::move(made);
  searched_dirty_ = {};
}

}  // namespace grid_path_planner
