// What a search over a small part of a large map knows of cells: a best-first search's node a cell,
// in tiles that are there only where the search has been.
//
//   TileNodes nodes;
//   nodes.prepare(geometry);
//   nodes.beginQuery();
//   TileNodes::Node& node = nodes.at(cell);   // unknown at first: g infinite, no steps
//
// A tile is found by the cell's column and row without a search. What a query used is used again by
// the next one, and nothing is cleared: a node carries the number of the query that wrote it.
// Memory: four bytes for 1024 cells of the map, and 16 KB for each tile of the query that used
// most.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/grid/grid_geometry.h"
#include "grid_path_planner/search/search_key.h"

namespace grid_path_planner {

class TileNodes {
 public:
  class Node {
   public:
    SearchKey g = kInfiniteKey;

    // The steps that led here at this g, bit n for step n of steps.h; closed: expanded since.
    std::uint32_t steps() const { return word_ >> kStepShift & 0xFFU; }
    bool closed() const { return (word_ & kClosed) != 0; }
    void reach(SearchKey key, unsigned step) {
      g = key;
      word_ = (word_ & ~(kSteps | kClosed)) | 1U << kStepShift << step;
    }
    void addStep(unsigned step) { word_ |= 1U << kStepShift << step; }
    void close() { word_ |= kClosed; }
    void reopen() { word_ &= ~kClosed; }

    // Two bits for the search's own use.
    std::uint32_t note() const { return word_ >> kNoteShift & 3U; }
    void setNote(std::uint32_t note) { word_ |= note << kNoteShift; }

   private:
    friend class TileNodes;
    static constexpr std::uint32_t kClosed = 1;
    static constexpr unsigned kStepShift = 1;
    static constexpr std::uint32_t kSteps = 0xFFU << kStepShift;
    static constexpr unsigned kNoteShift = 9;
    static constexpr unsigned kQueryShift = 11;

    std::uint32_t word_ = 0;
  };

  // Forgets everything.
  void prepare(const GridGeometry& geometry);
  void beginQuery();

  // The reference stays good until the next query.
  Node& at(Cell cell) {
    const std::size_t place = placeOf(cell);
    if (tile_at_[place] == 0) use(place);
    Node& node = (*tiles_[tile_at_[place] - 1])[numberIn(cell)];
    if (node.word_ >> Node::kQueryShift != query_) {
      node.g = kInfiniteKey;
      node.word_ = query_ << Node::kQueryShift;
    }
    return node;
  }

  // Whether the cell was expanded in this query.
  bool closed(Cell cell) const {
    const std::uint32_t tile = tile_at_[placeOf(cell)];
    if (tile == 0) return false;
    const Node& node = (*tiles_[tile - 1])[numberIn(cell)];
    return node.word_ >> Node::kQueryShift == query_ && node.closed();
  }

  std::size_t bytes() const {
    return tile_at_.size() * sizeof(std::uint32_t) + tiles_.size() * sizeof(Tile);
  }

 private:
  static constexpr int kSideBits = 5;
  static constexpr int kSide = 1 << kSideBits;
  static constexpr int kMask = kSide - 1;
  using Tile = std::array<Node, std::size_t{1} << (2 * kSideBits)>;

  std::size_t placeOf(Cell cell) const {
    return static_cast<std::size_t>(cell.row >> kSideBits) * across_ +
           static_cast<std::size_t>(cell.column >> kSideBits);
  }
  static std::size_t numberIn(Cell cell) {
    return static_cast<std::size_t>((cell.row & kMask) << kSideBits | (cell.column & kMask));
  }
  void use(std::size_t place);

  std::size_t across_ = 0;
  std::uint32_t query_ = 0;
  std::vector<std::uint32_t> tile_at_;  // by place: number of a tile + 1, 0 where there is none
  std::vector<std::unique_ptr<Tile>> tiles_;  // the first ones are used, in the order of used_
  std::vector<std::size_t> used_;             // places
};

}  // namespace grid_path_planner
