// Whatever allocation fails while a planner takes a map of another size, or other options: it plans by those before until it
// has taken these.
//
// By the code: what was taken first was held for taken as a whole. The planner went on with the costmap of the map, or of the
// options, before, without a word; later it told the options, and planned on nothing until the next ones came.
#include <gtest/gtest.h>

#include <memory>
#include <new>

#include "grid_path_planner/planning/path_planner.h"
#include "memory/failing_allocation.h"
#include "planning/map_store.h"
#include "support/ascii_map.h"

namespace grid_path_planner::planning {
namespace {

using base::Status;
using grid::OccupancyGrid;
using test::FailingAllocation;

std::shared_ptr<const OccupancyGrid> picture(const std::vector<std::string>& lines) {
  return std::make_shared<const OccupancyGrid>(test::AsciiMap(lines).map);
}

PoseRequest alongTheFirstRow() {
  PoseRequest request;
  request.start.position.head<2>() << 0.5, 0.5;
  request.goal.position.head<2>() << 4.5, 0.5;
  return request;
}

PlannerOptions ofRadius(double radius) {
  PlannerOptions options;
  options.costmap.radius = radius;
  return options;
}

// Calls `work` with its first, second, ... allocation failing, until none fails, and each time `check` afterwards.
template <class Begin, class Work, class Check>
void failEach(Begin begin, Work work, Check check) {
  for (int number = 1;; ++number) {
    auto subject = begin();
    bool happened = false;
    try {
      const FailingAllocation fails(number);
      work(*subject);
      happened = fails.happened();
    } catch (const std::bad_alloc&) {
      happened = true;
    }
    check(*subject, number);
    if (!happened) return;
    ASSERT_LT(number, 10000);
  }
}

struct Planning {
  std::shared_ptr<MapStore> store = std::make_shared<MapStore>();
  PathPlanner planner{store, ofRadius(0.0)};

  Planning() {
    store->setMap(picture({".....", "....."}), "map");
    planner.takeMap();
    EXPECT_EQ(planner.plan(alongTheFirstRow()).status, Status::FOUND);
  }
};

TEST(PlannerMemoryLaw, AMapOfAnotherSizeIsPlannedOnThoughItWasTakenInPart) {
  const auto walled = picture({"..#..", "..#..", "..#.."});
  failEach(
      [&] {
        auto planning = std::make_unique<Planning>();
        planning->store->setMap(walled, "map");
        return planning;
      },
      [](Planning& planning) { planning.planner.takeMap(); },
      [&](Planning& planning, int number) {
        if (planning.planner.map() != walled)
          EXPECT_EQ(planning.planner.plan(alongTheFirstRow()).status, Status::FOUND) << number;
        planning.planner.takeMap();
        EXPECT_EQ(planning.planner.plan(alongTheFirstRow()).status, Status::UNREACHABLE) << number;
      });
}

TEST(PlannerMemoryLaw, OtherOptionsAreThoseThatIsPlannedByThoughTheyWereTakenInPart) {
  const auto narrow = picture({".....", ".....", ".....", ".###.", "#...#", ".###."});
  const auto inTheLane = [] {
    PoseRequest request;
    request.start.position.head<2>() << 1.5, 4.5;
    request.goal.position.head<2>() << 3.5, 4.5;
    return request;
  };
  failEach(
      [&] {
        auto planning = std::make_unique<Planning>();
        planning->store->setMap(narrow, "map");
        planning->planner.takeMap();
        EXPECT_EQ(planning->planner.plan(inTheLane()).status, Status::FOUND);
        return planning;
      },
      [](Planning& planning) { planning.planner.setOptions(ofRadius(0.9)); },
      [&](Planning& planning, int number) {
        const bool narrow_is_open = planning.planner.plan(inTheLane()).status == Status::FOUND;
        EXPECT_EQ(planning.planner.options().costmap.radius, narrow_is_open ? 0.0 : 0.9) << number;
        planning.planner.setOptions(ofRadius(0.9));
        EXPECT_NE(planning.planner.plan(inTheLane()).status, Status::FOUND) << number;
      });
}

TEST(PlannerMemoryLaw, WhatAPlanLeftHalfDoneIsMadeAnewByTheNext) {
  const auto rooms = picture({"...#...", ".#.#.?.", ".#...?.", ".####..", "......."});
  PoseRequest request;
  request.start.position.head<2>() << 0.5, 0.5;
  request.goal.position.head<2>() << 4.5, 0.5;
  const Plan expected = [&] {
    PathPlanner planner(ofRadius(0.3));
    planner.setMap(rooms);
    return planner.plan(request);
  }();
  ASSERT_EQ(expected.status, Status::FOUND);
  for (const bool changed : {false, true}) {
    failEach(
        [&] {
          auto planner = std::make_unique<PathPlanner>(ofRadius(0.3));
          planner->setMap(rooms);
          if (!changed) return planner;
          auto other = std::make_shared<OccupancyGrid>(*rooms);
          (*other)[{6, 4}] = 100;
          planner->setMap(other);
          EXPECT_EQ(planner->plan(request).status, Status::FOUND);
          planner->updateMap(rooms, {{6, 4, 1, 1}});
          return planner;
        },
        [&](PathPlanner& planner) { planner.plan(request); },
        [&](PathPlanner& planner, int number) {
          const Plan plan = planner.plan(request);
          ASSERT_EQ(plan.status, Status::FOUND) << number << ": " << plan.message;
          EXPECT_EQ(plan.costValue(), expected.costValue()) << number;
        });
  }
}

}  // namespace
}  // namespace grid_path_planner::planning
