#include "grid_path_planner/simulation/vehicle_options.h"

#include <gtest/gtest.h>

#include "support/option_laws.h"

namespace grid_path_planner::simulation {
namespace {

TEST(VehicleOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<VehicleOptions>();
}

}  // namespace
}  // namespace grid_path_planner::simulation
