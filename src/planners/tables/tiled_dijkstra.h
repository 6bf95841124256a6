// Tiled Dijkstra: threads search tiles of a map until no label can decrease. See cost_to_go.h.
#pragma once

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/zeroed_array.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/binary_heap.h"
#include "planners/core/bucket_queue.h"
#include "planners/core/keys.h"
#include "planners/core/move_pruning.h"
#include "planners/core/simd_neighbourhood.h"
#include "planners/tables/tile_sweep.h"

namespace grid_path_planner::planners {

// The layout of a map's cells in memory, tile by tile, so that a tile's rows do not share the same
// lines of a cache. Tiles at the right and upper border reach beyond the map.
struct TileLayout {
  static constexpr std::uint32_t kSide = TileSweep::kSide;
  static constexpr std::uint32_t kCells = kSide * kSide;

  static std::size_t along(int cells) {
    return (static_cast<std::size_t>(cells) + kSide - 1) / kSide;
  }
  static std::size_t tiles(const grid::GridGeometry& geometry) {
    return along(geometry.width()) * along(geometry.height());
  }
  static std::uint32_t insideOf(std::uint32_t column, std::uint32_t row) {
    return row % kSide * kSide + column % kSide;
  }
};

// Label: an unsigned integer whose uppermost bit marks open cells, the others hold largest key -
// key; 0: not reached. Where all cells of the map weigh the same keys are of weight 1.
template <class Label>
class TiledDijkstra {
 public:
  // `labels`: zeros, TileLayout::tiles() x kCells. All arguments outlive the object.
  TiledDijkstra(const costmap::CostGrid& map, base::ZeroedArray<Label>& labels,
                const KeyScale& scale, const base::StopToken& stop);

  // Precondition: the cell lies in the map and is passable.
  void addGoal(grid::Cell goal);

  // Labels every cell from which a path leads to a goal. Throws TooExpensive where a key would
  // reach the largest, Stopped, and what a thread threw.
  void run(int threads);

 private:
  static constexpr std::uint32_t kSide = TileLayout::kSide;
  static constexpr Label kOpen = Label{1} << (sizeof(Label) * 8 - 1);

  // A path to a cell, which has this number in its tile.
  struct Offer {
    SearchKey key;
    std::uint32_t cell;
    std::uint32_t step;  // kGoal: none
  };
  static constexpr std::uint32_t kGoal = 8;
  struct Sent {
    std::size_t tile;
    Offer offer;
  };
  struct Tile {
    bool made = false;               // classes and weights are there
    bool open = false;               // nothing is blocked, and all its cells weigh the same
    bool busy = false;               // a thread searches it
    SearchKey least = kInfiniteKey;  // of the offers
    unsigned bucket_shift = 0;
    std::vector<Offer> offers;
  };
  // The data of a thread.
  struct Worker {
    BucketQueue open;
    TileSweep sweep;
    std::vector<Offer> offers;
    std::vector<Sent> sent;
    bool too_expensive = false;
  };
  // The arrays at a tile's first cell.
  struct View {
    Label* labels;
    std::uint8_t* steps;
    PruningRules::NeighbourhoodClass* classes;
    costmap::CostGrid::Weight* weights;  // null where all weigh the same
  };
  using Turn = std::pair<SearchKey, std::size_t>;

  View viewOf(std::size_t tile);
  grid::CellRect rectOf(std::size_t tile) const;
  void deliver(std::size_t tile, const Offer& offer);
  void workSafely();
  void work();
  void make(std::size_t tile);
  void search(std::size_t tile, Worker& worker);
  bool manyAreCheaper(const View& view, const std::vector<Offer>& offers) const;
  void takeKeys(bool all_new, const View& view, Worker& worker) const;
  void sweep(std::size_t tile, const View& view, Worker& worker);
  void keepSwept(std::size_t tile, const View& view, Worker& worker);
  void expand(std::size_t tile, const View& view, std::uint32_t from, Worker& worker);
  void offerInside(const View& view, std::uint32_t from, std::uint32_t moves, Worker& worker);
  void offerOutside(std::size_t tile, const View& view, std::uint32_t from, std::uint32_t moves,
                    Worker& worker);
  bool isTooExpensive(SearchKey key, Worker& worker) const;
  void relax(const View& view, const Offer& offer, BucketQueue& open) const;
  SearchKey keyOf(Label label) const { return scale_.largest - (label & ~kOpen); }

  const costmap::CostGrid& map_;
  base::ZeroedArray<Label>& labels_;
  const KeyScale scale_;
  const base::StopToken& stop_;
  const PruningRules rules_;
  const std::size_t across_;
  std::array<SearchKey, 8> lengths_{};  // of steps

  // Tile by tile, only the thread that searches a tile accesses it.
  base::ZeroedArray<std::uint8_t> steps_;  // that led to a cell at its cost; 0: all were tried
  base::ZeroedArray<PruningRules::NeighbourhoodClass> classes_;
  base::ZeroedArray<costmap::CostGrid::Weight> weights_;

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::vector<Tile> tiles_;
  BinaryHeap<Turn, std::greater<>> turns_;  // some are out of date
  int working_ = 0;
  bool ended_ = false;
  bool too_expensive_ = false;
  base::StopReason reason_ = base::StopReason::NONE;
  std::exception_ptr failure_;
};

}  // namespace grid_path_planner::planners
