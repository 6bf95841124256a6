// The planners of a study: those of the package, and published ones for comparison.
//
//   std::unique_ptr<Planner> planner = makeStudyPlanner("a_star_published", options, false);
//
// `theta_star` is Theta* as first published, superseded by lazy_theta_star; `dijkstra_published` and
// the three `a_star_published…` are the original study's programs (programs/), and tie-break
// `cross_product_published` is what those A* can have instead of a heuristic. None of these is for
// driving, so path_planner and `grid_path plan` have none.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/planners/planner_factory.h"

namespace grid_path_planner::study {

// TieBreak, and the published one.
enum class StudyTieBreak { NONE, LARGER_G, CROSS_PRODUCT, CROSS_PRODUCT_PUBLISHED };
const std::vector<std::pair<const char*, StudyTieBreak>>& choicesOf(StudyTieBreak);

// The tie-break for planners without the published one: as strict an order.
planners::TieBreak orderOf(StudyTieBreak tie_break);

// Whether it is one of the original's A*, whose heuristic tie-break cross_product_published replaces.
bool isPublishedAStar(const std::string& planner);

// Throws InputError for options that cannot be used, for `published_cross` unless it is a published
// A*, and as makePlanner() does for unknown names.
std::unique_ptr<planners::Planner> makeStudyPlanner(const std::string& name,
                                                    const planners::SearchOptions& options,
                                                    bool published_cross);

// Whether the heuristic of the options guides it. Throws InputError for unknown names.
bool guidedInStudies(const std::string& planner);

// Whether it is not among the package's planners.
bool inStudiesOnly(const std::string& planner);

}  // namespace grid_path_planner::study
