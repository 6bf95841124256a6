// A vehicle on the map of map_layers: a keep-out zone bends the plan, a slow zone slows the drive, and a laser that
// falls silent holds the vehicle.
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>

#include <atomic>
#include <thread>

#include "ros/support/planner_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::Latest;
using test::poseAt;
using test::Process;
using test::waitFor;

const char* const kZones =
    "zones:\n"
    "  - {name: wreck, kind: keep_out, polygon: [[2, -2], [3, -2], [3, 1], [2, 1]]}\n"
    "  - {name: door, kind: slow, max_speed: 0.2, polygon: [[5, -4], [7, -4], [7, 4], [5, 4]]}\n";

// Scans of a laser on the vehicle that sees nothing near, until it is told to be silent.
class Laser {
 public:
  explicit Laser(ros::NodeHandle nh) : scans_(nh.advertise<sensor_msgs::LaserScan>("scan", 10)) {
    thread_ = std::thread([this] {
      while (!done_) {
        if (sees_) see();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  }
  ~Laser() {
    done_ = true;
    thread_.join();
  }
  void fallSilent() { sees_ = false; }

 private:
  void see() {
    sensor_msgs::LaserScan scan;
    scan.header.frame_id = "base_link";
    scan.header.stamp = ros::Time::now();
    scan.angle_min = -1.5F;
    scan.angle_increment = 0.1F;
    scan.range_max = 30.0F;
    scan.ranges.assign(31, 25.0F);
    scans_.publish(scan);
  }

  ros::Publisher scans_;
  std::atomic<bool> sees_{true}, done_{false};
  std::thread thread_;
};

class LayeredDrive : public test::PlannerTest {
 protected:
  void SetUp() override {
    for (const char* node : {"/simulator", "/navigate_path", "/map_layers"}) ros::param::del(node);
    const grid::OccupancyGrid room(grid::GridGeometry(140, 40, 0.25, {-3.0, -5.0, 0.0}), 0);
    simulator_ = std::make_unique<Process>(
        "simulator", std::vector<std::string>{"_real_time_factor:=2", "_update_rate:=200",
                                              "_cmd_vel_timeout:=0.1"});
    ASSERT_TRUE(odom_.waitForMoreThan(0));
    layers_ = std::make_unique<Process>(
        "map_layers", std::vector<std::string>{"--zones-file", folder_.write("zones.yaml", kZones),
                                               "_use_scan:=true", "_source_timeout:=0.5"});
    static_.publish(occupancyToMessage(room, "map", ros::Time::now()));
    drive_ = std::make_unique<Process>(
        "navigate_path",
        std::vector<std::string>{"_control_rate:=200", "_tf_timeout:=3.0", "_use_speed_limit:=true",
                                 "_follow_latched:=true", "_map_timeout:=1.5"});
    startPlanner({"_radius:=0.4"});
    ASSERT_TRUE(waitFor([&] { return !planning_maps_.all().empty(); }));
  }
  double x() const { return odom_.all().back().pose.pose.position.x; }
  double speedOf(const nav_msgs::Odometry& odometry) const {
    return std::hypot(odometry.twist.twist.linear.x, odometry.twist.twist.linear.y);
  }

  const test::TemporaryFolder folder_;
  ros::Publisher static_ = nh_.advertise<nav_msgs::OccupancyGrid>("static_map", 1, true);
  Latest<nav_msgs::Odometry> odom_{nh_, "odom"};
  Laser laser_{nh_};
  std::unique_ptr<Process> simulator_, layers_, drive_;
};

TEST_F(LayeredDrive, KeepsOutSlowsDownAndStandsWithoutItsLaser) {
  sendGoal(poseAt(30.0, 0.0));
  ASSERT_EQ(answer_.status, "FOUND") << answer_.message;
  for (const auto& pose : path_.poses) {
    const auto& at = pose.pose.position;
    EXPECT_FALSE(at.x > 2.0 && at.x < 3.0 && at.y > -2.0 && at.y < 1.0) << at.x << ", " << at.y;
  }
  ASSERT_TRUE(waitFor([&] { return x() > 7.5; })) << "it stands at " << x();
  double before = 0.0, inside = 0.0;
  for (const nav_msgs::Odometry& odometry : odom_.all()) {
    const double at = odometry.pose.pose.position.x;
    if (at < 4.0) before = std::max(before, speedOf(odometry));
    if (at > 5.2 && at < 7.0) inside = std::max(inside, speedOf(odometry));
  }
  EXPECT_GT(before, 0.5);
  EXPECT_LT(inside, 0.2 * 1.1);
  EXPECT_GT(inside, 0.15);
  laser_.fallSilent();
  EXPECT_TRUE(layers_->says("/scan has been silent for longer than 0.5 s"));
  EXPECT_TRUE(waitFor([&] { return speedOf(odom_.all().back()) == 0.0; }));
  EXPECT_LT(x(), 29.0) << "before its goal";
}

}  // namespace
}  // namespace grid_path_planner::nodes
