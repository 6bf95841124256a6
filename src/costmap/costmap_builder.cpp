#include "grid_path_planner/costmap/costmap_builder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "costmap/class_changes.h"
#include "costmap/inflation.h"
#include "costmap/kernel.h"
#include "grid_path_planner/grid/prefetch.h"

namespace grid_path_planner::costmap {

using base::StopPoll, base::StopToken;
using grid::addChange, grid::CellRect, grid::disjointRects, grid::Grid, grid::GridGeometry,
    grid::grownRects, grid::Occupancy, grid::OccupancyGrid, grid::OccupancyThresholds,
    grid::prefetchRows;

namespace {

CellRect grown(const CellRect& rect, int margin, const CellRect& within) {
  return rect.grown(margin).intersection(within);
}

void append(const std::vector<CellRect>& rects, std::vector<CellRect>& to) {
  to.insert(to.end(), rects.begin(), rects.end());
}

}  // namespace

// What raises the weights of a map.
struct Inflations {
  Inflations(const CostmapOptions& options, double resolution)
      : Inflations(options, keptDistances(options), resolution) {}
  Inflations(const CostmapOptions& options, const KeptDistances& kept, double resolution)
      : occupied(Occupancy::OCCUPIED, profileOf(options, kept.occupied, true), resolution),
        unknown(Occupancy::UNKNOWN, profileOf(options, kept.unknown, false), resolution),
        outside(Occupancy::OCCUPIED,
                profileOf(options, kept.outside, options.outside == Outside::OCCUPIED),
                resolution) {}

  static InflationProfile profileOf(const CostmapOptions& options, double radius, bool decays) {
    return {std::max(0.0, radius), decays ? options.decay : 0.0, options.free_weight,
            options.inflation_weight};
  }

  // Of a whole map's weights by class, those of `rect`.
  void apply(const Grid<Occupancy>& classes, const CellRect& rect, Grid<CostGrid::Weight>& weights,
             const StopToken& stop) const {
    const CellRect all = classes.geometry().rect();
    occupied.apply(classes, all, rect, weights, stop);
    unknown.apply(classes, all, rect, weights, stop);
    outside.applyBorder(rect, weights, stop);
  }

  // Where cells of `filled` became occupied, which have the weight of their class, and nothing else
  // changed.
  void raise(const Grid<Occupancy>& classes, const CellRect& filled,
             Grid<CostGrid::Weight>& weights, const StopToken& stop) const {
    const CellRect all = classes.geometry().rect();
    occupied.apply(classes, filled, grown(filled, occupied.reach(), all), weights, stop);
    unknown.apply(classes, all, filled, weights, stop);
    outside.applyBorder(filled, weights, stop);
  }

  // The same for occupied cells that are blocked, each by itself.
  void raiseEach(const Grid<Occupancy>& classes, const CellRect& filled,
                 Grid<CostGrid::Weight>& weights) const {
    for (int row = filled.row; row < filled.row + filled.height; ++row)
      for (int column = filled.column; column < filled.column + filled.width; ++column) {
        if (classes.row(row)[column] != Occupancy::OCCUPIED) continue;
        weights.row(row)[column] = CostGrid::kBlocked;
        occupied.raiseAround({column, row}, weights);
      }
  }

  Inflation occupied;
  Inflation unknown;
  Inflation outside;
};

namespace {

// What follows from changes of classes.
struct Rewriting {
  Rewriting(const ClassChanges& changes, const Inflations& inflations, bool occupied_is_blocked,
            const CellRect& map) {
    const int reach = inflations.occupied.reach();
    const bool stamped = occupied_is_blocked && inflations.occupied.hasStamp();
    recomputed = joinedRects(changes.other, 0);
    for (const CellRect& rect : joinedRects(changes.vacated, reach))
      recomputed.push_back(grown(rect, reach, map));
    // Around unknown cells there is no weight but blocked, so all of it is computed again.
    if (!inflations.unknown.none())
      for (const CellRect& rect : joinedRects(changes.all, inflations.unknown.reach()))
        recomputed.push_back(grown(rect, inflations.unknown.reach(), map));
    if (recomputed.size() <= grid::kMostRects) recomputed = disjointRects(recomputed);
    for (const CellRect& rect : changes.filled)
      if (!isRecomputed(grown(rect, reach, map)))
        (stamped && rect.width * rect.height <= kMostStamps ? few : raised).push_back(rect);
    raised = joinedRects(raised, reach);
    all = recomputed;
    for (const auto* filled : {&few, &raised})
      for (const CellRect& rect : *filled) all.push_back(grown(rect, reach, map));
    all = disjointRects(all);
  }

  // Whether one of the rectangles to be computed again, if these are few, holds it.
  bool isRecomputed(const CellRect& rect) const {
    return recomputed.size() <= grid::kMostRects &&
           std::any_of(recomputed.begin(), recomputed.end(),
                       [&](const CellRect& each) { return each.intersection(rect) == rect; });
  }

  // Cells that an inflation one by one takes less time for than one of all together.
  static constexpr int kMostStamps = 16;

  std::vector<CellRect> recomputed;  // whose weights are computed again
  std::vector<CellRect> raised;      // around which weights rise
  std::vector<CellRect> few;         // the same, where few cells are filled
  std::vector<CellRect> all;         // disjoint; whose weights are written
};

void writeWeights(const Grid<Occupancy>& classes, const CostmapOptions& options,
                  const CellRect& rect, Grid<CostGrid::Weight>& weights, const StopToken& stop) {
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

// As writeWeights(), for the occupied cells only.
void writeOccupiedWeights(const Grid<Occupancy>& classes, const CostmapOptions& options,
                          const CellRect& rect, Grid<CostGrid::Weight>& weights,
                          const StopToken& stop) {
  const CostGrid::Weight weight = classWeight(Occupancy::OCCUPIED, options);
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      if (classes.row(row)[column] == Occupancy::OCCUPIED) weights.row(row)[column] = weight;
  }
}

}  // namespace

CostmapBuilder::CostmapBuilder(const CostmapOptions& options) : options_(options) {
  checkCostmapOptions(options);
}

std::size_t CostmapBuilder::bytesFor(const GridGeometry& geometry, int kernel,
                                     std::size_t buffers) {
  const auto all = [buffers](const GridGeometry& of) {
    const std::size_t cell = sizeof(CostGrid::Weight) + sizeof(Occupancy);
    return buffers * (of.size() * cell + BitMaps::bytesFor(of));
  };
  return all(geometry) + (kernel > 1 ? all(blockGeometry(geometry, kernel)) : 0);
}

void CostmapBuilder::setMap(std::shared_ptr<const OccupancyGrid> map) {
  assert(map);
  map_ = std::move(map);
  inflations_ = std::make_shared<const Inflations>(options_, map_->geometry().resolution());
  full_.reset(nullptr);
  downsampled_.reset(nullptr);
  downsampled_dirty_.clear();
  full_dirty_.clear();
}

void CostmapBuilder::updateMap(std::shared_ptr<const OccupancyGrid> map,
                               const std::vector<CellRect>& changed) {
  assert(map && map_ && map->geometry() == map_->geometry());
  map_ = std::move(map);
  append(changed, full_dirty_);
  full_dirty_ = grownRects(full_dirty_, 0, map_->geometry().rect());
}

std::shared_ptr<const CostGrid> CostmapBuilder::fullResolution(const StopToken& stop) {
  bringUpToDate(stop);
  return full_.current();
}

std::shared_ptr<const CostGrid> CostmapBuilder::downsampled(const StopToken& stop) {
  bringUpToDate(stop);
  return options_.kernel == 1 ? full_.current() : downsampled_.current();
}

void CostmapBuilder::makeReadyForChanges(const StopToken& stop) {
  const auto copy = [&stop](const CostGrid& map) { return map.copyToEdit(stop); };
  full_.makeSpare(copy);
  downsampled_.makeSpare(copy);
}

void CostmapBuilder::bringUpToDate(const StopToken& stop) {
  assert(map_);
  if (!full_.current()) return build(stop);
  if (!full_dirty_.empty()) updateFullResolution(stop);
  if (!downsampled_dirty_.empty()) updateDownsampled(stop);
}

void CostmapBuilder::build(const StopToken& stop) {
  const CellRect all = map_->geometry().rect();
  Grid<Occupancy> classes(map_->geometry());
  Grid<CostGrid::Weight> weights(map_->geometry());
  classify(*map_, options_.thresholds, all, classes, stop);
  writeWeights(classes, options_, all, weights, stop);
  inflations_->apply(classes, all, weights, stop);
  auto full = std::make_unique<CostGrid>(std::move(weights), std::move(classes), options_.motion);
  full->setKeptDistances(keptDistances(options_));
  full->setRevision(full_.nextSeries());
  if (options_.kernel > 1) {
    auto blocks = buildDownsampled(*full, stop);
    const std::uint64_t revision = blocks->revision();
    downsampled_.reset(std::move(blocks), revision);
  }
  const std::uint64_t revision = full->revision();
  full_.reset(std::move(full), revision);
  full_dirty_.clear();
}

std::unique_ptr<CostGrid> CostmapBuilder::buildDownsampled(const CostGrid& full,
                                                           const StopToken& stop) const {
  const GridGeometry geometry = blockGeometry(full.geometry(), options_.kernel);
  Grid<Occupancy> classes(geometry);
  Grid<CostGrid::Weight> weights(geometry);
  applyKernel(full, options_, full.geometry().rect(), weights, classes, stop);
  auto blocks = std::make_unique<CostGrid>(std::move(weights), std::move(classes), options_.motion,
                                           options_.kernel, full.geometry());
  blocks->setKeptDistances(full.keptDistances());
  blocks->setRevision(downsampled_.nextSeries());
  return blocks;
}

// Around cells that are no longer occupied all weights are computed again; around cells that are
// occupied now the weights only rise, by the inflation of these cells.
void CostmapBuilder::updateFullResolution(const StopToken& stop) {
  const ClassChanges changes(*map_, options_.thresholds, full_dirty_, full_.current()->classes(),
                             stop);
  if (!changes.all.empty()) {
    const std::vector<CellRect> changed = rewriteWeights(changes, stop);
    if (options_.kernel > 1) addChange(changed, downsampled_dirty_);
  }
  full_dirty_.clear();
}

std::vector<CellRect> CostmapBuilder::rewriteWeights(const ClassChanges& changes,
                                                     const StopToken& stop) {
  const CellRect all = map_->geometry().rect();
  const bool blocked = classWeight(Occupancy::OCCUPIED, options_) == CostGrid::kBlocked;
  const Rewriting rewriting(changes, *inflations_, blocked, all);
  StopPoll poll(stop, 16);
  for (const CellRect& rect : rewriting.all) prefetchRows(full_.current()->weights(), rect);
  const std::vector<CellRect> new_classes = disjointRects(changes.all);
  full_.advance({rewriting.all, new_classes}, [&](CostGrid& next) {
    for (const CellRect& rect : rewriting.all) prefetchRows(next.weights(), rect);
    for (const CellRect& rect : rewriting.all)
      prefetchRows(next.classes(), grown(rect, inflations_->occupied.reach(), all));
    next.edit(*full_.current(), rewriting.all, [&](auto& weights, auto& classes) {
      for (const CellRect& rect : new_classes)
        classify(*map_, options_.thresholds, rect, classes, stop);
      for (const CellRect& rect : rewriting.recomputed) {
        poll();
        writeWeights(classes, options_, rect, weights, stop);
        inflations_->apply(classes, rect, weights, stop);
      }
      for (const CellRect& filled : rewriting.raised) {
        poll();
        writeOccupiedWeights(classes, options_, filled, weights, stop);
        inflations_->raise(classes, filled, weights, stop);
      }
      for (const CellRect& filled : rewriting.few) inflations_->raiseEach(classes, filled, weights);
    });
    next.setRevision(full_.revision() + 1);
  });
  return rewriting.all;
}

void CostmapBuilder::updateDownsampled(const StopToken& stop) {
  std::vector<CellRect> blocks;
  for (const CellRect& rect : downsampled_dirty_) blocks.push_back(blocksOf(rect, options_.kernel));
  blocks = disjointRects(blocks);
  downsampled_.advance({blocks, blocks}, [&](CostGrid& next) {
    next.edit(*downsampled_.current(), blocks, [&](auto& weights, auto& classes) {
      for (const CellRect& rect : downsampled_dirty_)
        applyKernel(*full_.current(), options_, rect, weights, classes, stop);
    });
    next.setRevision(downsampled_.revision() + 1);
  });
  downsampled_dirty_.clear();
}

}  // namespace grid_path_planner::costmap
