// What planners that claim the shortest any-angle path are tried on, and the law that they must
// hold.
#pragma once

#include <memory>
#include <random>

#include "grid_path_planner/search/planner.h"

namespace grid_path_planner::test {

// One weight, whatever it is; rectangles or single cells blocked.
std::shared_ptr<const CostGrid> randomUniform(std::mt19937& random, int largest_side);

// Prepares the planner and expects a legal path of the length that the visibility graph finds, and
// none where there is none. `found` counts the former. Precondition: both cells are passable.
void expectShortest(Planner& planner, const std::shared_ptr<const CostGrid>& map, Cell start,
                    Cell goal, int& found);

}  // namespace grid_path_planner::test
