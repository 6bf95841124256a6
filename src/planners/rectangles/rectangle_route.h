// The sequence of rectangles from cell to cell with the least sum of weights: Dijkstra's algorithm,
// or A* where the weight has a lower bound, over the rectangles and their borders.
//
// The published weights of the step from rectangle k to its neighbour j (Park 2013), both numbered
// from 1, largest first:
//   area         j: through the largest rectangles
//   border       1 / length of the shared border: through the widest openings
//   distance     between the centres
//   connections  1 / number of j's connections: through the rectangles with the most neighbours
// On a map that was edited, numbers follow the areas only roughly.
// None of them is the length of a path. `length` is: from the middle of a border to the middle of
// the next, the start's and the goal's cells included.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/planners/rectangle_graph.h"
#include "grid_path_planner/planners/rectangle_map_options.h"
#include "planners/core/binary_heap.h"
#include "planners/core/stamped_array.h"

namespace grid_path_planner::planners {

// Weight of a step by one of the published four. Precondition: `weight` is not LENGTH.
double stepWeight(const RectangleGraph& map, RectangleWeight weight, std::uint32_t from,
                  const Connection& step);

// The middle of a border on both its sides, at the centres of cells or, where the border has an even
// number of cells, between two, as published. In cells from the corner of the map.
struct BorderMiddle {
  Eigen::Vector2d outward;  // in the rectangle that is left
  Eigen::Vector2d inward;   // in the neighbour
};

BorderMiddle middleOf(const grid::CellRect& from, const Connection& step);

struct RectangleRoute {
  bool found = false;
  std::uint32_t first = 0;        // the rectangle that holds the start
  std::vector<Connection> steps;  // from it on
  double weight = 0.0;            // the least sum
  // Rectangles, in order; one may be expanded again by another border.
  std::vector<std::uint32_t> expanded;
  base::Statistics statistics;
};

// Its arrays are reused by the next query. Not for several threads at a time.
class RectangleSearch {
 public:
  // Preconditions: `map` has a rectangle for both cells, and was made with Touching::BORDERS. Throws
  // Stopped.
  RectangleRoute find(const RectangleGraph& map, RectangleWeight weight, grid::Cell start,
                      grid::Cell goal, const base::StopToken& stop);

  std::size_t bytes() const;

 private:
  struct Node {
    double g = 0.0;
    std::uint32_t parent = 0;
    std::uint32_t step = 0;   // number of the connection from the parent
    std::uint32_t state = 0;  // kClosed below the query's stamp
  };
  static constexpr std::uint32_t kClosed = 1;
  struct Entry {
    double f;
    std::uint32_t node;
  };
  struct Worse {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.f != b.f ? a.f > b.f : a.node > b.node;
    }
  };

  RectangleRoute findOverRectangles(const RectangleGraph& map, RectangleWeight weight,
                                    grid::Cell start, grid::Cell goal, const base::StopToken& stop);
  RectangleRoute findOverBorders(const RectangleGraph& map, grid::Cell start, grid::Cell goal,
                                 const base::StopToken& stop);
  void startQuery(std::size_t nodes);
  void relax(std::uint32_t node, double g, double h, std::uint32_t parent, std::uint32_t step,
             base::Statistics& counts);
  // Closes the open node with the least f-value; false where there is none.
  bool popNode(std::uint32_t& node, base::Statistics& counts);

  std::vector<Node> nodes_;
  BinaryHeap<Entry, Worse> open_;
  QueryStamp<std::uint32_t, 1> stamp_;  // above kClosed
};

}  // namespace grid_path_planner::planners
