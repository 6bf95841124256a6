// The search of Anya: from a root through intervals of row lines, over one bit map.
//
// Row line y lies between the rows of cells y - 1 and y. A cone is all that one root sees of a row
// line between two rays. It is moved on row by row and split by what is blocked. Every corner that
// one of its ends touches and round which a taut way can turn becomes a root of its own, with a
// cone on the far side of the ray and, where the obstacle lies behind the line, with the corners
// that follow along the line.
//
// Positions are doubles, in cells. The end of a cone on a line is computed from its root and the
// corner that its ray passes, never from another such number, so it errs by less than 2^-33 cells
// on maps up to 2^16 cells wide, while a position that is not whole differs from whole numbers by
// at least 2^-29. With those nearer than 2^-31 rounded to whole ones every decision is exact.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/bit_maps.h"
#include "planners/any_angle/corner_table.h"
#include "planners/core/node_heap.h"

namespace grid_path_planner::planners {

class AnyaSearch {
 public:
  struct Point {
    double x;
    double y;
  };
  struct Answer {
    base::Status status = base::Status::UNREACHABLE;
    std::vector<Point> points;  // where FOUND: start, turning points, goal
    double length = 0.0;        // cells
  };

  // Both ends lie in the interiors of cells that are 1. `expanded` gets a cell for every expansion
  // if it is not null.
  Answer run(const costmap::BitMap& rows, Point start, Point goal, const base::StopToken& stop,
             base::Statistics& counts, std::vector<grid::Cell>* expanded);

  // Of the last run: its open list at its longest, its roots and their table.
  std::size_t bytes() const;

 private:
  enum Side { LEFT, RIGHT };
  using Word = costmap::BitMap::Word;
  enum Sense { ANTICLOCKWISE, CLOCKWISE };

  struct Root {
    Point at;
    double g;
    std::int32_t parent;
    std::int32_t widest[2];  // by Sense: the parent of the widest arrival so far at this g
    bool beaten;             // a shorter way to this corner has a root of its own
  };
  // A cone on row line `line`; or the next corner on the line, in column `ray[0]`.
  struct Node {
    double ray[2];  // by Side: columns that the ray passes a line
    std::int32_t root;
    std::int32_t line;
    std::int8_t rows;     // the cone's way: 1 or -1; 0: along the line
    std::int8_t columns;  // the way along the line: 1 or -1
  };
  // What of a cone leads into one run of open cells of the next row.
  struct Projection {
    double near[2];  // by Side: its ends on the cone's line
    double ray[2];
    double far[2];  // where the rays meet the next line, not clipped to the run
    int run[2];     // the run's ends: first cell, last + 1
  };

  void expandCone(Node node);
  void projectThroughOpenRows(Node& cone, double* near, double* far) const;
  void expandCorner(const Node& node);
  Projection project(const Node& cone, const double* near, const double* far, int first,
                     int last) const;
  void reachGoal(const Node& cone, const Projection& gate);
  void turningSuccessors(const Node& cone, const Projection& gate, Side side);
  void flatSuccessors(std::int32_t root, int column, int line, int columns);
  void pushInterval(std::int32_t root, int line, int rows, double left, double right);
  void push(double f, const Node& node);
  void updateIncumbent(std::int32_t root);
  std::int32_t relax(std::int32_t parent, int column, int line, Sense sense);
  double fValue(const Node& cone) const;
  double distance(const Point& a, double x, double y) const;
  double reach(const Point& root, double ray, double lines) const;
  const Word* ahead(int line, int rows) const { return map_->row(rows > 0 ? line : line - 1); }
  bool leadsToGoal(int line, int rows) const { return (rows > 0 ? line : line - 1) == goal_row_; }

  const costmap::BitMap* map_ = nullptr;
  Point goal_{};
  int goal_row_ = 0;
  double incumbent_ =
      std::numeric_limits<double>::infinity();  // the shortest way to the goal so far
  std::int32_t incumbent_root_ = -1;
  std::vector<Root> roots_;
  NodeHeap<Node> open_;
  CornerTable corners_;
  base::Statistics* counts_ = nullptr;
};

}  // namespace grid_path_planner::planners
