#include "grid_path_planner/planners/planner_factory.h"

#include <gtest/gtest.h>

#include "grid_path_planner/base/errors.h"

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

}  // namespace
}  // namespace grid_path_planner::planners
