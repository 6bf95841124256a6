#include "grid_path_planner/mapping/projection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "mapping/column_values.h"
#include "mapping/extent.h"
#include "mapping/reached_columns.h"
#include "mapping/seabed.h"

namespace grid_path_planner::mapping {

using base::InputError;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

constexpr std::int64_t kMostCells = std::int64_t{1} << 28;

bool inOrder(BrickColumn a, BrickColumn b) {
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

void sortUnique(std::vector<BrickColumn>& columns) {
  std::sort(columns.begin(), columns.end(), inOrder);
  const auto same = [](BrickColumn a, BrickColumn b) { return a.x == b.x && a.y == b.y; };
  columns.erase(std::unique(columns.begin(), columns.end(), same), columns.end());
}

// The cells that the bounds touch with more than a side. Cell 0 begins at 0 m.
CellRect cellsOf(const ProjectionBounds& bounds, double resolution) {
  const auto first = [&](double metres) {
    return static_cast<int>(std::floor(metres / resolution + kOnTheLattice));
  };
  const auto end = [&](double metres) {
    return static_cast<int>(std::ceil(metres / resolution - kOnTheLattice));
  };
  const int x = first(bounds.min_x);
  const int y = first(bounds.min_y);
  return {x, y, end(bounds.max_x) - x, end(bounds.max_y) - y};
}

// Throws InputError for a grid that is too large.
GridGeometry geometryOf(const CellRect& cells, double resolution) {
  if (static_cast<std::int64_t>(cells.width) * cells.height > kMostCells)
    throw InputError("the 2-D map would have " + std::to_string(cells.width) + "x" +
                     std::to_string(cells.height) + " cells, at most " +
                     std::to_string(kMostCells) + " can be held");
  return GridGeometry(cells.width, cells.height, resolution,
                      {cells.column * resolution, cells.row * resolution, 0.0});
}

}  // namespace

Projection::Projection(double resolution, const ProjectionOptions& options)
    : resolution_(resolution), extent_(std::make_unique<Extent>(resolution)) {
  setOptions(options);
  setGeometry(options_.bounds.given() ? cellsOf(options_.bounds, resolution_)
                                      : CellRect{0, 0, 1, 1});
}

Projection::~Projection() = default;
Projection::Projection(Projection&&) noexcept = default;
Projection& Projection::operator=(Projection&&) noexcept = default;

void Projection::setOptions(const ProjectionOptions& options) {
  checkProjectionOptions(options);
  if (options.bounds.given()) geometryOf(cellsOf(options.bounds, resolution_), resolution_);
  if (options.bounds.given() != options_.bounds.given()) extent_->restart();
  options_ = options;
  all_columns_pending_ = true;
}

void Projection::setVehicleHeight(double z) {
  if (std::abs(z - vehicle_height_) <= resolution_) return;
  vehicle_height_ = z;
  if (options_.reference == ProjectionReference::VEHICLE) all_columns_pending_ = true;
}

void Projection::setSensor(double x, double y) {
  extent_->setSensor(x, y);
}

void Projection::restart() noexcept {
  restarts_ = all_columns_pending_ = true;
}

std::size_t Projection::columnsLeftOut() const {
  return options_.bounds.given() ? 0 : extent_->leftOut();
}

ProjectionChange Projection::update(OccupancyBricks& bricks) {
  if (bricks.drainRestart()) restart();
  ProjectionChange change;
  change.geometry = restarts_;
  try {
    if (restarts_) std::fill(grid_.values().begin(), grid_.values().end(), std::int8_t{-1});
    collectColumns(bricks);
    change.geometry = fitGeometry(bricks) || change.geometry;
    projectColumns(bricks, change.cells);
  } catch (const InputError&) {  // a grid that is too large: what is pending stays so
    throw;
  } catch (...) {
    restart();
    throw;
  }
  restarts_ = false;
  return change;
}

// Columns stay in pending_columns_ until they are projected.
void Projection::collectColumns(OccupancyBricks& bricks) {
  const std::vector<BrickColumn> changed = bricks.drainChangedColumns();
  const bool each_once = pending_columns_.empty() && !all_columns_pending_;
  pending_columns_.insert(pending_columns_.end(), changed.begin(), changed.end());
  if (all_columns_pending_) {
    const std::vector<BrickColumn> columns = bricks.columns();
    pending_columns_.insert(pending_columns_.end(), columns.begin(), columns.end());
    seabed_.reset();
    if (options_.reference == ProjectionReference::SEABED)
      seabed_ =
          std::make_unique<Seabed>(options_.seabed_radius, options_.seabed_max_slope, resolution_);
  }
  all_columns_pending_ = false;
  if (!each_once) sortUnique(pending_columns_);
}

// Returns whether the geometry had to change.
bool Projection::fitGeometry(const OccupancyBricks& bricks) {
  const bool complete = columnsLeftOut() == 0;
  const CellRect wanted = options_.bounds.given()
                              ? cellsOf(options_.bounds, resolution_)
                              : extent_->fit(cells_, pending_columns_, bricks, options_);
  if (wanted == cells_) return false;
  setGeometry(wanted);
  if (!complete) {
    const std::vector<BrickColumn> columns = bricks.columns();
    pending_columns_.insert(pending_columns_.end(), columns.begin(), columns.end());
    sortUnique(pending_columns_);
  }
  return true;
}

// A new grid with the values of the old one.
void Projection::setGeometry(const CellRect& cells) {
  OccupancyGrid grid(geometryOf(cells, resolution_), -1);
  const CellRect both = cells.intersection(cells_);
  for (int row = both.row; row < both.row + both.height; ++row)
    std::copy_n(grid_.row(row - cells_.row) + both.column - cells_.column, both.width,
                grid.row(row - cells.row) + both.column - cells.column);
  grid_ = std::move(grid);
  cells_ = cells;
}

void Projection::projectColumns(const OccupancyBricks& bricks, CellRect& changed) {
  if (seabed_) addSeabedNeighbours(bricks);
  for (const BrickColumn column : pending_columns_)
    write(column, valuesOf(bricks, column), changed);
  pending_columns_.clear();
}

// Where the bottom of the seabed changed, the seabed's height may change in the columns around it.
void Projection::addSeabedNeighbours(const OccupancyBricks& bricks) {
  std::vector<BrickColumn> changed;
  for (const BrickColumn column : pending_columns_)
    if (seabed_->update(bricks, column)) changed.push_back(column);
  const std::vector<BrickColumn> reached =
      reachedColumns(bricks, std::move(changed), seabed_->reach());
  pending_columns_.insert(pending_columns_.end(), reached.begin(), reached.end());
  sortUnique(pending_columns_);
}

ColumnValues Projection::valuesOf(const OccupancyBricks& bricks, BrickColumn column) const {
  if (seabed_) return valuesAbove(seabed_->heightsAt(column), bricks, column);
  const double reference =
      options_.reference == ProjectionReference::VEHICLE ? vehicle_height_ : 0.0;
  return columnValues(
      bricks, column,
      voxelBand(reference + options_.min_z, reference + options_.max_z, resolution_));
}

// Where no seabed is known, every occupied voxel is an obstacle, and no cell is free.
ColumnValues Projection::valuesAbove(const std::array<double, 64>& seabed,
                                     const OccupancyBricks& bricks, BrickColumn column) const {
  const VoxelBand everything = voxelBand(-1e9, 1e9, resolution_);
  std::array<VoxelBand, 64> bands;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const double z = (seabed[i] - kKeyOfZero + 0.5) * resolution_;
    bands[i] = seabed[i] == Seabed::kNone
                   ? everything
                   : voxelBand(z + options_.min_z, z + options_.max_z, resolution_);
  }
  ColumnValues values = columnValues(bricks, column, bands);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (seabed[i] == Seabed::kNone && values[i] == 0) values[i] = -1;
  return values;
}

void Projection::write(BrickColumn column, const ColumnValues& values, CellRect& changed) {
  const CellRect place = cellsOf(column);
  const CellRect inside = place.intersection(cells_);
  const int skipped = inside.column - place.column;
  for (int row = inside.row; row < inside.row + inside.height; ++row) {
    const std::int8_t* from = values.data() + 8 * (row - place.row) + skipped;
    std::int8_t* to = grid_.row(row - cells_.row) + inside.column - cells_.column;
    if (std::equal(from, from + inside.width, to)) continue;
    int first = 0;
    int last = inside.width - 1;
    while (from[first] == to[first]) ++first;
    while (from[last] == to[last]) --last;
    std::copy(from, from + inside.width, to);
    changed = changed.hull(
        {inside.column - cells_.column + first, row - cells_.row, last - first + 1, 1});
  }
}

}  // namespace grid_path_planner::mapping
