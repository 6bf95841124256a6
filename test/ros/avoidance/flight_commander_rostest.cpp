// What local_planner commands rests on nothing that is too old. Here the test is the pilot.
//
// What was seen before: a velocity stayed in force however late the next one was. Then it became a zero at once, so that
// the vehicle stuttered where plans were a little late.
#include "ros/avoidance/flight_commander.h"

#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "ros/messages/velocity_message.h"
#include "ros/support/flight_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using geometry_msgs::Twist;
using test::drives;
using test::Latest;
using test::stands;

class CommanderTest : public testing::Test {
 protected:
  using Command = FlightCommander::Command;

  // Held for so long (s) by the wall clock where no other comes.
  void start(double frame_period) {
    options_.pilot.frame_period = frame_period;
    options_.control_rate = 50.0;
    options_.master_timeout = 0.0;
    ASSERT_TRUE(test::waitFor([&] { return !ros::Time::now().isZero(); }));
    commander_ =
        std::make_unique<FlightCommander>(nh_, options_, [this](unsigned n) { handovers_ = n; });
    ASSERT_TRUE(commander_->begin(0));
    ASSERT_TRUE(test::waitFor([&] {
      return commands_.connected() && manuals_.getNumSubscribers() > 0 &&
             stops_.getNumSubscribers() > 0;
    }));
  }
  void plan(double good_for) {
    commander_->notice(true);
    commander_->command({{1.0, 0.0, 0.0, 0.0}, measured_, 0.0, ros::Time::now(), good_for, false});
  }
  // With a new plan every now and then.
  bool fliesBy(double good_for) {
    const std::size_t seen = commands_.count();
    return test::waitFor([&] {
      plan(good_for);
      return anyDrives(seen);
    });
  }
  bool anyDrives(std::size_t from) const {
    const auto all = commands_.all();
    return std::any_of(all.begin() + static_cast<std::ptrdiff_t>(from), all.end(), drives);
  }
  // Zeros come, and nothing else after the first, though the clock goes on.
  bool endsInZeros() {
    const auto noticed = [&](const std::function<bool()>& condition) {
      return test::waitFor([&] {
        commander_->notice(true);
        return condition();
      });
    };
    if (!noticed([&] { return stands(commands_.all().back()); })) return false;
    const std::size_t seen = commands_.count();
    return noticed([&] { return commands_.count() > seen + 10; }) && !anyDrives(seen);
  }
  // In zeros each time, and at last for want of a newer plan: a /clock of the test that stands still on a busy machine is a
  // reason of its own.
  bool endsOverdue(double good_for) {
    bool in_zeros = true;
    const bool overdue = test::waitFor([&] {
      in_zeros = in_zeros && fliesBy(good_for) && endsInZeros();
      return !in_zeros || commander_->overdue() > 0;
    });
    return in_zeros && overdue;
  }
  static bool isSlower(const Twist& v) { return v.linear.x > 0.0 && v.linear.x < 0.95; }
  bool becomesSlower() {
    return test::waitFor([&] {
      commander_->notice(true);
      return isSlower(commands_.all().back());
    });
  }
  bool stops(bool is) {
    std_msgs::Bool message;
    message.data = is;
    stops_.publish(message);
    return test::waitFor([&] { return commander_->gate().stopped() == is; });
  }
  bool becomesManual(bool is) {
    std_msgs::Bool message;
    message.data = is;
    manuals_.publish(message);
    return test::waitFor([&] { return commander_->gate().isManual() == is; });
  }

  test::Sky sky_;
  ros::NodeHandle nh_;
  Latest<Twist> commands_{nh_, "cmd_vel"};
  ros::Publisher manuals_ = nh_.advertise<std_msgs::Bool>("manual_control", 1);
  ros::Publisher stops_ = nh_.advertise<std_msgs::Bool>("stop", 1);
  LocalPlannerOptions options_;
  std::atomic<unsigned> handovers_{0};
  base::BodyVelocity measured_{1.0, 0.0, 0.0, 0.0};
  std::unique_ptr<FlightCommander> commander_;
};

TEST_F(CommanderTest, AVelocityThatNoOtherFollowsBecomesAZero) {
  ASSERT_NO_FATAL_FAILURE(start(0.1));
  EXPECT_TRUE(endsOverdue(1e3));
  EXPECT_TRUE(fliesBy(1e3)) << "by the next plan";
}

TEST_F(CommanderTest, ALatePlanFindsTheVehicleALittleSlower) {
  options_.pilot.max_acceleration = 0.05;
  ASSERT_NO_FATAL_FAILURE(start(0.1));
  ASSERT_TRUE(fliesBy(1e3));
  EXPECT_TRUE(becomesSlower());
  const auto all = commands_.all();
  const auto brakes = std::find_if(all.begin(), all.end(), isSlower);
  EXPECT_TRUE(std::is_sorted(brakes, all.end(), [](const Twist& one, const Twist& next) {
    return one.linear.x > next.linear.x;
  }));
  EXPECT_EQ(all.back().linear.y, 0.0);
  const std::size_t seen = commands_.count();
  plan(1e3);
  EXPECT_TRUE(commands_.waitFor(seen, [](const Twist& v) { return v.linear.x == 1.0; }));
}

// The pilot has seen to room for what it reaches within frame_period, and no more.
TEST_F(CommanderTest, AVehicleThatSetsOffGetsNoFasterWithoutAPlan) {
  options_.pilot.max_acceleration = 0.05;
  measured_ = {};
  ASSERT_NO_FATAL_FAILURE(start(0.1));
  ASSERT_TRUE(fliesBy(1e3));
  ASSERT_TRUE(endsInZeros());
  for (const Twist& v : commands_.all())
    EXPECT_TRUE(v.linear.x == 1.0 || v.linear.x < 0.005) << v.linear.x;
}

TEST_F(CommanderTest, SaysWhatItHasSent) {
  ASSERT_NO_FATAL_FAILURE(start(10.0));
  const auto sends = [&](double surge) {
    return test::waitFor([&] {
      commander_->notice(true);
      return commander_->gate().sent().surge == surge;
    });
  };
  ASSERT_TRUE(fliesBy(1e3));
  EXPECT_TRUE(sends(1.0));
  ASSERT_TRUE(stops(true));
  EXPECT_TRUE(sends(0.0));
  ASSERT_TRUE(stops(false));
  EXPECT_TRUE(endsInZeros()) << "until the next plan";
  ASSERT_TRUE(fliesBy(1e3));
  EXPECT_TRUE(sends(1.0));
  EXPECT_TRUE(test::waitFor([&] {
    return becomesManual(true) && commander_->gate().sent().surge == 0.0;
  })) << "the joystick's velocities are in force, of which it knows none";
}

TEST_F(CommanderTest, AVelocityWhoseCloudsGrowTooOldBecomesAZero) {
  ASSERT_NO_FATAL_FAILURE(start(10.0));
  EXPECT_TRUE(endsOverdue(0.5));
}

TEST_F(CommanderTest, AVelocityOfATimeToComeBecomesAZero) {
  ASSERT_NO_FATAL_FAILURE(start(10.0));
  ASSERT_TRUE(fliesBy(1e12));
  sky_.jumpTo(5e8);
  EXPECT_TRUE(endsInZeros());
}

TEST_F(CommanderTest, AJoystickThatTookOverWhileThePlanWasLateIsNotForgotten) {
  ASSERT_NO_FATAL_FAILURE(start(10.0));
  ASSERT_TRUE(fliesBy(1e3));
  ASSERT_TRUE(becomesManual(true));
  const std::size_t before = commands_.count();
  ASSERT_TRUE(becomesManual(false));
  EXPECT_TRUE(endsInZeros());
  EXPECT_FALSE(anyDrives(before + 1)) << "one may have been sent before";
  EXPECT_TRUE(commander_->resume(true).done);
  EXPECT_TRUE(fliesBy(1e3));
}

// A heading that was no number made the setpoint of a vehicle that stood one.
TEST_F(CommanderTest, WhatIsSentIsFiniteWhateverItIsHanded) {
  ASSERT_NO_FATAL_FAILURE(start(10.0));
  const Latest<geometry_msgs::TwistStamped> setpoints{nh_, "setpoint_velocity"};
  ASSERT_TRUE(test::waitFor([&] { return setpoints.connected(); }));
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const std::vector<double> odd{std::nan(""), kInfinite, -kInfinite, 1e160, -1e300, 1e-310};
  std::mt19937_64 random(1);
  for (int i = 0; i < 3000; ++i) {
    const auto any = [&] { return random() % 16 == 0 ? odd[random() % odd.size()] : 0.5; };
    commander_->notice(true);
    commander_->command({{any(), any(), any(), any()},
                         {any(), any(), any(), any()},
                         any(),
                         ros::Time::now(),
                         any(),
                         false});
    if (i % 10 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(test::waitFor([&] { return setpoints.count() > 500 && commands_.count() > 500; }));
  for (const geometry_msgs::TwistStamped& setpoint : setpoints.all())
    ASSERT_TRUE(velocityFromMessage(setpoint.twist).isFinite()) << setpoint;
  const auto all = commands_.all();
  for (const Twist& v : all) ASSERT_TRUE(velocityFromMessage(v).isFinite()) << v;
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), drives));
}

// It was asked once a plan whether a joystick commands: a tap between two plans was not seen.
TEST_F(CommanderTest, WhatWasGivenBeforeATapIsNotBegunAfterwards) {
  ASSERT_NO_FATAL_FAILURE(start(10.0));
  commander_->notice(false);
  for (const bool on : {true, false}) ASSERT_TRUE(becomesManual(on));
  ASSERT_TRUE(test::waitFor([&] { return handovers_ == 2; }));
  for (const unsigned given : {0U, 1U}) EXPECT_FALSE(commander_->begin(given)) << given;
  EXPECT_TRUE(commander_->begin(2));
}

TEST_F(CommanderTest, NothingComesAfterItsLastZero) {
  ASSERT_NO_FATAL_FAILURE(start(10.0));
  ASSERT_TRUE(fliesBy(1e3));
  commander_->finish();
  ASSERT_TRUE(test::waitFor([&] { return stands(commands_.all().back()); }));
  const std::size_t seen = commands_.count();
  plan(1e3);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(commands_.count(), seen);
}

}  // namespace
}  // namespace grid_path_planner::nodes
