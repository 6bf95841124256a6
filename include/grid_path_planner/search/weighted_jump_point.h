// Jump point search over cells of any weight: A* that follows one of the many equally cheap paths
// and runs over the cells where nothing can be decided.
//
// Guaranteed: the cost is the least there is, on every map and motion model. Where straight and
// diagonal steps are 1 and sqrt 2 long and no corners are cut, only natural steps are taken
// (search/canonical_steps.h) and the open list holds only cells at which more than the default
// steps are natural (search/jump_map.h); elsewhere, and where the map leaves nothing to prune, A*
// answers.
//
// A diagonal run looks along its two straight parts at every cell; it and the straight runs queue
// the cells where they stop. Labels of the diagonal runs are kept, and a run that comes to a cell
// that was reached cheaper ends there. Cells that get cheaper, or are reached at the same cost from
// another side that makes further steps natural, are queued again.
//
// Ideas: Harabor & Grastien 2011 and 2014 (word scans), Carlson, Harabor, Stuckey et al. 2023
// (weights); the canonical order, the stops inside gradients and the pricing are this package's.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/base/zeroed_array.h"
#include "grid_path_planner/search/a_star.h"
#include "grid_path_planner/search/jump_map.h"
#include "grid_path_planner/search/planner.h"

namespace grid_path_planner {

class WeightedJumpPoint : public Planner {
 public:
  WeightedJumpPoint();

  std::size_t bytesFor(const GridGeometry& geometry) const override;

 protected:
  void doPrepare(const StopToken& stop) override;
  void doUpdate(const CellRect& changed, const StopToken& stop) override;
  PlanResult doPlan(const PlanRequest& request, const StopToken& stop) override;

 private:
  // The cost of a path as one integer, A * kStraight + B * kDiagonal: 48 bits hold A + B sqrt 2 up
  // to 17.6e6 cell lengths x weight, and B stays below the convergent's denominator, so the order
  // is exact (terrain/exact_cost.h). A query whose path costs more is A*'s.
  using Key = std::uint64_t;
  static constexpr Key kStraight = 15994428;
  static constexpr Key kDiagonal = 22619537;
  static constexpr int kKeyBits = 48;
  static constexpr Key kLargest = (Key{1} << kKeyBits) - 1;

  // Number of the query, then kLargest - g: a larger label is a better one, and any label of this
  // query is better than any of an earlier one.
  using Label = std::uint64_t;

  struct Sides {
    std::uint8_t reached;   // steps that reached the cell at the cost of its label
    std::uint8_t expanded;  // those of them whose natural steps were taken
  };

  struct Entry {
    Key f;
    std::uint32_t index;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const { return a.f > b.f; }
  };

  struct TooDear {};

  void beginQuery(const PlanRequest& request);
  PlanResult search(const PlanRequest& request, const StopToken& stop);
  void expandStart(Cell start);
  void expand(std::uint32_t index);
  void take(unsigned steps, std::uint32_t index, Cell cell, Key g);
  void runStraight(unsigned step, Cell cell, Key g);
  void runDiagonally(unsigned step, std::uint32_t index, Cell cell, Key g);
  void reach(std::uint32_t index, Cell cell, Key g, unsigned step);
  bool improve(std::uint32_t index, Key g);
  void queue(std::uint32_t index, Cell cell, Key g);
  Key costOf(std::uint32_t index) const { return kLargest - (labels_[index] & kLargest); }
  bool labelled(std::uint32_t index) const { return labels_[index] >> kKeyBits == query_; }
  Key estimate(Cell cell) const;
  std::vector<Cell> pathTo(Cell start, Cell goal) const;
  Cell labelledBefore(Cell cell) const;
  PlanResult withStatus(Status status, PlanResult result) const;
  bool leftToAStar() const;
  void prepareAStar(const StopToken& stop);

  JumpMap jumps_;
  ZeroedArray<Label> labels_;
  ZeroedArray<Sides> sides_;
  std::uint64_t query_ = 0;
  std::vector<Entry> heap_;
  std::unique_ptr<AStar> a_star_;  // prepared, where it was needed

  // Of the present query
  Cell goal_;
  std::uint32_t goal_index_ = 0;
  Key goal_cost_ = 0;
  Statistics counts_;
};

}  // namespace grid_path_planner
