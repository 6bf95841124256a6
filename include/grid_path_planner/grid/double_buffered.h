// Double buffering: the newest map of a series in which each differs from the one before in a few
// rectangles, made in time proportional to these. Map: a Grid<T>, or a class with a copyCells() of
// its own, which may take another type of Change than a list of rectangles.
//
//   DoubleBuffered<OccupancyGrid> maps;
//   maps.reset(std::make_unique<OccupancyGrid>(map));
//   reader = maps.current();                              // does not change
//   maps.advance({changed}, [&](OccupancyGrid& next) { next[cell] = 100; });
//   reader = maps.current();                              // the next one
//
// Two maps alternate: what the previous map missed is copied into it, and then it is written. Where a
// reader still holds the previous map, the current one is copied instead. So a change costs time in
// proportion to its rectangles as long as every reader drops its map before the
// second change after it. Memory: two maps from the first change on.
//
// For one thread; the maps returned may be read, and released, in any.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

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

// Precondition: each of `rects` does.
template <class T>
void copyCells(const Grid<T>& from, const std::vector<CellRect>& rects, Grid<T>& to) {
  for (const CellRect& rect : rects) copyCells(from, rect, to);
}

template <class Map, class Change = std::vector<CellRect>>
class DoubleBuffered {
 public:
  // Null before reset().
  std::shared_ptr<const Map> current() const { return current_.shown; }

  // Starts a series; null: without a map.
  void reset(std::unique_ptr<Map> first) {
    current_ = first ? shownTo(std::move(first)) : Buffer();
    spare_ = {};
  }

  // Makes the map that differs from the current one by `change`: write(next) gets a map that equals
  // the current one. If it throws, the current map stays.
  // Precondition: reset() got a map, in which the change lies.
  template <class Write>
  void advance(const Change& change, Write&& write) {
    std::shared_ptr<Map> next = copyOfCurrent();
    write(*next);
    spare_ = std::exchange(current_, shownTo(std::move(next)));
    spare_.shown.reset();
    missed_ = change;
  }

 private:
  // What is written to through `map` and read through `shown`. The last who reads it lets go of it in
  // that pointer's deleter: a release that the next write acquires.
  struct Buffer {
    std::shared_ptr<Map> map;
    std::shared_ptr<std::atomic<bool>> is_read;
    std::shared_ptr<const Map> shown;
  };

  static Buffer shownTo(std::shared_ptr<Map> map) {
    auto is_read = std::make_shared<std::atomic<bool>>(true);
    const auto let_go = [map, is_read](const Map*) {
      is_read->store(false, std::memory_order_release);
    };
    std::shared_ptr<const Map> shown(map.get(), let_go);
    return {std::move(map), std::move(is_read), std::move(shown)};
  }

  std::shared_ptr<Map> copyOfCurrent() {
    const Buffer spare = std::exchange(spare_, {});
    if (!spare.map || spare.is_read->load(std::memory_order_acquire))
      return std::make_shared<Map>(*current_.map);
    copyCells(*current_.map, missed_, *spare.map);
    return spare.map;
  }

  Buffer current_;
  Buffer spare_;   // the previous map, without `shown`
  Change missed_;  // in which the two maps differ
};

}  // namespace grid_path_planner::grid
