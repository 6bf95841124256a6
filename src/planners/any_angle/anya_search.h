// The search of Anya: A* over intervals of the row lines of one bit map.
//
// Row line y lies between the rows of cells y - 1 and y. An interval node is the part of a row line
// that is visible from its root between two rays. It is projected from line to line and split by
// blocked cells: its observable successors. A corner that an end of the interval touches, and at
// which a taut path can turn, becomes a root of its own (non-observable successors): with the
// interval on the far side of the ray and, where the obstacle lies behind the line, with a flat
// node, which is the next corner along the line.
//
// Positions are doubles, in cells. The end of an interval is computed from its root and the corner
// that its ray passes, never from another computed number, so it errs by less than 2^-33 cells on
// maps up to 2^16 cells wide, while a position that is not whole differs from whole numbers by at
// least 2^-29. With those nearer than 2^-31 rounded to whole ones every decision is exact.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/bit_maps.h"
#include "planners/any_angle/corner_table.h"
#include "planners/any_angle/interval_search.h"

namespace grid_path_planner::planners {

// In cells.
struct AnyaPoint {
  double x = 0.0;
  double y = 0.0;

  friend AnyaPoint operator-(AnyaPoint a, AnyaPoint b) { return {a.x - b.x, a.y - b.y}; }
};

inline double cross(AnyaPoint a, AnyaPoint b) {
  return a.x * b.y - a.y * b.x;
}

// An interval node on row line `line`; or a flat node: the corner on the line in column `ray[0]`.
struct AnyaNode {
  double ray[2];  // by AnyaSearch::Side: columns that the ray passes a line
  std::int32_t root;
  std::int32_t line;
  std::int8_t rows;     // the direction of projection: 1 or -1; 0 for a flat node
  std::int8_t columns;  // of a flat node the direction along the line: 1 or -1
};

class AnyaSearch : private IntervalSearch<AnyaPoint, AnyaNode> {
 public:
  using Answer = IntervalSearch::Answer;

  // Both ends lie in the interiors of cells that are 1. `expanded` gets a cell for every expansion
  // if it is not null.
  Answer run(const costmap::BitMap& rows, AnyaPoint start, AnyaPoint goal,
             const base::StopToken& stop, base::Statistics& counts,
             std::vector<grid::Cell>* expanded);

  // Of the last run: its open list at its longest, its roots and their table.
  std::size_t bytes() const { return IntervalSearch::bytes() + corners_.bytes(); }

 private:
  enum Side { LEFT, RIGHT };
  using Word = costmap::BitMap::Word;

  // The part of an interval that leads into one run of free cells of the next row.
  struct Projection {
    double near[2];  // by Side: its ends on the interval's line
    double ray[2];
    double far[2];  // where the rays meet the next line, not clipped to the run
    int run[2];     // the run's ends: first cell, last + 1
  };

  void pushStartIntervals(AnyaPoint start);
  grid::Cell cellOf(const AnyaNode& node) const;
  void expand(const AnyaNode& node);
  void expandInterval(AnyaNode node);
  void expandFlat(const AnyaNode& node);
  int observableSuccessors(const AnyaNode& node, const double* near, const double* far,
                           AnyaNode& last);
  void projectThroughFreeRows(AnyaNode& node, double* near, double* far) const;
  Projection project(const AnyaNode& node, const double* near, const double* far, int first,
                     int last) const;
  void updateIncumbentIfVisible(const AnyaNode& node, const Projection& projection);
  void turningSuccessors(const AnyaNode& node, const Projection& projection, Side side);
  void flatSuccessors(std::int32_t root, int column, int line, int columns);
  void pushInterval(std::int32_t root, int line, int rows, double left, double right);
  void pushBelowIncumbent(double f, const AnyaNode& node);
  std::int32_t rootAt(std::int32_t parent, int column, int line, Sense sense);
  double fValue(const AnyaNode& node) const;
  double columnOf(AnyaPoint root, double ray, double lines) const;
  const Word* rowAhead(int line, int rows) const { return map_->row(rows > 0 ? line : line - 1); }
  bool leadsToGoal(int line, int rows) const { return (rows > 0 ? line : line - 1) == goal_row_; }

  const costmap::BitMap* map_ = nullptr;
  int goal_row_ = 0;
  CornerTable corners_;
};

}  // namespace grid_path_planner::planners
