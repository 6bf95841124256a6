// projected_map under simulated time that leaps ahead, as the computer's own does where NTP sets it.
#include <rosgraph_msgs/Clock.h>

#include <cmath>

#include "ros/guard/clock.h"
#include "ros/support/mapping_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::cloudOf;
using test::CloudPoints;
using test::valueAt;
using test::wallAt;

class ProjectedMapClock : public test::MappingTest {
 protected:
  void setTime(double seconds) {
    rosgraph_msgs::Clock clock;
    clock.clock.fromSec(seconds);
    clock_.publish(clock);
  }
  // Whether a map of that time comes in which (x, y) is occupied, while it is seen so.
  bool becomesBySeeing(const CloudPoints& points, double time, double x, double y) {
    return test::waitFor([&] {
      setTime(time);
      clouds_.publish(cloudOf(points, "map", ros::Time(time)));
      for (const nav_msgs::OccupancyGrid& map : maps_.all())
        if (isOf(map, time) && valueAt(map, x, y) == 100) return true;
      return false;
    });
  }
  // Later by nanoseconds where it holds nothing newer than the one before.
  static bool isOf(const nav_msgs::OccupancyGrid& map, double time) {
    return std::abs(secondsBetween(ros::Time(time), map.header.stamp)) < 1e-3;
  }
  int newestAt(double x, double y) const { return valueAt(maps_.all().back(), x, y); }

  ros::Publisher clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  const Maps maps_{nh_, "projected_map"};
};

// Each wall became unknown at once, which the planner drives through, and the map that is kept was one without walls.
TEST_F(ProjectedMapClock, ALeapAheadForgetsNoWallWithADecayTime) {
  startMapping({"_decay_time:=60", "_always_send_full_map:=true"});
  ASSERT_TRUE(becomesBySeeing(wallAt(1.0F), 1000.0, 1.05, 0.05));
  double time = 1000.0 + 1e6;
  // The second of these maps is sent after a decay by the new time: the first one is stamped with that.
  ASSERT_TRUE(becomesBySeeing({{-1.05F, 2.05F, 0.05F}}, time, -1.05, 2.05));
  ASSERT_TRUE(becomesBySeeing({{-1.55F, 2.05F, 0.05F}}, time, -1.55, 2.05));
  EXPECT_EQ(newestAt(1.05, 0.05), 100);
  EXPECT_TRUE(test::waitFor([&] {
    setTime(time += 1.0);
    return newestAt(1.05, 0.05) != 100;
  })) << "what is not seen again fades as ever";
}

}  // namespace
}  // namespace grid_path_planner::nodes
