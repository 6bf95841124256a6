// Options of planner a_star, and of weighted_jump_point where it lets A* answer.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::planners {

enum class Heuristic { ZERO, MANHATTAN, CHEBYSHEV, OCTILE, EUCLIDEAN, BLOCKS, LANDMARK, EXACT };
const std::vector<std::pair<const char*, Heuristic>>& choicesOf(Heuristic);

enum class TieBreak { NONE, LARGER_G, CROSS_PRODUCT };
const std::vector<std::pair<const char*, TieBreak>>& choicesOf(TieBreak);
std::string adviceFor(TieBreak, const std::string& name);

struct AStarOptions {
  Heuristic heuristic = Heuristic::OCTILE;
  std::string heuristic_scale = "cheapest";  // "cheapest", or a number >= 0
  double epsilon = 1.0;                      // >= 1
  TieBreak tie_break = TieBreak::NONE;
  int landmarks = 16;
};

template <class Visitor>
void visitOptions(AStarOptions& o, Visitor&& visit) {
  visit("heuristic", o.heuristic,
        base::OptionInfo{
            "Lower bound of the cost to go that A* uses; manhattan is one only for "
            "connectivity 4, octile and euclidean not for unit diagonals; blocks knows what cells "
            "cost; landmark and exact (small maps) use tables that are made in the background",
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
        base::OptionInfo{
            "Cells from which heuristic landmark knows all costs, and weighted_jump_point at most, "
            "once its searches have cost as much as these tables; more: fewer cells expanded, 4 "
            "bytes a cell of the map and 2 whole-map searches each; 0: weighted_jump_point makes "
            "none",
            "", 0, 64});
}

// The number that heuristic_scale gives; none for "cheapest". Throws InputError for anything else.
std::optional<double> heuristicScale(const AStarOptions& options);

// Throws InputError naming the option.
void checkAStarOptions(const AStarOptions& options);

}  // namespace grid_path_planner::planners
