// No stamp ends a node, nor stops driving for long.
//
// What was seen before: roscpp's difference of two times throws beyond 2^31 s, so that a map, path or
// transform stamped 2^31 s from now ended path_planner or navigate_path (from January 2038 on one
// stamped 0); two transforms near 2^32 s ended every node that listens to tf, inside tf2; and one
// stamped years ahead was the latest for years, so that the vehicle stood.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/GetPlan.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/navigate_fixture.h"
#include "support/ascii_map.h"

namespace grid_path_planner::nodes {
namespace {

using test::isZero;
using test::pathOf;
using test::Process;

ros::Time stampOf(std::uint32_t seconds) {
  return {seconds, 0};
}

// The clock that the nodes go by, and all that they need at its time, 50 times a second.
class World {
 public:
  explicit World(bool simulated)
      : simulated_(simulated),
        clock_(nh_.advertise<rosgraph_msgs::Clock>("/clock", 10)),
        transforms_(nh_.advertise<tf2_msgs::TFMessage>("/tf", 10)) {
    thread_ = std::thread([this] {
      while (!done_) {
        tick();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  }
  ~World() {
    done_ = true;
    thread_.join();
  }

  ros::Time now() const {
    if (simulated_) return ros::Time(time_.load());
    const ros::WallTime wall = ros::WallTime::now();
    return {wall.sec, wall.nsec};
  }
  void sendTransform(const ros::Time& stamp) {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header.frame_id = "map";
    message.transforms[0].header.stamp = stamp;
    message.transforms[0].child_frame_id = "base_link";
    message.transforms[0].transform.translation.x = 0.5;
    message.transforms[0].transform.translation.y = 0.5;
    message.transforms[0].transform.rotation.w = 1.0;
    transforms_.publish(message);
  }

 private:
  void tick() {
    time_ = time_ + 0.02;
    rosgraph_msgs::Clock clock;
    clock.clock = ros::Time(time_.load());
    clock_.publish(clock);  // the test's own time too
    sendTransform(now());
  }

  const bool simulated_;
  std::atomic<double> time_{100.0};
  std::atomic<bool> done_{false};
  ros::NodeHandle nh_;
  ros::Publisher clock_, transforms_;
  std::thread thread_;
};

class Stamps : public test::NavigateTest, public testing::WithParamInterface<bool> {
 protected:
  Stamps() {
    ros::param::del("/path_planner");
    ros::param::del("/teleop_joy");
    ros::param::set("/use_sim_time", GetParam());
  }
  ~Stamps() override { ros::param::set("/use_sim_time", true); }

  void start() {
    world_ = std::make_unique<World>(GetParam());
    startNavigate({"_check_map:=true", "_no_progress_timeout:=0"});
    planner_ = std::make_unique<Process>("path_planner", std::vector<std::string>{});
    joystick_ = std::make_unique<Process>("teleop_joy", std::vector<std::string>{});
    ASSERT_TRUE(test::waitFor([&] {
      return joy_.getNumSubscribers() > 0 && goals_.getNumSubscribers() > 0 &&
             maps_.getNumSubscribers() > 1;
    }));
  }

  // One message of every topic, with this stamp.
  void sendAll(const ros::Time& stamp) {
    for (int twice = 0; twice < 2; ++twice) world_->sendTransform(stamp);
    sendMap(stamp);
    map_msgs::OccupancyGridUpdate update;
    update.header.stamp = stamp;
    update.width = update.height = 1;
    update.data = {0};
    updates_.publish(update);
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "map";
    goal.header.stamp = stamp;
    goal.pose.position.x = goal.pose.position.y = 0.5;
    goal.pose.orientation.w = 1.0;
    goals_.publish(goal);
    geometry_msgs::PoseWithCovarianceStamped start;
    start.header = goal.header;
    start.pose.pose = goal.pose;
    starts_.publish(start);
    sensor_msgs::Joy joy;
    joy.header.stamp = stamp;
    joy.axes.assign(8, 0.0F);
    joy.buttons.assign(11, 0);
    joy_.publish(joy);
    sendPath(stamp);
  }
  void sendMap(const ros::Time& stamp) {
    maps_.publish(occupancyToMessage(test::AsciiMap({"........"}).map, "map", stamp));
  }
  void sendPath(const ros::Time& stamp) {
    paths_.publish(pathToMessage(pathOf({{0.5, 0.5}, {7.5, 0.5}}), stamp));
  }

  // Whether right data are driven and planned by.
  bool goesOn() {
    sendMap(world_->now());
    const std::size_t seen = velocity_.count();
    const bool drives = test::waitFor([&] {  // the planner's answers come on the topic too
      sendPath(world_->now());
      ros::WallDuration(0.1).sleep();
      const auto all = velocity_.all();
      return all.size() > seen && !isZero(all.back());
    });
    EXPECT_TRUE(drives);
    const bool plans = test::waitFor([&] {
      nav_msgs::GetPlan plan;
      plan.request.goal.header.frame_id = "map";
      plan.request.goal.pose.position.x = 6.5;
      plan.request.goal.pose.position.y = 0.5;
      plan.request.goal.pose.orientation.w = 1.0;
      ros::service::call("/path_planner/make_plan", plan);
      return !plan.response.plan.poses.empty();
    });
    EXPECT_TRUE(plans);
    return drives && plans && navigate_->running() && planner_->running() && joystick_->running();
  }

  std::unique_ptr<World> world_;
  ros::Publisher maps_ = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 10, true);
  ros::Publisher updates_ =
      nh_.advertise<map_msgs::OccupancyGridUpdate>("projected_map_updates", 10);
  ros::Publisher goals_ = nh_.advertise<geometry_msgs::PoseStamped>("goal", 10);
  ros::Publisher starts_ =
      nh_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 10);
  ros::Publisher joy_ = nh_.advertise<sensor_msgs::Joy>("joy", 10);
  std::unique_ptr<Process> planner_, joystick_;
};

TEST_P(Stamps, OfEveryTopicEndNoNodeAndStopNothingForLong) {
  start();
  ASSERT_TRUE(goesOn());
  constexpr std::uint32_t kHalf = 1U << 31;
  const std::uint32_t now = world_->now().sec;
  for (const std::uint32_t seconds :
       {0U, 1U, now + kHalf, now - kHalf, now + kHalf + 1, ~0U, now + 100'000'000}) {
    sendAll(stampOf(seconds));
    ASSERT_TRUE(goesOn()) << "after messages stamped " << seconds << ", now " << now;
  }
}

INSTANTIATE_TEST_SUITE_P(Clocks, Stamps, testing::Bool(),
                         [](const auto& info) { return info.param ? "simulated" : "wall"; });

}  // namespace
}  // namespace grid_path_planner::nodes
