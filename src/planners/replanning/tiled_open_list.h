// An open list for repairs, where most of what waits will never be asked for: cells by the tile of
// the map that they lie in, and tiles by what the best of their cells may promise.
//
//   TiledOpenList waiting;
//   waiting.prepare(geometry);
//   waiting.begin(first, width);
//   waiting.push(keys, index);
//   while (const TiledOpenList::Entry* next = waiting.first(below, keys)) use(waiting.pop());
//
// Keys grow while a cell waits (rising_keys.h), so what is kept of them are lower bounds. When the
// bound of a tile is reached, it is told anew from the tile's place and its least label; only where
// it is still below what was asked for, its cells are looked at, and those with keys below that
// are put into order. So a border of many thousand cells that a rising bound comes by costs some
// nanoseconds a tile.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planners/core/heap_on_top_queue.h"
#include "planners/replanning/d_star_keys.h"

namespace grid_path_planner::planners {

class TiledOpenList {
 public:
  using Entry = HeapOnTopQueue::Entry;
  using Index = DStarKeys::Index;

  // Takes time in proportion to the map.
  void prepare(const grid::GridGeometry& geometry);
  // Forgets everything, in time proportional to what it was. Keys from about `first` on, of which
  // those within `width` of each other are alike. Precondition: prepare() was called.
  void begin(SearchKey first, SearchKey width);

  std::size_t size() const { return size_; }
  std::size_t bytes() const;

  void push(const DStarKeys& keys, Index index);
  // The cell with the least key, which is below `below`; null where there is none. Every cell comes
  // once, unless it is pushed again.
  const Entry* first(SearchKey below, const DStarKeys& keys);
  // Takes what first() gave.
  Entry pop();

 private:
  struct Tile {
    std::vector<Index> cells;
    SearchKey least_label = kInfiniteKey;
    SearchKey queued = kInfiniteKey;  // its key in tiles_; larger ones there are out of date
  };

  static constexpr int kSideBits = 5;

  std::uint32_t placeOf(grid::Cell cell) const {
    return static_cast<std::uint32_t>(cell.row >> kSideBits) * across_ +
           static_cast<std::uint32_t>(cell.column >> kSideBits);
  }
  grid::CellRect rectOf(std::uint32_t place) const;
  void queue(std::uint32_t place, SearchKey key);
  void sort(const Entry& entry);
  // Takes the cells with keys below `below` out of the tile.
  void open(std::uint32_t place, SearchKey below, const DStarKeys& keys);

  std::uint32_t across_ = 0;
  std::vector<Tile> tile_at_;
  std::vector<std::uint32_t> used_;  // the places of tiles that have memory
  std::size_t reserved_ = 0;         // cells that they have memory for
  HeapOnTopQueue tiles_;
  std::vector<Entry> sorted_;  // a heap
  std::size_t size_ = 0;
};

}  // namespace grid_path_planner::planners
