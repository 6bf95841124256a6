// Whatever allocation fails while other options and zones are taken: nothing has changed, and nothing is told to have.
//
// By the code: a change that was refused for want of memory was in force all the same; then, after that was mended, the map
// was laid in part until it was laid again.
#include <gtest/gtest.h>

#include <memory>
#include <new>

#include "layers/layered_map.h"
#include "memory/failing_allocation.h"

namespace grid_path_planner::layers {
namespace {

using grid::GridGeometry;
using grid::OccupancyGrid;

Zones zonesAt(double x) {
  return {"map",
          {{"a", Zone::Kind::KEEP_OUT, 0.0, {{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}},
           {"b", Zone::Kind::SLOW, 0.2, {{x, 1}, {x + 1, 1}, {x + 1, 2}, {x, 2}}}}};
}

struct Laid {
  std::shared_ptr<const OccupancyGrid> base =
      std::make_shared<const OccupancyGrid>(GridGeometry(6, 2, 1.0), 0);
  LayeredMap map;

  explicit Laid(double zones) {
    map.configure({}, zonesAt(zones));
    lay();
  }
  void lay() {
    map.setBase(base);
    map.setLive(base);
    map.takeChanged();
    map.takeNewSpeedLimits();
  }
};

TEST(ConfigureMemoryLaw, ARefusedChangeIsNotInForce) {
  const Laid before(1.0), after(4.0);
  ASSERT_FALSE(before.map.merged() == after.map.merged());
  ASSERT_FALSE(before.map.speedLimits() == after.map.speedLimits());
  for (int number = 1;; ++number) {
    ASSERT_LT(number, 10000);
    Laid laid(1.0);
    const Zones zones = zonesAt(4.0);
    bool taken = false, happened = false;
    try {
      const test::FailingAllocation fails(number);
      laid.map.configure({}, zones);
      taken = true;
      happened = fails.happened();
    } catch (const std::bad_alloc&) {
      happened = true;
    }
    const LayeredMap& expected = taken ? after.map : before.map;
    EXPECT_EQ(laid.map.merged(), expected.merged()) << number;
    EXPECT_EQ(laid.map.speedLimits(), expected.speedLimits()) << number;
    EXPECT_EQ(laid.map.takeChanged().empty(), !taken) << number;
    EXPECT_EQ(laid.map.takeNewSpeedLimits(), taken) << number;
    laid.lay();
    EXPECT_EQ(laid.map.merged(), expected.merged()) << number << ", laid again";
    if (!happened) return;
  }
}

}  // namespace
}  // namespace grid_path_planner::layers
