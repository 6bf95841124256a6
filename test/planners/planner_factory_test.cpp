#include "grid_path_planner/planners/planner_factory.h"

#include <gtest/gtest.h>

#include "grid_path_planner/base/errors.h"
#include "support/error_text.h"

namespace grid_path_planner::planners {
namespace {

TEST(PlannerFactory, EveryRowHasTheTraitsOfThePlannerThatItMakes) {
  for (const std::string& name : plannerNames()) {
    const PlannerTraits row = traitsOf(name);
    const std::unique_ptr<Planner> planner = makePlanner(name);
    const PlannerTraits& made = planner->traits();
    EXPECT_EQ(row.name, name);
    EXPECT_EQ(made.name, name);
    EXPECT_EQ(row.optimal, made.optimal) << name;
    EXPECT_EQ(row.heuristic, made.heuristic) << name;
    EXPECT_EQ(row.any_angle, made.any_angle) << name;
    EXPECT_EQ(row.shortest, made.shortest) << name;
    EXPECT_EQ(row.weights, made.weights) << name;
    EXPECT_EQ(row.repairs, made.repairs) << name;
  }
}

TEST(PlannerFactory, TheTraitsOfAnUnknownPlannerAreAnInputError) {
  EXPECT_THROW(traitsOf("teleport"), base::InputError);
  EXPECT_THROW(traitsOf("theta_star"), base::InputError);
}

TEST(PlannerFactory, RefusesUnknownNamesAndOptions) {
  EXPECT_THROW(makePlanner("a_starr"), base::InputError);
  SearchOptions options;
  options.heuristic_scale = "cheap";
  EXPECT_THROW(makePlanner("a_star", options), base::InputError);
  options.heuristic_scale = "-1";
  EXPECT_THROW(makePlanner("a_star", options), base::InputError);
  options.heuristic_scale = "cheapest";
  options.epsilon = 0.5;
  EXPECT_THROW(makePlanner("a_star", options), base::InputError);
}

TEST(PlannerFactory, SaysWhatToTakeInsteadOfARetiredPlanner) {
  EXPECT_EQ(test::errorText([] { makePlanner("coarse_to_fine"); }),
            "planner 'coarse_to_fine' is retired: take a_star or weighted_jump_point");
  EXPECT_EQ(test::errorText([] { makePlanner("theta_star"); }),
            "planner 'theta_star' is in `grid_path study` only: take lazy_theta_star");
  EXPECT_EQ(test::errorText([] { makePlanner("a_star_published"); }),
            "planner 'a_star_published' is in `grid_path study` only: take a_star");
  EXPECT_EQ(test::errorText(
                [] { base::choiceFromName<TieBreak>("tie_break", "cross_product_published"); }),
            "tie_break 'cross_product_published' is in `grid_path study` only: take cross_product");
}

}  // namespace
}  // namespace grid_path_planner::planners
