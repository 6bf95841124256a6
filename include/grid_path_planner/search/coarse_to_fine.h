// A path that is nearly the cheapest, for maps on which one search hurts: search over regions
// (region_map.h), then cell by cell in the sectors around what was found, and say how good it is.
//
// The answer carries a lower bound of the cost of any path: the least promise of a cell that the
// corridor left out. Where the cost is more than `accuracy` times the bound, a second search over
// all cells, guided by the octile distance, raises the bound until it is not, or until it has
// expanded eight times as many cells as the first. So the effort stays in proportion to the length
// of the path, not to the area of the map.
//
// Guaranteed: a legal path wherever there is one; lower_bound is at most the least cost. Not
// guaranteed: how near to it the cost is, where the second search was given up.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "grid_path_planner/search/bucket_queue.h"
#include "grid_path_planner/search/heuristic.h"
#include "grid_path_planner/search/planner.h"
#include "grid_path_planner/search/region_map.h"
#include "grid_path_planner/search/search_options.h"
#include "grid_path_planner/search/steps.h"

namespace grid_path_planner {

class CoarseToFine : public Planner {
 public:
  // Throws InputError for options that cannot be used.
  explicit CoarseToFine(const SearchOptions& options = {});

  std::size_t bytesFor(const GridGeometry& geometry) const override;

 protected:
  void doPrepare(const StopToken& stop) override;
  void doUpdate(const CellRect& changed, const StopToken& stop) override;
  PlanResult doPlan(const PlanRequest& request, const StopToken& stop) override;

 private:
  // What is known of a cell.
  struct Node {
    SearchKey cost;
    std::uint8_t step;
    bool closed;
  };
  // The nodes of a sector, made when the search comes there.
  using Nodes = std::array<Node, RegionMap::kSide * RegionMap::kSide>;
  static constexpr std::uint32_t kNoNodes = 0xffffffffU;

  // What a search over cells is to do.
  struct Task {
    bool in_corridor;             // else everywhere
    SearchKey known;              // a cost that is known already: only cheaper paths are wanted
    SearchKey enough;             // ends where no open cell promises less
    std::uint64_t most_expanded;  // ends there, too
  };
  // And what it found.
  struct Outcome {
    SearchKey cost = kInfiniteKey;   // of the goal, where it was reached
    SearchKey bound = kInfiniteKey;  // no path costs less than this and `cost`
  };

  std::vector<RegionMap::Id> wayOverRegions(Cell start, Cell goal, PlanResult& result,
                                            bool record_expanded, const StopToken& stop) const;
  void markCorridor(const std::vector<RegionMap::Id>& way);
  Outcome search(const PlanRequest& request, const Task& task, const Estimate& estimate,
                 PlanResult& result, const StopToken& stop);
  Node& node(Cell cell);
  void forgetNodes();
  std::vector<Cell> pathTo(Cell start, Cell goal);
  void describe(PlanResult& result, SearchKey bound) const;

  SearchOptions options_;
  StepMasks masks_;
  RegionMap regions_;
  std::vector<std::uint8_t> corridor_;  // by sector
  std::vector<std::uint32_t> marked_;
  std::vector<std::uint32_t> places_;  // by sector: where its nodes are in nodes_
  std::vector<std::uint32_t> visited_;
  std::vector<std::unique_ptr<Nodes>> nodes_;
  BucketQueue open_;
};

}  // namespace grid_path_planner
