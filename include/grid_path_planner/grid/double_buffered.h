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
// reader still holds the previous map, a third one takes part, and where that is held too, the
// current one is copied instead. So a change costs time in proportion to its rectangles as long as
// no more than two readers keep maps of before. Memory: two maps from the first change on, and
// another for each old one that is held. Whoever has time before a change lets makeSpare() copy the map
// then, so that no change waits for that.
//
// Every map of a series has a revision, which no map of another series has, and changes() tells what
// changed since one of them: whoever misses some maps catches up with all at once.
//
// For one thread; the maps returned may be read, and released, in any.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
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

// Adds the cells of a later change to those of an earlier one.
inline void addChange(const std::vector<CellRect>& later, std::vector<CellRect>& to) {
  to.insert(to.end(), later.begin(), later.end());
  to = disjointRects(to);
}

// The last changes of a series of maps. A copy stays as it is, and costs next to nothing.
template <class Change = std::vector<CellRect>>
class ChangeLog {
 public:
  static constexpr std::size_t kMost = 16;  // changes that are kept

  // Begins with a map of this revision; each change makes the next one.
  void restart(std::uint64_t revision) {
    changes_.clear();
    newest_ = revision;
  }
  void add(Change change) {
    changes_.push_back(std::make_shared<const Change>(std::move(change)));
    if (changes_.size() > kMost) changes_.pop_front();
    ++newest_;
  }

  std::uint64_t newest() const { return newest_; }

  // What changed since then, rectangles disjoint; nullopt where that is not known: too long ago, or
  // another series.
  std::optional<Change> since(std::uint64_t revision) const {
    if (revision > newest_ || newest_ - revision > changes_.size()) return std::nullopt;
    Change all;
    for (auto each = changes_.end() - static_cast<std::ptrdiff_t>(newest_ - revision);
         each != changes_.end(); ++each)
      addChange(**each, all);
    return all;
  }

 private:
  std::deque<std::shared_ptr<const Change>> changes_;
  std::uint64_t newest_ = 0;
};

template <class Map, class Change = std::vector<CellRect>>
class DoubleBuffered {
 public:
  // Null before reset().
  std::shared_ptr<const Map> current() const { return current_.shown; }
  // Of the current map; that of the next one is one higher.
  std::uint64_t revision() const { return log_.newest(); }
  const ChangeLog<Change>& changes() const { return log_; }
  // How many maps are kept.
  std::size_t buffers() const { return spares_.size() + (current_.map ? 1 : 0); }

  // Starts a series; null: without a map. `revision`: of the map, taken from nextSeries().
  void reset(std::unique_ptr<Map> first, std::uint64_t revision = nextSeries()) {
    current_ = first ? shownTo(std::move(first)) : Buffer();
    spares_.clear();
    log_.restart(revision);
  }
  // A revision above those of all series so far.
  static std::uint64_t nextSeries() {
    constexpr unsigned kBitsOfASeries = 40;
    return ++seriesSoFar() << kBitsOfASeries;
  }

  // Makes the map that differs from the current one by `change`: write(next) gets a map that equals
  // the current one. If it throws, the current map stays.
  // Precondition: reset() got a map, in which the change lies.
  template <class Write>
  void advance(const Change& change, Write&& write) {
    const std::uint64_t before = revision();
    std::shared_ptr<Map> next = copyOfCurrent();
    write(*next);
    log_.add(change);
    if (spares_.size() == kMostSpares) spares_.erase(spares_.begin());
    spares_.push_back({std::exchange(current_, shownTo(std::move(next))), before});
    spares_.back().buffer.shown.reset();
  }

  // Makes now the copy that the next change would make, if it would: copy(map) gives it, in a pointer. If
  // it throws, nothing is changed.
  template <class Copy>
  void makeSpare(Copy&& copy) {
    const auto is_free = [](const Spare& spare) {
      return !spare.buffer.is_read->load(std::memory_order_acquire);
    };
    if (!current_.map || spares_.size() == kMostSpares) return;
    if (std::any_of(spares_.begin(), spares_.end(), is_free)) return;
    std::shared_ptr<Map> map = copy(std::as_const(*current_.map));
    auto is_read = std::make_shared<std::atomic<bool>>(false);
    spares_.push_back({{std::move(map), std::move(is_read), nullptr}, revision()});
  }

 private:
  // What is written to through `map` and read through `shown`. The last who reads it lets go of it in
  // that pointer's deleter: a release that the next write acquires.
  struct Buffer {
    std::shared_ptr<Map> map;
    std::shared_ptr<std::atomic<bool>> is_read;
    std::shared_ptr<const Map> shown;
  };
  // A map of before, without `shown`.
  struct Spare {
    Buffer buffer;
    std::uint64_t revision;
  };
  static constexpr std::size_t kMostSpares = 2;

  static std::atomic<std::uint64_t>& seriesSoFar() {
    static std::atomic<std::uint64_t> number{0};
    return number;
  }

  static Buffer shownTo(std::shared_ptr<Map> map) {
    auto is_read = std::make_shared<std::atomic<bool>>(true);
    const auto let_go = [map, is_read](const Map*) {
      is_read->store(false, std::memory_order_release);
    };
    std::shared_ptr<const Map> shown(map.get(), let_go);
    return {std::move(map), std::move(is_read), std::move(shown)};
  }

  // In the newest spare map that nobody reads, else in one of its own.
  std::shared_ptr<Map> copyOfCurrent() {
    for (auto spare = spares_.end(); spare != spares_.begin();) {
      --spare;
      if (spare->buffer.is_read->load(std::memory_order_acquire)) continue;
      const Spare taken = std::move(*spare);
      spares_.erase(spare);
      const std::optional<Change> missed = log_.since(taken.revision);
      if (!missed) break;
      copyCells(*current_.map, *missed, *taken.buffer.map);
      return taken.buffer.map;
    }
    return std::make_shared<Map>(*current_.map);
  }

  Buffer current_;
  std::vector<Spare> spares_;  // the oldest first
  ChangeLog<Change> log_;
};

}  // namespace grid_path_planner::grid
