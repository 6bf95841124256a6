// A table of lower bounds of the cost between cells that takes long to compute: computed in a
// background thread, used when it is done, and kept valid while the map changes.
//
//   PrecomputedTable<LandmarkTable> tables([](const CostGrid& map, const StopToken& stop) {
//     return LandmarkTable(map, 16, stop);
//   });
//   tables.prepare(map);
//   if (const LandmarkTable* table = tables.ready())
//     LandmarkBound bound(*table, tables.decreases(), goal_index);
//
// Where costs increase a bound remains a bound. Cost decreases go into Table::Decreases, which
// repairs the bounds in time proportional to the change, or makes the table unusable. A new table is
// made when it does, or when so much has changed that the bounds are loose. The old one is used
// meanwhile, unless costs decreased at places far from each other: such bounds would cost more time
// than they save.
//
// Not thread-safe but towards its own thread, with which it shares the map while a table is made.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/tables/background.h"

namespace grid_path_planner::planners {

// The smallest rectangle around the cells of `rect` whose weights are lower in `after` than in
// `before`, or that are passable only there.
grid::CellRect costDecreases(const costmap::CostGrid& before, const costmap::CostGrid& after,
                             const grid::CellRect& rect);

// Whether so much of a map has changed that its tables should be made anew: `cells` of it, counted
// as often as they did, with all cost decreases in `hull`.
bool looseAfter(const grid::GridGeometry& geometry, std::size_t cells, const grid::CellRect& hull);

template <class Table>
class PrecomputedTable {
 public:
  using Decreases = typename Table::Decreases;
  using Make = std::function<Table(const costmap::CostGrid&, const base::StopToken&)>;

  explicit PrecomputedTable(Make make) : make_(std::move(make)) {}

  // Removes the table and begins a new one.
  void prepare(std::shared_ptr<const costmap::CostGrid> map) {
    made_.reset();
    begin(std::move(map));
  }

  // `map` differs from `before`, the one of the last call, only inside `changed`: rectangles in the
  // map. Begins a new table where the one that is there is worn.
  void update(const costmap::CostGrid& before, std::shared_ptr<const costmap::CostGrid> map,
              const std::vector<grid::CellRect>& changed) {
    follow(before, *map, changed);
    if (worn()) begin(std::move(map));
  }

  // The same without a new table.
  void follow(const costmap::CostGrid& before, const costmap::CostGrid& map,
              const std::vector<grid::CellRect>& changed) {
    adopt();
    for (const grid::CellRect& rect : changed) {
      const Change change = {rect, costDecreases(before, map, rect)};
      add(change);
      if (begun_) since_begin_.push_back(change);
    }
  }

  // Whether the map has changed so much that the bounds are loose, and no new table is being made.
  bool worn() const {
    return !begun_ && made_ &&
           (!decreases_.usable() || looseAfter(geometry_, changed_cells_, decreases_.hull()));
  }

  // Null while there is no table that can be used. Both hold until the next call of another method.
  const Table* ready() {
    adopt();
    return made_ && decreases_.usable() && !looseAfter(geometry_, 0, decreases_.hull())
               ? &made_->table
               : nullptr;
  }
  // Whether there is one at all.
  bool made() const { return made_ != nullptr; }
  const Decreases& decreases() const { return decreases_; }

  // Waits until no table is being made. Throws Stopped.
  void wait(const base::StopToken& stop) const { making_.wait(stop); }

  BackgroundWork work() {
    adopt();
    BackgroundWork work;
    work.pending = begun_;
    if (made_) work.time_s = made_->time_s;
    if (made_) work.bytes = made_->table.bytes();
    return work;
  }

 private:
  struct Made {
    Table table;
    double time_s;
  };
  struct Change {
    grid::CellRect rect;
    grid::CellRect decreased;
  };

  void begin(std::shared_ptr<const costmap::CostGrid> map) {
    since_begin_.clear();
    begun_ = true;
    geometry_ = map->geometry();
    making_.start([make = make_, map = std::move(map)](const base::StopToken& stop) mutable {
      const auto begin = base::StopToken::Clock::now();
      Table table = make(*map, stop);
      map.reset();  // whoever changes the map next may have it
      return Made{std::move(table),
                  std::chrono::duration<double>(base::StopToken::Clock::now() - begin).count()};
    });
  }

  // Takes over a new table, with the changes since it was begun.
  void adopt() {
    const bool ended = !making_.running();
    std::shared_ptr<const Made> made = making_.take();
    if (ended) begun_ = false;
    if (!made) return;
    begun_ = false;
    made_ = std::move(made);
    decreases_ = Decreases();
    changed_cells_ = 0;
    for (const Change& change : since_begin_) add(change);
    since_begin_.clear();
  }

  // To what changed since made_ was begun, if there is one.
  void add(const Change& change) {
    changed_cells_ +=
        static_cast<std::size_t>(change.rect.width) * static_cast<std::size_t>(change.rect.height);
    if (made_ && !change.decreased.empty())
      decreases_.add(made_->table, geometry_, change.decreased);
  }

  Make make_;
  grid::GridGeometry geometry_;
  std::shared_ptr<const Made> made_;
  Decreases decreases_;            // since made_ was begun
  std::size_t changed_cells_ = 0;  // since then
  std::vector<Change> since_begin_;
  bool begun_ = false;  // and neither taken over nor given up
  Background<Made> making_;
};

}  // namespace grid_path_planner::planners
