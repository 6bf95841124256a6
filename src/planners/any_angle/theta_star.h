// Theta*: A* whose paths leave the grid's directions (Daniel, Nash, Koenig & Felner, "Theta*:
// Any-angle path planning on grids", JAIR 39, 2010), on weighted maps by the cost of segments.
//
// Theta* tries two parents for a cell: the expanded neighbour, and that neighbour's parent by a
// straight segment. Lazy Theta* (Nash, Koenig & Tovey, "Lazy Theta*: Any-angle path planning and
// path length analysis in 3D", AAAI 2010) assumes that the segment is legal and checks its line of
// sight only when the cell is popped, so one segment a cell; a cell whose g-value rises by that
// goes back into the open list. The turning points are the centres of cells, or of the part of a
// cell that lies on the original map.
//
// Where weights differ the straight distance to the goal says little, and Lazy Theta* searches the steps
// backwards first (backward_guide.h). What remains by steps, times a little less than 1, is its estimate,
// and less and less as long as the search stays short; the turning points are then moved to where the path costs less (turning_points.h).
//
// Guaranteed: every segment is legal, the cost is the sum of the segments' (costmap/line_of_sight.h); where
// weights differ Lazy Theta*'s is no more than that of a least-cost path of steps, smoothed.
// Not guaranteed: that it is the least an any-angle path can cost; Theta*'s may be more than that of a grid
// path, though on maps of one weight both mostly lie within a few thousandths of the least.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/zeroed_array.h"
#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/any_angle/backward_guide.h"
#include "planners/core/binary_heap.h"
#include "planners/core/stamped_array.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

// What Theta* and Lazy Theta* share: all but the expansion of a cell.
class ThetaStar : public Planner {
 public:
  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 protected:
  // 14 bytes, unaligned, since searches on large maps wait for memory. Every 2^14 queries all nodes
  // are cleared.
  struct __attribute__((packed)) Node {
    double g;
    std::uint32_t parent;
    std::uint16_t state;  // kClosed and kUnchecked below the query's stamp
  };
  static constexpr std::uint16_t kClosed = 1;
  static constexpr std::uint16_t kUnchecked = 2;  // the line of sight to the parent is assumed

  // `guided`: as Lazy Theta* is where weights differ.
  ThetaStar(const char* name, bool guided);

  // Relaxes the neighbours of a cell whose line of sight to its parent was checked.
  virtual void expand(std::uint32_t from, base::Statistics& counts) = 0;

  // Calls visit(index, cell) for every neighbour that a step leads to.
  template <class Visit>
  void forNeighbours(std::uint32_t index, grid::Cell at, Visit&& visit) const {
    for (unsigned mask = masks_[index]; mask != 0; mask &= mask - 1) {
      const auto step = static_cast<std::size_t>(__builtin_ctz(mask));
      visit(static_cast<std::uint32_t>(index + masks_.offsets()[step]),
            grid::Cell{at.column + kSteps[step].column, at.row + kSteps[step].row});
    }
  }
  // Lowers a cell's g-value, if it is higher, and pushes the cell. `state`: kUnchecked or 0.
  void relax(std::uint32_t index, grid::Cell at, std::uint32_t parent, double g,
             std::uint16_t state, base::Statistics& counts);

  grid::Cell cell(std::uint32_t index) const {
    return map().geometry().cell(grid::CellIndex(index));
  }
  const Node& node(std::uint32_t index) const { return nodes_[index]; }
  bool generated(std::uint32_t index) const { return stamp_.wrote(nodes_[index].state); }
  bool closed(std::uint32_t index) const {
    return generated(index) && (nodes_[index].state & kClosed) != 0;
  }

  // A lower bound of the cost of the straight segment between the waypoints of two cells.
  double costBound(grid::Cell from, grid::Cell to) const;
  // What remains to the goal: where it is guided an estimate, infinite off the guide; else a lower bound.
  double toGoal(grid::Cell cell) const;
  // The cost of that segment, none where it is not legal or costs more than `limit`.
  std::optional<double> segmentCost(grid::Cell from, grid::Cell to, double limit) const;
  double stepCost(grid::Cell from, grid::Cell to) const;

  // Whether the map has one weight, so that a segment's cost is its length.
  bool oneWeight() const { return bits_ != nullptr; }
  bool guided() const { return may_be_guided_ && !oneWeight(); }

  // Sums of the same lengths in another order differ by less, relatively.
  static constexpr double kRounding = 1e-12;

 private:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  struct Entry {
    double f;
    double g;
    std::uint32_t index;
  };
  struct Worse {
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.f != b.f) return a.f > b.f;
      return a.g != b.g ? a.g < b.g : a.index > b.index;
    }
  };

  static std::size_t ownBytes(const grid::GridGeometry& geometry);  // without the guide's

  struct Arrival {
    double g;
    std::uint32_t parent;
  };

  void followMap(const base::StopToken& stop);
  void startQuery(const SearchRequest& request);
  base::Status searchForward(const SearchRequest& request, SearchResult& result,
                             const base::StopToken& stop);
  Arrival bestStep(std::uint32_t index, grid::Cell at) const;
  bool checkParent(std::uint32_t index, base::Statistics& counts);
  SearchResult withStatus(base::Status status, SearchResult result) const;
  std::vector<grid::Cell> cellsFound() const;
  void improve(SearchResult& result, const std::vector<grid::Cell>& steps,
               const base::StopToken& stop) const;

  costmap::SegmentPoint point(grid::Cell cell) const;
  // Whether the waypoint of the cell is its centre.
  bool centred(grid::Cell cell) const {
    return cell.column < centred_.column && cell.row < centred_.row;
  }

  StepMasks masks_;
  base::ZeroedArray<Node> nodes_;
  BinaryHeap<Entry, Worse> open_;
  const bool may_be_guided_;
  double share_ = 0.0;                      // of what the guide says; 0: it is not asked
  BackwardGuide guide_;                     // prepared where it is guided
  QueryStamp<std::uint16_t, 2, 14> stamp_;  // above kClosed and kUnchecked
  grid::Cell goal_;
  grid::Cell centred_;                      // see centred()
  const costmap::BitMaps* bits_ = nullptr;  // of a map of one weight
};

class LazyThetaStar : public ThetaStar {
 public:
  static PlannerTraits declaredTraits();

  LazyThetaStar() : ThetaStar(kName, true) {}

 private:
  void expand(std::uint32_t from, base::Statistics& counts) override;

  static constexpr const char* kName = "lazy_theta_star";
};

}  // namespace grid_path_planner::planners
