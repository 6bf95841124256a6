// The shortest path in the centre lattice of a map: Anya's intervals (anya_search.h), half a cell
// shifted, and the points that only a single path passes.
//
// An interval node is the part of a line through a row of centres that is visible from its root
// between two rays. It is projected through the squares of the next row; corners become roots as in
// Anya. A portal (LatticeBits) that an interval or a line along a wall contains becomes a point node:
// a root from which everything is visible anew, and from which thin edges lead to other points. The
// goal is such a point too.
//
// Guaranteed: no path in the lattice is shorter, up to rounding (1e-12 of the length). Every
// decision on what is visible is one of integers, in 1/4096 cell.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/grid/cell.h"
#include "planners/any_angle/corner_table.h"
#include "planners/any_angle/interval_search.h"
#include "planners/any_angle/lattice_bits.h"

namespace grid_path_planner::planners {

// In 1/4096 cell.
struct LatticePoint {
  std::int64_t x = 0;
  std::int64_t y = 0;

  friend LatticePoint operator-(LatticePoint a, LatticePoint b) { return {a.x - b.x, a.y - b.y}; }
};

inline std::int64_t cross(LatticePoint a, LatticePoint b) {
  return a.x * b.y - a.y * b.x;
}

// A direction from a root; y is counted in the heading of the node.
struct LatticeRay {
  std::int64_t x;
  std::int64_t y;
};

// An interval node on the line through the centres of row `line`; or a point node: its root's point.
struct LatticeNode {
  LatticeRay ray[2];  // by LatticeSearch::Side
  std::int32_t root;
  std::int32_t line;
  std::int32_t column;  // of a point
  std::int8_t heading;  // rows: 1 or -1; 0 for a point
};

class LatticeSearch : private IntervalSearch<LatticePoint, LatticeNode> {
 public:
  using Answer = IntervalSearch::Answer;

  // The coordinates of the map's waypoints. Precondition: the map keeps its geometry as long as this
  // is used.
  explicit LatticeSearch(const costmap::CostGrid& map);

  // `expanded` gets a cell for every expansion if it is not null. Precondition: both cells are
  // passable and differ; `passable` and `bits` are of the map.
  Answer run(const costmap::BitMap& passable, const LatticeBits& bits, grid::Cell start,
             grid::Cell goal, const base::StopToken& stop, base::Statistics& counts,
             std::vector<grid::Cell>* expanded);

  // Of the last run: its open list at its longest, its roots and their tables.
  std::size_t bytes() const {
    return IntervalSearch::bytes() + corners_.bytes() + points_.bytes() +
           (xs_.size() + ys_.size()) * sizeof(std::int64_t);
  }

 private:
  enum Side { LEFT, RIGHT };
  using Word = costmap::BitMap::Word;

  // A run of squares of the next row that an interval touches, in columns of points.
  struct Run {
    int first;
    int last;
    int corner[2];      // by Side: the point at which the interval ends in the run, or kNone
    LatticeRay ray[2];  // by Side: of that end
  };
  static constexpr int kNone = -1;

  LatticePoint at(int column, int line) const { return {xs_[column], ys_[line]}; }
  const Word* rowAhead(int line, int heading) const {
    return bits_->squares.row(heading > 0 ? line : line - 1);
  }
  std::int64_t height(const LatticeNode& node, int line) const {
    return node.heading * (ys_[line] - roots_[node.root].at.y);
  }

  void expand(const LatticeNode& node);
  void expandPoint(const LatticeNode& node);
  void expandInterval(LatticeNode node);
  int successors(const LatticeNode& node, LatticeNode& last);
  Run runAt(const LatticeNode& node, int column, int first, int last) const;
  bool beyond(const LatticeNode& node, const Run& run, LatticeNode& successor) const;
  int firstColumn(const LatticeNode& node) const;
  int lastColumn(const LatticeNode& node) const;
  void turn(const LatticeNode& node, const Run& run, Side side);
  void turnOnLine(std::int32_t root, int column, int line, int columns, int heading);
  void followLine(std::int32_t root, int column, int line, int columns);
  void followThinEdges(std::int32_t root, int column, int line);
  void pushAround(std::int32_t root, int column, int line, int heading);
  void reach(std::int32_t root, int column, int line);
  void reachBetween(std::int32_t root, int line, int first, int last);
  void reachPoint(std::int32_t parent, int column, int line);
  void pushInterval(const LatticeNode& node);
  std::int32_t rootAt(std::int32_t parent, int column, int line, Sense sense);
  double fValue(const LatticeNode& node) const;

  std::vector<std::int64_t> xs_;  // of the columns' waypoints
  std::vector<std::int64_t> ys_;  // of the rows'
  const costmap::BitMap* passable_ = nullptr;
  const LatticeBits* bits_ = nullptr;
  grid::Cell goal_cell_;
  CornerTable corners_;
  CornerTable points_;
};

}  // namespace grid_path_planner::planners
