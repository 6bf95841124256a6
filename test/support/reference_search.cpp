#include "support/reference_search.h"

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <cmath>
#include <utility>

namespace grid_path_planner::test {

using costmap::Connectivity;
using costmap::CostGrid;
using costmap::DiagonalCost;
using costmap::ExactCost;
using grid::Cell;

namespace {

struct Step {
  ExactCost cost;
};
using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Step>;

// Larger than any cost of a test's map.
const ExactCost kUnreached{std::int64_t{1} << 40, 0};

int weightAt(const CostGrid& map, int column, int row) {
  const bool inside =
      column >= 0 && row >= 0 && column < map.geometry().width() && row < map.geometry().height();
  return inside ? map.weights().values()[std::size_t(row) * map.geometry().width() + column] : 0;
}

Graph graphOf(const CostGrid& map) {
  const int width = map.geometry().width();
  std::vector<std::pair<std::size_t, std::size_t>> ends;  // in the order of their first
  std::vector<Step> steps;
  for (int row = 0; row < map.geometry().height(); ++row)
    for (int column = 0; column < width; ++column)
      for (int up = -1; up <= 1; ++up)
        for (int right = -1; right <= 1; ++right) {
          const bool diagonal = up != 0 && right != 0;
          const int from = weightAt(map, column, row);
          const int to = weightAt(map, column + right, row + up);
          if ((up == 0 && right == 0) || from == 0 || to == 0) continue;
          if (diagonal && map.motion().connectivity == Connectivity::FOUR) continue;
          const bool corner =
              weightAt(map, column + right, row) == 0 || weightAt(map, column, row + up) == 0;
          if (diagonal && corner && !map.motion().cut_corners) continue;
          const std::int64_t weight = std::int64_t{std::max(from, to)} * map.kernel();
          const bool root = diagonal && map.motion().diagonal_cost == DiagonalCost::SQRT2;
          ends.emplace_back(std::size_t(row) * width + column,
                            std::size_t(row + up) * width + column + right);
          steps.push_back({root ? ExactCost{0, weight} : ExactCost{weight, 0}});
        }
  return Graph(boost::edges_are_sorted, ends.begin(), ends.end(), steps.begin(),
               map.geometry().size());
}

}  // namespace

std::vector<std::optional<ExactCost>> referenceCosts(const CostGrid& map, Cell start) {
  const Graph graph = graphOf(map);
  std::vector<ExactCost> distances(map.geometry().size());
  boost::dijkstra_shortest_paths(
      graph, map.geometry().index(start).value(),
      boost::distance_map(boost::make_iterator_property_map(distances.begin(),
                                                            boost::get(boost::vertex_index, graph)))
          .weight_map(boost::get(&Step::cost, graph))
          .distance_inf(kUnreached)
          .distance_zero(ExactCost{}));
  std::vector<std::optional<ExactCost>> costs;
  for (const ExactCost& distance : distances)
    costs.push_back(distance == kUnreached ? std::nullopt : std::optional<ExactCost>(distance));
  return costs;
}

}  // namespace grid_path_planner::test
