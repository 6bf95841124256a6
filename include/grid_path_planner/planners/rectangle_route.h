// A way from cell to cell as a sequence of rectangles: Dijkstra's algorithm, or A* where the weight
// has a lower bound, over the rectangles and their borders.
//
// The published weights of the step from rectangle k to its neighbour j (Park 2013), both numbered
// from 1, largest first:
//   area         j: through the largest rectangles
//   border       1 / length of the shared border: through the widest openings
//   distance     between the centres
//   connections  1 / number of j's connections: through the rectangles with the most neighbours
// On a map that was edited, numbers follow the areas only roughly.
// None of them measures the path that is driven. `length` does: from the middle of a border to the
// middle of the next, the start's and the goal's cells included.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/planners/rectangle_graph.h"
#include "grid_path_planner/planners/search_options.h"

namespace grid_path_planner::planners {

// Weight of a step by one of the published four. Precondition: `weight` is not LENGTH.
double stepWeight(const RectangleGraph& map, RectangleWeight weight, std::uint32_t from,
                  const Connection& step);

// The cells on both sides of the middle of a border: the outward one in `from`, the inward one in
// the neighbour. Of an even number of cells the middle is the lower one.
std::pair<grid::Cell, grid::Cell> middleOf(const grid::CellRect& from, const Connection& step);

struct RectangleRoute {
  bool found = false;
  std::uint32_t first = 0;        // the rectangle that holds the start
  std::vector<Connection> steps;  // from it on
  double weight = 0.0;            // the sum that was least
  std::vector<std::uint32_t>
      expanded;  // rectangles, in order; one may come again by another border
  base::Statistics statistics;
};

// Keeps its arrays from query to query; one at a time.
class RectangleSearch {
 public:
  // Preconditions: `map` holds both cells in rectangles, and its corners are no connections. Throws
  // Stopped.
  RectangleRoute find(const RectangleGraph& map, RectangleWeight weight, grid::Cell start,
                      grid::Cell goal, const base::StopToken& stop);

  std::size_t bytes() const;

 private:
  struct Node {
    double g = 0.0;
    std::uint32_t parent = 0;
    std::uint32_t step = 0;  // number of the connection that led here
    std::uint32_t query = 0;
    bool closed = false;
  };
  struct Entry {
    double f;
    std::uint32_t node;
  };

  RectangleRoute findOverRectangles(const RectangleGraph& map, RectangleWeight weight,
                                    grid::Cell start, grid::Cell goal, const base::StopToken& stop);
  RectangleRoute findOverBorders(const RectangleGraph& map, grid::Cell start, grid::Cell goal,
                                 const base::StopToken& stop);
  void begin(std::size_t nodes);
  void reach(std::uint32_t node, double g, double h, std::uint32_t parent, std::uint32_t step,
             base::Statistics& counts);
  // The next node to expand, or false where there is none.
  bool take(std::uint32_t& node, base::Statistics& counts);

  std::vector<Node> nodes_;
  std::vector<Entry> heap_;
  std::uint32_t query_ = 0;
};

}  // namespace grid_path_planner::planners
