#include "grid_path_planner/costmap/costmap_builder.h"

#include <array>
#include <cassert>
#include <utility>

#include "costmap/kernel.h"
#include "grid_path_planner/grid/prefetch.h"

namespace grid_path_planner::costmap {

using base::StopPoll;
using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;
using grid::OccupancyGrid;
using grid::OccupancyThresholds;
using grid::prefetchRows;

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

// The smallest rectangle around the cells of `rect` whose value and class before changed(value,
// before) holds for.
template <class Changed>
CellRect hullOf(const OccupancyGrid& map, const Grid<Occupancy>& classes, const CellRect& rect,
                const StopToken& stop, const Changed& changed) {
  StopPoll poll(stop, 64);
  CellRect hull;
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const std::int8_t* values = map.row(row);
    const Occupancy* before = classes.row(row);
    int first = rect.column;
    int end = rect.column + rect.width;
    while (first < end && !changed(values[first], before[first])) ++first;
    if (first == end) continue;
    while (!changed(values[end - 1], before[end - 1])) --end;
    hull = hull.hull({first, row, end - first, 1});
  }
  return hull;
}

// Around the cells whose class is no longer that of the map.
struct ClassChanges {
  CellRect all;
  CellRect filled;   // occupied now
  CellRect opened;   // not occupied now
  CellRect vacated;  // and were before
};

ClassChanges changesOf(const OccupancyGrid& map, const OccupancyThresholds& thresholds,
                       const CellRect& rect, const Grid<Occupancy>& classes,
                       const StopToken& stop) {
  const auto around = [&](const CellRect& within, const auto& is) {
    return hullOf(map, classes, within, stop, [&](std::int8_t value, Occupancy before) {
      const Occupancy now = thresholds.classify(value);
      return now != before && is(now, before);
    });
  };
  constexpr Occupancy kOccupied = Occupancy::OCCUPIED;
  ClassChanges changes;
  changes.all = around(rect, [](Occupancy, Occupancy) { return true; });
  changes.filled = around(changes.all, [](Occupancy now, Occupancy) { return now == kOccupied; });
  changes.opened = around(changes.all, [](Occupancy now, Occupancy) { return now != kOccupied; });
  changes.vacated =
      around(changes.opened, [](Occupancy, Occupancy before) { return before == kOccupied; });
  return changes;
}

void weigh(const Grid<Occupancy>& classes, const CostmapOptions& options, const CellRect& rect,
           Grid<CostGrid::Weight>& weights, const StopToken& stop) {
  std::array<CostGrid::Weight, 3> by_class;
  for (const Occupancy each : {Occupancy::FREE, Occupancy::UNKNOWN, Occupancy::OCCUPIED})
    by_class[static_cast<std::size_t>(each)] = classWeight(each, options);
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const Occupancy* from = classes.row(row);
    CostGrid::Weight* to = weights.row(row);
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      to[column] = by_class[static_cast<std::size_t>(from[column])];
  }
}

// Of the occupied cells, as weigh() does of all.
void weighOccupied(const Grid<Occupancy>& classes, const CostmapOptions& options,
                   const CellRect& rect, Grid<CostGrid::Weight>& weights, const StopToken& stop) {
  const CostGrid::Weight weight = classWeight(Occupancy::OCCUPIED, options);
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      if (classes.row(row)[column] == Occupancy::OCCUPIED) weights.row(row)[column] = weight;
  }
}

CellRect blocksOf(const CellRect& cells, int kernel) {
  const Cell first{cells.column / kernel, cells.row / kernel};
  const Cell last{(cells.column + cells.width - 1) / kernel,
                  (cells.row + cells.height - 1) / kernel};
  return {first.column, first.row, last.column - first.column + 1, last.row - first.row + 1};
}

}  // namespace

CostmapBuilder::CostmapBuilder(const CostmapOptions& options) : options_(options) {
  checkCostmapOptions(options);
}

void CostmapBuilder::setMap(std::shared_ptr<const OccupancyGrid> map) {
  assert(map);
  map_ = std::move(map);
  inflation_.emplace(options_, map_->geometry().resolution());
  fine_.begin(nullptr);
  searched_.begin(nullptr);
  searched_dirty_ = {};
  fine_dirty_ = {};
}

void CostmapBuilder::updateMap(std::shared_ptr<const OccupancyGrid> map, const CellRect& changed) {
  assert(map && map_ && map->geometry() == map_->geometry());
  map_ = std::move(map);
  fine_dirty_ = fine_dirty_.hull(changed.intersection(map_->geometry().rect()));
}

std::shared_ptr<const CostGrid> CostmapBuilder::fullResolution(const StopToken& stop) {
  bringUpToDate(stop);
  return fine_.current();
}

std::shared_ptr<const CostGrid> CostmapBuilder::downsampled(const StopToken& stop) {
  bringUpToDate(stop);
  return options_.kernel == 1 ? fine_.current() : searched_.current();
}

void CostmapBuilder::bringUpToDate(const StopToken& stop) {
  assert(map_);
  if (!fine_.current()) return makeAnew(stop);
  if (!fine_dirty_.empty()) updateFine(stop);
  if (!searched_dirty_.empty()) updateSearched(stop);
}

void CostmapBuilder::makeAnew(const StopToken& stop) {
  const CellRect all = map_->geometry().rect();
  Grid<Occupancy> classes(map_->geometry());
  Grid<CostGrid::Weight> weights(map_->geometry());
  classify(*map_, options_.thresholds, all, classes, stop);
  weigh(classes, options_, all, weights, stop);
  inflation_->apply(classes, all, all, weights, stop);
  auto fine = std::make_shared<CostGrid>(std::move(weights), std::move(classes), options_.motion);
  fine->setRevision(++revision_);

  if (options_.kernel > 1) {
    const GridGeometry geometry = blockGeometry(fine->geometry(), options_.kernel);
    Grid<Occupancy> block_classes(geometry);
    Grid<CostGrid::Weight> block_weights(geometry);
    applyKernel(*fine, options_, all, block_weights, block_classes, stop);
    auto searched = std::make_shared<CostGrid>(std::move(block_weights), std::move(block_classes),
                                               options_.motion, options_.kernel, fine->geometry());
    searched->setRevision(revision_);
    searched_.begin(std::move(searched));
  }
  fine_change_ = all;
  searched_change_ = blocksOf(all, options_.kernel);
  fine_.begin(std::move(fine));
  fine_dirty_ = {};
}

// Cells around what is occupied no more are made from the ground up; those around what is occupied
// now become dearer, by that alone.
void CostmapBuilder::updateFine(const StopToken& stop) {
  const CellRect everything = map_->geometry().rect();
  const ClassChanges changes =
      changesOf(*map_, options_.thresholds, fine_dirty_, fine_.current()->classes(), stop);
  if (!changes.all.empty()) {
    const auto around = [&](const CellRect& rect) {
      return rect.empty() ? rect : rect.grown(inflation_->reach()).intersection(everything);
    };
    const CellRect anew = changes.opened.hull(around(changes.vacated));
    const CellRect dearer = around(changes.filled);
    const CellRect rewritten = anew.hull(dearer);
    prefetchRows(fine_.current()->weights(), rewritten);
    fine_.advance({rewritten, changes.all}, [&](CostGrid& next) {
      prefetchRows(next.weights(), rewritten);
      prefetchRows(next.classes(), around(anew));
      next.edit(*fine_.current(), rewritten, [&](auto& weights, auto& classes) {
        classify(*map_, options_.thresholds, changes.all, classes, stop);
        weigh(classes, options_, anew, weights, stop);
        inflation_->apply(classes, everything, anew, weights, stop);
        weighOccupied(classes, options_, changes.filled, weights, stop);
        inflation_->apply(classes, changes.filled, dearer, weights, stop);
      });
      next.setRevision(revision_ + 1);
    });
    ++revision_;
    fine_change_ = rewritten;
    searched_dirty_ = searched_dirty_.hull(rewritten);
  }
  fine_dirty_ = {};
}

void CostmapBuilder::updateSearched(const StopToken& stop) {
  const CellRect blocks = blocksOf(searched_dirty_, options_.kernel);
  if (options_.kernel > 1)
    searched_.advance({blocks, blocks}, [&](CostGrid& next) {
      next.edit(*searched_.current(), blocks, [&](auto& weights, auto& classes) {
        applyKernel(*fine_.current(), options_, searched_dirty_, weights, classes, stop);
      });
      next.setRevision(revision_);
    });
  searched_change_ = blocks;
  searched_dirty_ = {};
}

}  // namespace grid_path_planner::costmap
