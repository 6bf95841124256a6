#include "grid_path_planner/planners/map_planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "grid_path_planner/base/errors.h"
#include "support/ascii_map.h"

namespace grid_path_planner {
namespace {

using test::AsciiMap;

PlanReport planOn(const AsciiMap& picture, const PlannerOptions& options = {}) {
  MapPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(picture.map));
  PoseRequest request;
  request.start.position << picture.map.geometry().centre(picture.start), 0.0;
  request.goal.position << picture.map.geometry().centre(picture.goal), 0.0;
  return planner.plan(request);
}

TEST(MapPlanner, GoesAroundAnObstacle) {
  const PlanReport report = planOn(AsciiMap({"S#.",  //
                                             ".#.",  //
                                             "..G"}));
  EXPECT_EQ(report.status, Status::FOUND) << report.message;
  EXPECT_EQ(report.cost, (ExactCost{4, 0})) << report.message;
  EXPECT_EQ(report.path.poses.size(), 5U);
}

TEST(MapPlanner, SaysWhyThereIsNoPath) {
  const PlanReport report = planOn(AsciiMap({"S#G",  //
                                             ".#."}));
  EXPECT_EQ(report.status, Status::UNREACHABLE);
  EXPECT_TRUE(report.path.empty());
  EXPECT_NE(report.message.find("(2.5, 0.5)"), std::string::npos) << report.message;
  EXPECT_EQ(MapPlanner().plan({}).status, Status::NO_MAP);
}

}  // namespace
}  // namespace grid_path_planner
