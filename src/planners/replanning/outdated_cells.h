// The cells of a backward search tree whose g-values cost increases made too low: those whose step is no
// longer consistent, and all whose paths lead over one of these.
//
//   OutdatedCells outdated;
//   outdated.add(nodes, rect);        // costs increased on steps that begin in it
//   outdated.find(nodes, poll);       // throws Stopped, and goes on at the next call
//   for (auto index : outdated.cells()) nodes.remove(index);
//
// Guaranteed: after find() no path of another cell leads over one of them. Some may be listed twice, and
// some may be right again. Whoever changes a step towards the goal must call restart().
#pragma once

#include <cstddef>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "planners/replanning/backward_nodes.h"

namespace grid_path_planner::planners {

class OutdatedCells {
 public:
  using Index = BackwardNodes::Index;

  void clear();
  void add(const BackwardNodes& nodes, const grid::CellRect& rect);
  // Whether none was added since the last find() began, or went on.
  bool noneAdded() const { return added_.empty(); }

  void find(const BackwardNodes& nodes, base::StopPoll& poll);
  const std::vector<Index>& cells() const { return cells_; }
  // find() begins anew, with the same changes.
  void restart();
  // Precondition: find() returned. Its cells were removed.
  void removed();
  std::size_t bytes() const {
    return (added_.capacity() + first_.capacity() + cells_.capacity()) * sizeof(Index);
  }

 private:
  void addChildren(const BackwardNodes& nodes, Index index);
  void compact(const BackwardNodes& nodes);
  void takeAdded(const BackwardNodes& nodes);

  std::vector<Index> added_;   // inconsistent ones
  std::size_t compacted_ = 0;  // how many of them there were after compact()
  std::vector<Index> first_;   // those that cells_ was begun with
  std::vector<Index> cells_;
  std::size_t visited_ = 0;  // of cells_
};

}  // namespace grid_path_planner::planners
