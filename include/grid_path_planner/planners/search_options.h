// Options of the searches over cells.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::planners {

enum class Heuristic { ZERO, MANHATTAN, CHEBYSHEV, OCTILE, EUCLIDEAN, LANDMARK, EXACT };
const std::vector<std::pair<const char*, Heuristic>>& choicesOf(Heuristic);

enum class TieBreak { NONE, LARGER_G, CROSS_PRODUCT };
const std::vector<std::pair<const char*, TieBreak>>& choicesOf(TieBreak);
std::string adviceFor(TieBreak, const std::string& name);

// What rectangle_map's search adds up (planners/rectangle_route.h).
enum class RectangleWeight { AREA, BORDER, DISTANCE, CONNECTIONS, LENGTH };
const std::vector<std::pair<const char*, RectangleWeight>>& choicesOf(RectangleWeight);

struct SearchOptions {
  Heuristic heuristic = Heuristic::OCTILE;
  std::string heuristic_scale = "cheapest";  // "cheapest", or a number >= 0
  double epsilon = 1.0;                      // >= 1
  TieBreak tie_break = TieBreak::NONE;
  int landmarks = 16;
  int memory_limit = 6000;  // MB
  RectangleWeight rectangle_weight = RectangleWeight::LENGTH;
  bool rectangle_funnel = true;
};

template <class Visitor>
void visitOptions(SearchOptions& o, Visitor&& visit) {
  visit("heuristic", o.heuristic,
        base::OptionInfo{
            "Lower bound of the cost to go that A* uses; manhattan is one only for "
            "connectivity 4, octile and euclidean not for unit diagonals; landmark and exact "
            "(small maps) use tables that are made in the background",
            ""});
  visit(
      "heuristic_scale", o.heuristic_scale,
      base::OptionInfo{"What the heuristic's cell lengths are multiplied by: 'cheapest' (the least "
                       "passable weight) or a number; above the least weight: faster, not optimal",
                       ""});
  visit("epsilon", o.epsilon,
        base::OptionInfo{
            "Weight of the heuristic; above 1: faster, the cost is at most that many times the "
            "least",
            "", 1, 1000});
  visit("tie_break", o.tie_break,
        base::OptionInfo{
            "Which of equally promising cells is expanded first, at the same cost of the "
            "path: none leaves it to the quickest order, the others cost several times as "
            "much a cell",
            ""});
  visit("landmarks", o.landmarks,
        base::OptionInfo{"Cells from which heuristic landmark knows all costs; more: fewer cells "
                         "expanded, 4 bytes a cell of the map and 2 whole-map searches each",
                         "", 1, 64});
  visit("memory_limit", o.memory_limit,
        base::OptionInfo{
            "What a planner may take for itself, the map not counted: it refuses a map that "
            "needs more, before it takes anything",
            "MB", 1, 1000000});
  visit("rectangle_weight", o.rectangle_weight,
        base::OptionInfo{
            "What rectangle_map adds up from rectangle to rectangle; all but length are the "
            "published ones and may lead far around",
            ""});
  visit("rectangle_funnel", o.rectangle_funnel,
        base::OptionInfo{
            "Whether rectangle_map pulls its path taut; false: through the middles of the "
            "borders, as published",
            ""});
}

// The number that heuristic_scale gives; none for "cheapest". Throws InputError for anything else.
std::optional<double> heuristicScale(const SearchOptions& options);

// memory_limit in bytes.
std::size_t memoryLimitOf(const SearchOptions& options);

// Throws InputError naming the option.
void checkSearchOptions(const SearchOptions& options);

}  // namespace grid_path_planner::planners
