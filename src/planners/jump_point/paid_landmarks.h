// Tables of landmarks that searches have paid for: they are made once the searches of a map have expanded as
// many cells as making them does, so that tables of no use double the work at most, as it is counted here.
//
//   PaidLandmarks landmarks(16);
//   landmarks.pay(result.statistics.expanded);          // after each search
//   landmarks.make(shared_map, room, stop);             // in idle time
//   landmarks.update(*before, shared_map, changed);     // follow every change of the map
//   std::optional<LandmarkBound> bound = landmarks.boundTo(goal_index, kMediumScale);
//
// They are made in a thread of their own. Changes of the map leave them valid (precomputed_table.h); where so
// much has changed that they say little they go, and searches pay again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/tables/landmark_table.h"
#include "planners/tables/precomputed_table.h"

namespace grid_path_planner::planners {

class PaidLandmarks {
 public:
  // No more than `most` of them; 0: never any.
  explicit PaidLandmarks(int most) : most_(most) {}

  // Frees all memory and forgets what was paid.
  void release();
  // That is held, or taken while they are made.
  std::size_t bytes() const;

  // A search has taken as long as expanding so many cells takes A*.
  void pay(std::size_t cells) { paid_ += cells; }

  // Whether they are paid for, fit into so many bytes, and are not there.
  bool wanted(const costmap::CostGrid& map, std::size_t room);
  // Begins if they are wanted, and waits for those that were begun. Throws Stopped; the thread goes on.
  void make(std::shared_ptr<const costmap::CostGrid> map, std::size_t room,
            const base::StopToken& stop);

  // As PrecomputedTable::update().
  void update(const costmap::CostGrid& before, std::shared_ptr<const costmap::CostGrid> map,
              const std::vector<grid::CellRect>& changed);

  // The bound to that cell, where there are tables that can be used. Until the next call of another method.
  std::optional<LandmarkBound> boundTo(std::uint32_t goal, const KeyScale& scale);

 private:
  bool paidFor(const costmap::CostGrid& map, int count);
  int affordable(const grid::GridGeometry& geometry, std::size_t room) const;

  int most_;
  std::size_t paid_ = 0;      // expansions since there are none
  std::size_t passable_ = 0;  // cells, once they are counted
  grid::GridGeometry geometry_;
  int count_ = 0;  // of landmarks, as asked for
  std::unique_ptr<PrecomputedTable<LandmarkTable>> tables_;
};

}  // namespace grid_path_planner::planners
