// Search nodes for a search over a small part of a large map: tiles of nodes that exist only where
// the search has been.
//
//   TileNodes nodes;
//   nodes.prepare(geometry);
//   nodes.beginQuery();
//   TileNodes::Node& node = nodes.at(cell);   // new: the largest g-value, no steps
//
// The cell's column and row give its tile. The next query reuses the tiles, and nothing is cleared:
// a node has the stamp of the query that wrote it (stamped_array.h). Keys are of kPackedScale.
// Memory: four bytes for 1024 cells of the map, and 8 KB for each tile of the query that used most.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/grid/grid_geometry.h"
#include "planners/core/keys.h"
#include "planners/core/stamped_array.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

class TileNodes {
 public:
  // 10 bits of stamp, 43 of largest key - key, 2 of note, 8 of steps, 1 of closed.
  class Node {
   public:
    static constexpr SearchKey kUnknown = kPackedScale.largest;

    SearchKey g() const { return kUnknown - (word_ >> kKeyShift & kUnknown); }
    // The steps that led here at this g-value, bit n for step n of steps.h.
    std::uint32_t steps() const { return static_cast<std::uint32_t>(word_ >> kStepShift) & 0xFFU; }
    bool closed() const { return (word_ & kClosed) != 0; }
    // The start: g-value 0, no steps.
    void setStart() { word_ = (word_ & kKept) | kUnknown << kKeyShift; }
    void reach(SearchKey key, unsigned step) {
      word_ = (word_ & kKept) | (kUnknown - key) << kKeyShift | bitOf(step);
    }
    void addStep(unsigned step) { word_ |= bitOf(step); }
    void close() { word_ |= kClosed; }
    void reopen() { word_ &= ~kClosed; }

    // Two bits for the search's own use.
    std::uint32_t note() const { return static_cast<std::uint32_t>(word_ >> kNoteShift) & 3U; }
    void setNote(std::uint32_t note) { word_ |= Word{note} << kNoteShift; }

   private:
    friend class TileNodes;
    using Word = std::uint64_t;
    static constexpr Word kClosed = 1;
    static constexpr unsigned kStepShift = 1;
    static constexpr unsigned kNoteShift = 9;
    static constexpr unsigned kKeyShift = 11;
    static constexpr unsigned kQueryShift = 54;
    // The stamp and the note.
    static constexpr Word kKept = ~Word{0} << kQueryShift | Word{3} << kNoteShift;

    static Word bitOf(unsigned step) { return Word{1} << kStepShift << step; }

    Word word_ = 0;
  };

  // Removes all nodes.
  void prepare(const grid::GridGeometry& geometry);
  void beginQuery();

  // The reference is valid until the next query.
  Node& at(grid::Cell cell) {
    const std::size_t place = tileIndexOf(cell);
    if (tile_at_[place] == 0) addTile(place);
    return ofThisQuery((*tiles_[tile_at_[place] - 1])[numberIn(cell)]);
  }
  // The node of the cell to which `step` leads from `cell`, whose node is `node`; faster than at().
  Node& along(Node& node, grid::Cell cell, std::uint32_t step) {
    if (onBorder(cell)) return at({cell.column + kSteps[step].column, cell.row + kSteps[step].row});
    return ofThisQuery(*(&node + kStepsInTile[step]));
  }

  // Whether the cell is closed in this query.
  bool closed(grid::Cell cell) const {
    const std::uint32_t tile = tile_at_[tileIndexOf(cell)];
    if (tile == 0) return false;
    const Node& node = (*tiles_[tile - 1])[numberIn(cell)];
    return stamp_.wrote(node.word_) && node.closed();
  }

  std::size_t bytes() const {
    return tile_at_.size() * sizeof(std::uint32_t) + tiles_.size() * sizeof(Tile);
  }

 private:
  static constexpr int kSideBits = 5;
  static constexpr int kSide = 1 << kSideBits;
  static constexpr int kMask = kSide - 1;
  // What a step adds to a node's place in its tile.
  static constexpr std::array<std::ptrdiff_t, 8> kStepsInTile = {
      1, kSide, -1, -kSide, kSide + 1, kSide - 1, -kSide - 1, -kSide + 1};
  using Tile = std::array<Node, std::size_t{1} << (2 * kSideBits)>;

  std::size_t tileIndexOf(grid::Cell cell) const {
    return static_cast<std::size_t>(cell.row >> kSideBits) * across_ +
           static_cast<std::size_t>(cell.column >> kSideBits);
  }
  // Whether the cell is at the border of its tile.
  static bool onBorder(grid::Cell cell) {
    const auto column = static_cast<unsigned>(cell.column), row = static_cast<unsigned>(cell.row);
    return (((column + 1) & kMask) < 2) | (((row + 1) & kMask) < 2);
  }
  static std::size_t numberIn(grid::Cell cell) {
    return static_cast<std::size_t>((cell.row & kMask) << kSideBits | (cell.column & kMask));
  }
  Node& ofThisQuery(Node& node) const {
    if (!stamp_.wrote(node.word_)) node.word_ = stamp_.word();
    return node;
  }
  void addTile(std::size_t place);

  std::size_t across_ = 0;
  QueryStamp<Node::Word, Node::kQueryShift> stamp_;
  std::vector<std::uint32_t> tile_at_;  // by index: number of a tile + 1, 0 where there is none
  std::vector<std::unique_ptr<Tile>> tiles_;  // the first ones are used, in the order of used_
  std::vector<std::size_t> used_;             // places
};

}  // namespace grid_path_planner::planners
