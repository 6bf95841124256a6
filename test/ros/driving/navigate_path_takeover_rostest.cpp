// Who commands the vehicle: a joystick before navigate_path, `stop` before both, and nobody besides.
//
// What was seen before: a joystick and navigate_path commanded in turns, 50 times a second; nothing
// but ~cancel stopped a drive; and two navigate_paths drove one vehicle along two paths.
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/callback_queue.h>
#include <sensor_msgs/Joy.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "grid_path_planner/NavigatePathActionGoal.h"
#include "grid_path_planner/NavigatePathActionResult.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/driving/drive_loop.h"
#include "ros/support/links.h"
#include "ros/support/still_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using geometry_msgs::Twist;
using test::isZero;
using test::pathOf;
using test::Process;
using test::StillWorld;

// The commands that are not zero, with the nodes that they are of.
class Commanders {
 public:
  explicit Commanders(ros::NodeHandle nh)
      : subscriber_(nh.subscribe("cmd_vel", 100, &Commanders::onCommand, this)) {}

  std::string latest() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return latest_;
  }
  // Whether the last twenty are all of `node`.
  bool areOf(const std::string& node) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return nodes_.size() >= 20 && std::count(nodes_.end() - 20, nodes_.end(), node) == 20;
  }
  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    nodes_.clear();
    latest_.clear();
  }
  // Whether the newest command of all, forgotten ones too, is a zero.
  bool endInAZero() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return newest_is_zero_;
  }

 private:
  void onCommand(const ros::MessageEvent<Twist const>& event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_is_zero_ = isZero(*event.getMessage());
    if (newest_is_zero_) return;
    latest_ = event.getPublisherName();
    nodes_.push_back(latest_);
  }

  mutable std::mutex mutex_;
  std::string latest_;
  std::vector<std::string> nodes_;
  bool newest_is_zero_ = false;
  ros::Subscriber subscriber_;
};

class Takeover : public test::StillTest {
 protected:
  Takeover() {
    ros::param::del("/teleop_joy");
    nh_.setCallbackQueue(&queue_);
  }

  void startJoystick(std::uint32_t commanders = 2) {
    // It is never let go by a test that stalls.
    joystick_ =
        std::make_unique<Process>("teleop_joy", std::vector<std::string>{"_joy_timeout:=30"});
    ASSERT_TRUE(test::waitFor([&] { return joy_.getNumSubscribers() > 0; }));
    ASSERT_TRUE(test::waitFor([&] { return velocity_.publishers() == commanders; }));
    ASSERT_TRUE(test::waitFor([&] {
      return !navigate_ || test::linksOf(uriOfNode("/teleop_joy", 1.0), "/manual_control", "o") > 0;
    })) << "navigate_path does not hear it";
  }
  void push(bool deadman) {
    sensor_msgs::Joy message;
    message.axes.assign(8, 0.0F);
    message.axes[1] = 1.0F;
    message.buttons.assign(11, 0);
    message.buttons[4] = deadman;
    joy_.publish(message);
  }
  // Whether `condition` comes true with the deadman button held, or let go.
  bool pushUntil(bool deadman, const std::function<bool()>& condition) {
    return test::waitFor([&] {
      push(deadman);
      return condition();
    });
  }
  bool takesOver() {
    return pushUntil(true, [&] { return commanders_.latest() == "/teleop_joy"; });
  }
  // Of a loop without a map, once the vehicle is known to be somewhere.
  static NavigatePathOptions optionsWithTransforms(FrameTransforms& transforms) {
    NavigatePathOptions options;
    options.check_map = false;
    options.tf_timeout = 3.0;  // a test that is kept waiting sends none meanwhile
    EXPECT_TRUE(test::waitFor(
        [&] { return !transforms.commonFrame(options.map_frame, options.base_frame).empty(); }));
    return options;
  }
  void stop(bool on) {
    std_msgs::Bool message;
    message.data = on;
    stop_.publish(message);
  }

  StillWorld world_{100.0};
  Commanders commanders_{nh_};
  ros::Publisher joy_ = nh_.advertise<sensor_msgs::Joy>("joy", 10);
  ros::Publisher stop_ = nh_.advertise<std_msgs::Bool>("stop", 1, true);
  GuardedQueue queue_{*ros::getGlobalCallbackQueue()};
  std::unique_ptr<Process> joystick_;
};

// Once it has heard it: messages of the two to the vehicle overtake each other.
TEST_F(Takeover, NoTickCommandsOnceAJoystickIsHeard) {
  ros::CallbackQueue queue;
  ros::NodeHandle own;
  own.setCallbackQueue(&queue);
  int motions = 0;
  const ros::Subscriber commands = own.subscribe<Twist>(
      "cmd_vel", 10000, [&](const Twist::ConstPtr& v) { motions += isZero(*v) ? 0 : 1; });
  const auto motionsSoFar = [&] {  // each is there as soon as it is published
    queue.callAvailable();
    return motions;
  };
  FrameTransforms transforms(nh_);
  DriveLoop loop(nh_, optionsWithTransforms(transforms), transforms, {[] {}, [](unsigned) {}});
  loop.start(pathOf({{0, 0}, {50, 0}}), following::Join::NEAREST, 0);
  ASSERT_TRUE(test::waitFor([&] { return motionsSoFar() > 0; }));
  ros::Publisher manual = nh_.advertise<std_msgs::Bool>("manual_control", 10);
  std_msgs::Bool on;
  on.data = true;
  ASSERT_TRUE(test::waitFor([&] {
    manual.publish(on);
    return loop.resume().message.find("the joystick commands") == 0;
  }));
  const int before = motionsSoFar();
  for (int tick = 0; tick < 100; ++tick) loop.standing();
  EXPECT_EQ(motionsSoFar(), before);
}

TEST_F(Takeover, AJoystickCommandsAndTheDriveIsResumedByHand) {
  drive();
  startJoystick();
  ASSERT_TRUE(takesOver());
  EXPECT_TRUE(navigate_->says("The joystick commands: the drive is paused"));
  EXPECT_TRUE(pushUntil(true, [&] { return commanders_.areOf("/teleop_joy"); }))
      << "they command in turns";
  EXPECT_FALSE(ask("resume")) << "while the joystick commands";
  publishPath(pathOf({{0, 0}, {0, 25}, {0, 50}}));
  ASSERT_TRUE(navigate_->says("drives a path of 3 waypoints"));
  for (int i = 0; i < 20; ++i) push(true);
  ASSERT_TRUE(pushUntil(false, [&] { return commanders_.endInAZero(); }));
  commanders_.forget();
  ASSERT_TRUE(test::waitFor([&, until = world_.time() + 8.0] { return world_.time() > until; }));
  EXPECT_EQ(commanders_.latest(), "") << "it does not go on by itself";
  EXPECT_TRUE(ask("resume"));
  EXPECT_TRUE(test::waitFor([&] { return commanders_.latest() == "/navigate_path"; }));
}

// Whether the file has been read when it takes over or not: whoever lets go does not see the vehicle drive off.
TEST_F(Takeover, AJoystickTakesOverWhileTheFileOfAGoalIsRead) {
  const test::TemporaryFolder folder;
  path::Path route{"map", {}};
  for (int i = 0; i < 200000; ++i) route.poses.push_back({{40.0 + 0.001 * i, 0.0, 0.0}, 0.0});
  path::writeWaypointFile(folder.path("route.yaml"), route);
  startNavigate({"_no_progress_timeout:=0", "--load-folder", folder.path("")});
  startJoystick();
  const test::Latest<NavigatePathActionResult> results(nh_, "navigate_path/result");
  const test::Latest<actionlib_msgs::GoalStatusArray> statuses(nh_, "navigate_path/status");
  ros::Publisher goals = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1);
  ASSERT_TRUE(test::waitFor([&] {
    return goals.getNumSubscribers() > 0 && results.connected() && statuses.connected();
  }));
  commanders_.forget();
  NavigatePathActionGoal goal;
  goal.goal_id.id = "long";
  goal.goal.filename = "route.yaml";
  goals.publish(goal);
  ASSERT_TRUE(statuses.waitFor(0, [](const actionlib_msgs::GoalStatusArray& array) {
    return !array.status_list.empty();
  })) << "or the goal comes after the joystick";
  ASSERT_TRUE(takesOver());
  ASSERT_TRUE(pushUntil(false, [&] { return commanders_.endInAZero(); }));
  ASSERT_TRUE(test::waitFor([&] {
    return results.count() > 0 || navigate_->hasSaid("the drive is paused");
  })) << navigate_->output()
      << joystick_->output();
  commanders_.forget();
  ASSERT_TRUE(test::waitFor([&, until = world_.time() + 8.0] { return world_.time() > until; }));
  EXPECT_EQ(commanders_.latest(), "") << navigate_->output();
  for (const NavigatePathActionResult& result : results.all())
    EXPECT_EQ(result.result.message, "the joystick commands");
}

// A file that is read meanwhile was driven: whoever had taken over, and let go, saw the vehicle set off.
TEST_F(Takeover, WhatWasGivenBeforeAJoystickTookOverOrLetGoIsNotDrivenAfterwards) {
  FrameTransforms transforms(nh_);
  std::atomic<unsigned> handovers{0};
  DriveLoop loop(nh_, optionsWithTransforms(transforms), transforms,
                 {[] {}, [&](unsigned n) { handovers = n; }});
  ros::Publisher manual = nh_.advertise<std_msgs::Bool>("manual_control", 10);
  std_msgs::Bool commands;
  for (const bool on : {true, false}) {
    commands.data = on;
    manual.publish(commands);
  }
  ASSERT_TRUE(test::waitFor([&] { return handovers == 2; }));
  for (const unsigned given : {0U, 1U}) {
    loop.start(pathOf({{0, 0}, {50, 0}}), following::Join::NEAREST, given);
    EXPECT_EQ(loop.standing().status, following::DriveStatus::CANCELLED);
    EXPECT_EQ(loop.standing().message, "the joystick commands");
  }
  loop.start(pathOf({{0, 0}, {50, 0}}), following::Join::NEAREST, 2);
  EXPECT_TRUE(isDriving()) << "nobody commands any more, but: " << loop.standing().message;
}

TEST_F(Takeover, AJoystickThatWasKilledDoesNotHoldTheDriveForEver) {
  drive();
  startJoystick();
  ASSERT_TRUE(takesOver());
  joystick_->signal(SIGKILL);
  ASSERT_TRUE(joystick_->waitForExit());
  EXPECT_TRUE(test::waitFor([&] {
    std_srvs::Trigger call;
    return ros::service::call("/navigate_path/resume", call) && call.response.success;
  }));
  EXPECT_TRUE(isDriving());
}

TEST_F(Takeover, StopZeroesUntilItIsReleased) {
  drive();
  startJoystick();
  stop(true);
  EXPECT_TRUE(stops());
  EXPECT_TRUE(navigate_->says("stopped by the topic /stop"));
  EXPECT_TRUE(ask("pause"));
  EXPECT_TRUE(ask("resume"));
  EXPECT_TRUE(stops()) << "whoever resumes";
  for (int i = 0; i < 20; ++i) push(true);
  EXPECT_TRUE(stops()) << "the joystick too";
  const std::size_t seen = velocity_.count();
  EXPECT_TRUE(velocity_.waitForMoreThan(seen)) << "zeros come all the time";
  ASSERT_TRUE(
      pushUntil(false, [&] { return joystick_->output().find("no longer") != std::string::npos; }));
  stop(false);
  EXPECT_TRUE(test::waitFor([&] {
    std_srvs::Trigger call;
    ros::service::call("/navigate_path/resume", call);  // the joystick paused it
    return commanders_.latest() == "/navigate_path" && !isZero(velocity_.all().back());
  }));
}

TEST_F(Takeover, ALatchedStopHoldsANodeThatStartsLater) {
  stop(true);
  startNavigate();
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(navigate_->says("stopped by the topic /stop"));
  EXPECT_TRUE(stops());
  stop(false);
  EXPECT_TRUE(isDriving());
}

TEST_F(Takeover, ASecondNodeThatCommandsRefusesToStartAndNamesTheFirst) {
  drive();
  const auto refusal = [](const std::string& node, const std::vector<std::string>& arguments) {
    Process second(node, arguments);
    EXPECT_TRUE(second.waitForExit());
    EXPECT_EQ(second.exitCode(), 1);
    return second.output();
  };
  EXPECT_NE(refusal("navigate_path", {"__name:=second"})
                .find("the node /navigate_path publishes /cmd_vel"),
            std::string::npos);
  EXPECT_NE(refusal("navigate_path", {"__name:=second", "_share_cmd_vel:=true"})
                .find("the node /navigate_path offers /navigate_path"),
            std::string::npos);
  EXPECT_TRUE(isDriving());
  Process other("navigate_path", {"__ns:=survey", "_share_cmd_vel:=true", "cmd_vel:=/cmd_vel",
                                  "manual_control:=/manual_control"});
  EXPECT_TRUE(test::waitFor([&] { return velocity_.publishers() == 2; })) << "where that is meant";
  startJoystick(3);
}

TEST_F(Takeover, ASecondJoystickRefusesToStart) {
  joystick_ = std::make_unique<Process>("teleop_joy", std::vector<std::string>{});
  ASSERT_TRUE(test::waitFor([&] { return velocity_.publishers() == 1; }));
  Process second("teleop_joy", {"__name:=second"});
  EXPECT_TRUE(second.waitForExit());
  EXPECT_EQ(second.exitCode(), 1);
  EXPECT_TRUE(second.says("the node /teleop_joy publishes /cmd_vel"));
}

TEST_F(Takeover, ASecondPlannerRefusesToStart) {
  Process first("path_planner", {});
  ASSERT_TRUE(test::waitFor([] { return ros::service::exists("/path_planner/make_plan", false); }));
  Process second("path_planner", {"__name:=second"});
  EXPECT_TRUE(second.waitForExit());
  EXPECT_EQ(second.exitCode(), 1);
  EXPECT_TRUE(second.says("the node /path_planner offers /plan_path"));
}

// A node that was killed stays registered with the master.
TEST_F(Takeover, ANodeThatWasKilledIsNoConflict) {
  drive();
  navigate_->signal(SIGKILL);
  ASSERT_TRUE(navigate_->waitForExit());
  Process second("navigate_path", {"__name:=second", "_check_map:=false"});
  EXPECT_TRUE(test::waitFor([] { return ros::service::exists("/second/cancel", false); }));
}

}  // namespace
}  // namespace grid_path_planner::nodes
