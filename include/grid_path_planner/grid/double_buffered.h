// The newest map of a series in which each differs from the one before in a rectangle, made in time
// proportional to the rectangles. Map: a Grid<T>, or what has a copyCells() of its own, which may
// ask for another kind of Change than a rectangle.
//
//   DoubleBuffered<OccupancyGrid> turns;
//   turns.begin(std::make_shared<OccupancyGrid>(map));
//   reader = turns.current();                              // stays as it is
//   turns.advance(changed, [&](OccupancyGrid& next) { next[cell] = 100; });
//   reader = turns.current();                              // the next one
//
// Two maps take turns: the one before the current is written if nobody else holds it any more, once
// it has caught up with the rectangle it missed. Where somebody does, it is left to them and the
// current one is copied. So a change costs what its rectangle costs as long as every reader moves
// on before the second change after his map's. Memory: two maps from the first change on.
//
// For one thread; the maps handed out may be read, and let go, in any.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

#include "grid_path_planner/grid/grid.h"
#include "grid_path_planner/grid/prefetch.h"

namespace grid_path_planner::grid {

// Precondition: `rect` lies in both, which are of the same size.
template <class T>
void copyCells(const Grid<T>& from, const CellRect& rect, Grid<T>& to) {
  prefetchRows(from, rect);
  prefetchRows(to, rect);
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    std::copy_n(from.row(row) + rect.column, rect.width, to.row(row) + rect.column);
}

template <class Map, class Change = CellRect>
class DoubleBuffered {
 public:
  // Null before begin().
  std::shared_ptr<const Map> current() const { return current_; }

  void begin(std::shared_ptr<Map> first) {
    current_ = std::move(first);
    spare_.reset();
  }

  // Makes the map that differs from the current one by `change`: write(next) is given one that is
  // like the current. What `write` throws leaves the current one as it is.
  // Precondition: begin() gave a map, in which the change lies.
  template <class Write>
  void advance(const Change& change, Write&& write) {
    std::shared_ptr<Map> next = likeCurrent();
    write(*next);
    spare_ = std::exchange(current_, std::move(next));
    missed_ = change;
  }

 private:
  std::shared_ptr<Map> likeCurrent() {
    std::shared_ptr<Map> spare = std::move(spare_);
    if (!spare || spare.use_count() > 1) return std::make_shared<Map>(*current_);
    std::atomic_thread_fence(std::memory_order_acquire);  // after what others read of it
    copyCells(*current_, missed_, *spare);
    return spare;
  }

  std::shared_ptr<Map> current_;
  std::shared_ptr<Map> spare_;  // the one before
  Change missed_;               // in which the two differ
};

}  // namespace grid_path_planner::grid
