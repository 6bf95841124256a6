// Theta*: A* whose paths leave the grid's directions (Daniel, Nash, Koenig & Felner, "Theta*:
// Any-angle path planning on grids", JAIR 39, 2010), on weighted maps by the cost of segments.
//
// Where a cell is reached, the straight segment from its parent's parent is tried too. Lazy Theta*
// (Nash, Koenig & Tovey, "Lazy Theta*: Any-angle path planning and path length analysis in 3D",
// AAAI 2010) takes that segment on trust and looks at it only when the cell's turn has come, so at
// one segment a cell; what turns out dearer than was thought waits for its turn again. The turning
// points are the middles of cells, or of what the original map has of them.
//
// Guaranteed: every segment is legal, the cost is the sum of the segments' (costmap/line_of_sight.h).
// Not guaranteed: that it is the least an any-angle path can cost, or even as low as that of a grid
// path, though on maps of one weight it mostly lies within a few thousandths of the least.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grid_path_planner/base/zeroed_array.h"
#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planners/steps.h"

namespace grid_path_planner::planners {

// What Theta* and Lazy Theta* share: all but how a cell's neighbours are reached.
class ThetaStar : public Planner {
 public:
  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 protected:
  // What is known of a cell in the query of its number: 14 bytes, unaligned, since large maps wait
  // for memory. Every 2^14 queries the numbers begin anew and all nodes are cleared.
  struct __attribute__((packed)) Node {
    double g;
    std::uint32_t parent;
    std::uint16_t query : 14;
    std::uint16_t closed : 1;
    std::uint16_t trusted : 1;  // g is a guess: nobody has looked along the segment
  };

  explicit ThetaStar(const char* name);

  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const grid::CellRect& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  // Reaches the neighbours of a cell whose way is a true one.
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
  // Opens a cell, where that is cheaper than what is known.
  void reach(std::uint32_t index, grid::Cell at, std::uint32_t parent, double g, bool trusted,
             base::Statistics& counts);

  grid::Cell cell(std::uint32_t index) const {
    return map().geometry().cell(grid::CellIndex(index));
  }
  const Node& node(std::uint32_t index) const { return nodes_[index]; }
  bool known(std::uint32_t index) const { return nodes_[index].query == query_; }
  bool closed(std::uint32_t index) const { return known(index) && nodes_[index].closed != 0; }

  // Of the straight segment between the middles of two cells: the least that it can cost, and what
  // it costs, none where it is not legal or costs more than `limit`.
  double leastCost(grid::Cell from, grid::Cell to) const;
  std::optional<double> straight(grid::Cell from, grid::Cell to, double limit) const;
  double stepTo(grid::Cell from, grid::Cell to) const;

  // Whether the map has one weight, so that sight is all that matters.
  bool oneWeight() const { return bits_ != nullptr; }

  // Sums of the same lengths in another order differ by less, relatively.
  static constexpr double kRounding = 1e-12;

 private:
  static constexpr std::uint16_t kQueries = 1 << 14;
  struct Entry {
    double f;
    double g;
    std::uint32_t index;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.f != b.f) return a.f > b.f;
      return a.g != b.g ? a.g < b.g : a.index > b.index;
    }
  };

  struct Arrival {
    double g;
    std::uint32_t parent;
  };

  void begin(std::uint32_t start);
  Arrival byStep(std::uint32_t index, grid::Cell at) const;
  bool verify(std::uint32_t index, base::Statistics& counts);
  SearchResult withStatus(base::Status status, SearchResult result) const;
  SearchResult found(SearchResult result) const;

  costmap::SegmentPoint point(grid::Cell cell) const;
  // Whether paths pass through its centre.
  bool centred(grid::Cell cell) const {
    return cell.column < centred_.column && cell.row < centred_.row;
  }

  StepMasks masks_;
  base::ZeroedArray<Node> nodes_;
  std::vector<Entry> heap_;
  std::uint16_t query_ = 0;
  grid::Cell goal_;
  grid::Cell centred_;                      // see centred()
  const costmap::BitMaps* bits_ = nullptr;  // of a map of one weight
};

class LazyThetaStar : public ThetaStar {
 public:
  static PlannerTraits declaredTraits();

  LazyThetaStar() : ThetaStar(kName) {}

 protected:
  void expand(std::uint32_t from, base::Statistics& counts) override;

 private:
  static constexpr const char* kName = "lazy_theta_star";
};

}  // namespace grid_path_planner::planners
