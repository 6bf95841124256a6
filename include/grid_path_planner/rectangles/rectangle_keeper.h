// The rectangles of a map, kept right while the map changes.
//
//   RectangleKeeper keeper;
//   keeper.prepare(map, stop);                    // largestFirst
//   keeper.update(changed_map, changed, stop);    // RectangleGraph::edit
//   search(keeper.rectangles());
//
// Edits redo what they touch, so their rectangles get away from those of a decomposition. How many
// these would be is not known without making it. So a rule of counters: when the edits have put in
// kRedoAfter times as many rectangles as the last decomposition had, the map is decomposed anew in
// a thread of its own. It takes the old one's place a number of updates later that depends on the
// map's size alone, or when the work is waited for: the same calls give the same rectangles,
// however long the thread takes, and an update waits for it only where updates come faster than a
// decomposition takes. The edits that came meanwhile are repeated on it, from the map as it is
// then.
//
// The rule keeps the count where it was measured, not below a bound that could be proved: see
// benchmark/rectangle_repair.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "grid_path_planner/base/background.h"
#include "grid_path_planner/rectangles/rectangle_graph.h"
#include "grid_path_planner/search/planner.h"
#include "grid_path_planner/terrain/cost_grid.h"

namespace grid_path_planner {

class RectangleKeeper {
 public:
  static constexpr std::size_t kRedoAfter = 8;
  // Counted as if a decomposition had at least so many.
  static constexpr std::size_t kLeastRectangles = 1000;

  // Drops what there is and decomposes, in no more memory than `memory`. Throws Stopped, and
  // DecompositionTooLarge before it takes more.
  void prepare(std::shared_ptr<const CostGrid> map, const StopToken& stop,
               std::size_t memory = std::numeric_limits<std::size_t>::max());
  // `map` differs from the one before only inside `changed`. What is decomposed anew must find room
  // beside the rectangles there are. Throws Stopped, and is to be prepared then.
  void update(std::shared_ptr<const CostGrid> map, const CellRect& changed, const StopToken& stop,
              std::size_t memory = std::numeric_limits<std::size_t>::max());

  const RectangleGraph& rectangles() const { return rectangles_; }

  BackgroundWork work() const;
  // Returns when nothing is made any more and what was made is in use. Throws Stopped.
  void finish(const StopToken& stop);

 private:
  struct Made {
    std::unique_ptr<RectangleGraph> rectangles;
    double time_s = 0.0;
  };

  void edit(const CellRect& changed, const StopToken& stop);
  void begin(std::size_t memory);
  void takeOver(const StopToken& stop);

  std::shared_ptr<const CostGrid> map_;
  RectangleGraph rectangles_;
  std::size_t decomposed_ = 0;  // rectangles that the last decomposition had
  std::size_t edited_ = 0;      // rectangles that edits have put in since
  double time_s_ = 0.0;         // that the last one in the background took
  bool begun_ = false;
  std::vector<CellRect> since_begin_;  // where the map has changed
  Background<Made> making_;
};

}  // namespace grid_path_planner
