// The cells of a backward search tree whose g-values cost increases made too low: those whose step is no
// longer consistent, and all whose paths lead over one of these.
//
//   OutdatedCells outdated;
//   outdated.add(nodes, rect);        // costs increased on steps that begin in it
//   outdated.find(nodes, poll);       // throws Stopped, and goes on at the next call
//   for (auto index : outdated.cells()) nodes.remove(index);
//
// add() marks tiles only, so that it costs next to nothing and changes that come again and again, and
// are never looked for, take no more memory. Guaranteed: after find() no path of another cell leads over one
// of them. Some may be listed twice, and some may be right again. Whoever changes a step towards the goal must
// call restart().
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "planners/replanning/backward_nodes.h"

namespace grid_path_planner::planners {

class OutdatedCells {
 public:
  using Index = BackwardNodes::Index;

  void clear();
  // Precondition: `rect` lies in the map.
  void add(const BackwardNodes& nodes, const grid::CellRect& rect);
  // Whether nothing was added since the last find() began, or went on.
  bool noneAdded() const { return added_.empty(); }

  void find(const BackwardNodes& nodes, base::StopPoll& poll);
  const std::vector<Index>& cells() const { return cells_; }
  // find() begins anew, with the same changes.
  void restart();
  // Precondition: find() returned. Its cells were removed.
  void removed();
  std::size_t bytes() const {
    return marked_.capacity() + (added_.capacity() + found_.capacity()) * sizeof(std::uint32_t) +
           cells_.capacity() * sizeof(Index);
  }

 private:
  using Tile = std::uint32_t;

  void mark(Tile tile);
  void addInconsistent(const BackwardNodes& nodes, Tile tile, base::StopPoll& poll);
  void addChildren(const BackwardNodes& nodes, Index index);

  int columns_ = 0;                   // of tiles
  std::vector<std::uint8_t> marked_;  // by tile: whether it is in added_
  std::vector<Tile> added_;
  std::vector<Tile> found_;  // whose cells are in cells_
  std::vector<Index> cells_;
  std::size_t visited_ = 0;  // of cells_
};

}  // namespace grid_path_planner::planners
