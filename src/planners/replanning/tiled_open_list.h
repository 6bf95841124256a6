// A tiled open list: an open list for repairs, in which most cells are never popped. Cells lie
// unsorted in tiles of the map; the tiles are in a heap-on-top queue by lower bounds of their keys.
//
//   TiledOpenList open;
//   open.prepare(geometry);
//   open.reset(first, width);
//   open.push(keys, index);
//   while (const TiledOpenList::Entry* next = open.first(below, keys)) use(open.pop());
//
// Keys grow while a cell is in the list (d_star_keys.h), so a stored key is a lower bound. When the
// bound of a tile is the least, it is computed again from the tile's place and its least g-value.
// Only where it is still below `below` are the tile's cells visited, and those whose keys are below
// `below` go into a heap. So a frontier of many thousand cells costs a few nanoseconds a tile when
// a growing `below` passes it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planners/core/binary_heap.h"
#include "planners/core/heap_on_top_queue.h"
#include "planners/replanning/d_star_keys.h"

namespace grid_path_planner::planners {

class TiledOpenList {
 public:
  using Entry = HeapOnTopQueue::Entry;
  using Index = DStarKeys::Index;

  // Takes time in proportion to the map.
  void prepare(const grid::GridGeometry& geometry);
  // Makes it empty, in time proportional to its size; for keys from about `first` on, in buckets of
  // `width`. Precondition: prepare() was called.
  void reset(SearchKey first, SearchKey width);

  std::size_t size() const { return size_; }
  std::size_t bytes() const;

  void push(const DStarKeys& keys, Index index);
  // The cell with the least key if that is below `below`, else null. Every pushed cell is returned
  // once.
  const Entry* first(SearchKey below, const DStarKeys& keys);
  // Removes the entry that first() returned.
  Entry pop();

 private:
  struct Tile {
    std::vector<Index> cells;
    SearchKey least_g = kInfiniteKey;
    SearchKey queued = kInfiniteKey;  // its key in tiles_; larger ones there are out of date
  };

  static constexpr int kSideBits = 5;

  std::uint32_t tileOf(grid::Cell cell) const {
    return static_cast<std::uint32_t>(cell.row >> kSideBits) * across_ +
           static_cast<std::uint32_t>(cell.column >> kSideBits);
  }
  grid::CellRect rectOf(std::uint32_t tile) const;
  void pushTile(std::uint32_t number, SearchKey key);
  // Moves the tile's cells with keys below `below` into the heap.
  void openTile(std::uint32_t number, SearchKey below, const DStarKeys& keys);

  std::uint32_t across_ = 0;
  std::vector<Tile> tile_at_;
  std::vector<std::uint32_t> used_;  // the tiles that have memory
  std::size_t reserved_ = 0;         // cells that they have memory for
  HeapOnTopQueue tiles_;
  BinaryHeap<Entry, HeapOnTopQueue::Worse> cells_;
  std::size_t size_ = 0;
};

}  // namespace grid_path_planner::planners
