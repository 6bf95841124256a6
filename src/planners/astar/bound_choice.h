// Which lower bound a search uses on a map of several weights: that of the blocks
// (planners/tables/block_bound.h), or the octile distance at the least weight.
//
//   BoundChoice choice(kPricesOfAStar);
//   choice.prepare(map);
//   if (choice.blocks()) use(map);
//   else if (choice.undecided()) choice.learn({20000, 0.6, 900});  // of 20,000 expansions it spares 0.6
//
// The bound of the blocks costs its making, and a look at it takes longer. It pays where costs are far
// above the octile distance, but it sees through walls that are thinner than a block, and where these
// part the map it spares nothing. So a sample of rows decides for the blocks where cells weigh a
// multiple of the least weight and few walls are thin. Elsewhere searches begin without them, so that
// a first plan waits for nothing, and what they expanded decides: how many of these cells the bound
// would have left out, against what it costs.
//
// Guaranteed: a decision stays until an eighth of the map has changed, in blocks of 8×8 cells; a place
// that changes again and again counts once. It depends on the map and the searches before, never on a
// clock. Not guaranteed: that it is the faster one for every query.
#pragma once

#include <cstddef>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

// What the bound of the blocks costs a search, in its expansions by the octile distance.
struct BoundPrices {
  double expansion;      // one with the bound
  double node;           // one of the bound's own
  std::size_t enough;    // it is decided after so many of them by
  std::size_t searches;  // so many searches, or after four times as many
};
// Measured on 22 maps (doc/notes/engine_experiments.md).
constexpr BoundPrices kPricesOfAStar{1.4, 0.8, 65536, 1};
constexpr BoundPrices kPricesOfJumps{1.5, 0.3, 4096, 8};

class BoundChoice {
 public:
  explicit BoundChoice(const BoundPrices& prices) : prices_(prices) {}

  // Forgets what it knew.
  void prepare(const costmap::CostGrid& map);
  // `changed`: the cells whose weights changed since.
  void update(const costmap::CostGrid& map, const std::vector<grid::CellRect>& changed);

  bool blocks() const { return blocks_; }
  bool undecided() const { return !decided_; }

  // Of a search by the octile distance.
  struct Evidence {
    std::size_t expanded;
    double spared;      // the share of these that the bound of the blocks would have left out
    std::size_t nodes;  // that the bound expanded up to the start
  };
  // Precondition: undecided().
  void learn(const Evidence& evidence);

 private:
  static constexpr int kChangedBlock = 8;

  void noteChange(const grid::GridGeometry& geometry, const grid::CellRect& rect);

  BoundPrices prices_;
  bool decided_ = false;
  bool blocks_ = false;
  std::vector<bool> changed_;       // of each block of kChangedBlock² cells, since it was prepared
  std::size_t changed_blocks_ = 0;  // the number of these
  std::size_t searches_ = 0;        // that it learnt from,
  std::size_t expanded_ = 0;        // the cells that they expanded,
  double with_blocks_ = 0.0;        // and what they would have taken with the blocks, in expansions
};

}  // namespace grid_path_planner::planners
