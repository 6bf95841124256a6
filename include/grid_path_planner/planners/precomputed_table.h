// Lower bounds of the cost between cells that take long to make: made in a thread of their own,
// used when they are there, and kept true while the map changes.
//
//   PrecomputedTable<LandmarkTable> tables([](const CostGrid& map, const StopToken& stop) {
//     return LandmarkTable(map, 16, stop);
//   });
//   tables.prepare(map);
//   if (const LandmarkTable* table = tables.ready())
//     LandmarkBound bound(*table, tables.cheaper(), goal_index);
//
// Where the map gets dearer a bound stays a bound. Where it gets cheaper the table's
// Table::Cheaper is told, which repairs the bounds in time proportional to the change, or makes the
// table unusable. A new table is made when that is so, or when so much has changed that the bounds
// are loose; meanwhile the old one serves, unless places far from each other became cheaper: such
// bounds would cost more time than they save.
//
// Not thread-safe but towards its own thread, with which it shares the map while a table is made.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "grid_path_planner/base/background.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/planner.h"

namespace grid_path_planner::planners {

// The smallest rectangle around the cells of `rect` that are cheaper in `after` than in `before`,
// or passable only there.
grid::CellRect cheaperCells(const costmap::CostGrid& before, const costmap::CostGrid& after,
                            const grid::CellRect& rect);

// Whether so much of a map has changed that its tables should be made anew: `cells` of it, counted
// as often as they did, with places that became cheaper in `hull`.
bool looseAfter(const grid::GridGeometry& geometry, std::size_t cells, const grid::CellRect& hull);

template <class Table>
class PrecomputedTable {
 public:
  using Cheaper = typename Table::Cheaper;
  using Make = std::function<Table(const costmap::CostGrid&, const base::StopToken&)>;

  explicit PrecomputedTable(Make make) : make_(std::move(make)) {}

  // Drops what there is and begins anew.
  void prepare(std::shared_ptr<const costmap::CostGrid> map) {
    made_.reset();
    begin(std::move(map));
  }

  // `map` differs from `before`, the one of the last call, only inside `changed`.
  void update(const costmap::CostGrid& before, std::shared_ptr<const costmap::CostGrid> map,
              const grid::CellRect& changed) {
    adopt();
    const grid::CellRect rect = changed.intersection(geometry_.rect());
    const grid::CellRect cheaper = cheaperCells(before, *map, rect);
    changed_cells_ += static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
    if (!cheaper.empty() && made_) cheaper_.add(made_->table, geometry_, cheaper);
    if (begun_)
      since_begin_.push_back({rect, cheaper});
    else if (made_ &&
             (!cheaper_.usable() || looseAfter(geometry_, changed_cells_, cheaper_.hull())))
      begin(std::move(map));
  }

  // Null while there is no table that can be used. Both hold until the next call of another method.
  const Table* ready() {
    adopt();
    return made_ && cheaper_.usable() && !looseAfter(geometry_, 0, cheaper_.hull()) ? &made_->table
                                                                                    : nullptr;
  }
  const Cheaper& cheaper() const { return cheaper_; }

  // Returns when nothing is made any more. Throws Stopped.
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
    grid::CellRect cheaper;
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

  // Takes over a new table, and tells it what happened since it was begun.
  void adopt() {
    const bool ended = !making_.running();
    std::shared_ptr<const Made> made = making_.take();
    if (ended) begun_ = false;
    if (!made) return;
    begun_ = false;
    made_ = std::move(made);
    cheaper_ = Cheaper();
    changed_cells_ = 0;
    for (const Change& change : since_begin_) {
      changed_cells_ += static_cast<std::size_t>(change.rect.width) *
                        static_cast<std::size_t>(change.rect.height);
      if (!change.cheaper.empty()) cheaper_.add(made_->table, geometry_, change.cheaper);
    }
    since_begin_.clear();
  }

  Make make_;
  grid::GridGeometry geometry_;
  std::shared_ptr<const Made> made_;
  Cheaper cheaper_;                // since made_ was begun
  std::size_t changed_cells_ = 0;  // since then
  std::vector<Change> since_begin_;
  bool begun_ = false;  // and neither taken over nor given up
  base::Background<Made> making_;
};

}  // namespace grid_path_planner::planners
