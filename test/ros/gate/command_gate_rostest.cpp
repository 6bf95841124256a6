// What leaves the gate to a vehicle, whoever owns it.
#include "ros/gate/command_gate.h"

#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <std_msgs/Bool.h>

#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/support/flight_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using base::BodyVelocity;
using geometry_msgs::Twist;
using test::Latest;

constexpr BodyVelocity kVelocity{0.5, 0.1, -0.2, 0.3};

// Ticks by itself once in 20 s, and after whatever is asked for.
class CommandGateTest : public testing::Test {
 protected:
  void start(CommandGate::Joystick joystick = CommandGate::Joystick::HEEDED) {
    ASSERT_TRUE(test::waitFor([&] { return !ros::Time::now().isZero(); }));
    CommandGate::Owner owner;
    owner.tick = [this] { tick(); };
    owner.give_up = [this] { ++given_up_; };
    owner.drives = [this] { return driven_; };
    owner.on_handover = [this](unsigned handovers) { handovers_ = handovers; };
    owner.on_manual = [this](bool commands) { heard_.push_back(commands); };
    gate_ = std::make_unique<CommandGate>(nh_, owner, joystick);
    gate_->start({0.05, 0});
    const bool heeds = joystick == CommandGate::Joystick::HEEDED;
    ASSERT_TRUE(test::waitFor([&] {
      return commands_.connected() && stops_.getNumSubscribers() == 1 &&
             manuals_.getNumSubscribers() == (heeds ? 1 : 0);
    }));
  }
  void TearDown() override {
    if (!gate_) return;
    gate_->finish();
    gate_.reset();
  }

  void tick() {
    if (throws_) throw std::runtime_error("of the owner");
    if (const auto sent = gate_->send(driven_ ? kVelocity : BodyVelocity{}, driven_))
      sent_.push_back(*sent);
  }

  // What is sent in the next ticks, which comes to those who listen.
  std::vector<BodyVelocity> sentIn(int ticks) {
    std::size_t before = 0, all = 0;
    gate_->thread().ask([&] { before = sent_.size(); });
    for (int i = 1; i < ticks; ++i) gate_->thread().ask([] {});
    gate_->thread().ask([&] { all = sent_.size(); });
    return {sent_.begin() + static_cast<std::ptrdiff_t>(before),
            sent_.begin() + static_cast<std::ptrdiff_t>(all)};
  }
  void driveOn(bool driven) {
    gate_->thread().ask([&] { driven_ = driven; });
  }
  bool stop(bool is) {
    stops_.publish(messageOf(is));
    return test::waitFor([&] { return gate_->stopped() == is; });
  }
  bool takeOver(bool is) {
    manuals_.publish(messageOf(is));
    return test::waitFor([&] { return gate_->isManual() == is; });
  }
  static std_msgs::Bool messageOf(bool data) {
    std_msgs::Bool message;
    message.data = data;
    return message;
  }

  test::Sky sky_;
  ros::NodeHandle nh_;
  Latest<Twist> commands_{nh_, "cmd_vel"};
  ros::Publisher stops_ = nh_.advertise<std_msgs::Bool>("stop", 1);
  ros::Publisher manuals_ = nh_.advertise<std_msgs::Bool>("manual_control", 10);
  // Of the gate's thread:
  bool driven_ = false, throws_ = false;
  int given_up_ = 0;
  unsigned handovers_ = 0;
  std::vector<bool> heard_;
  std::vector<BodyVelocity> sent_;
  std::unique_ptr<CommandGate> gate_;
};

// From each state to each, by a seeded walk.
TEST_F(CommandGateTest, SendsZerosWhileStoppedNothingWhileAJoystickCommandsAndOneZeroAtAnEnd) {
  ASSERT_NO_FATAL_FAILURE(start());
  std::mt19937 random(3);
  bool is_moving = false;  // by what was sent last
  for (int step = 0; step < 120; ++step) {
    const unsigned state = random() % 8;
    const bool is_stopped = state & 1U, is_manual = state & 2U, is_driven = state & 4U;
    driveOn(false);
    ASSERT_TRUE(stop(true));
    ASSERT_TRUE(takeOver(is_manual));
    ASSERT_TRUE(stop(is_stopped));
    driveOn(is_driven);
    const std::vector<BodyVelocity> sent = sentIn(5);
    SCOPED_TRACE("state " + std::to_string(state));
    if (is_stopped)
      EXPECT_EQ(sent.size(), 5U);
    else if (is_manual || !is_driven)
      EXPECT_LE(sent.size(), is_manual ? 0U : 1U);
    else
      EXPECT_EQ(sent.size(), 5U);
    for (const BodyVelocity& velocity : sent)
      EXPECT_EQ(velocity.isZero(), is_stopped || !is_driven);
    is_moving = is_moving || (!sent.empty() && !sent.back().isZero());
  }
  EXPECT_TRUE(is_moving);
  EXPECT_TRUE(test::waitFor([&] { return commands_.count() >= sent_.size(); }));
}

TEST_F(CommandGateTest, WhatWasDrivenIsFollowedByAZero) {
  ASSERT_NO_FATAL_FAILURE(start());
  driveOn(true);
  ASSERT_EQ(sentIn(3).size(), 3U);
  std::vector<BodyVelocity> last;
  gate_->thread().ask([&] { driven_ = false; });
  gate_->thread().ask([&] { last = sent_; });
  EXPECT_TRUE(last.back().isZero());
  EXPECT_TRUE(sentIn(5).empty()) << "and by nothing after it";
}

TEST_F(CommandGateTest, NothingComesAfterTheLastZero) {
  for (const bool is_driven : {true, false}) {
    const std::size_t before = commands_.count();
    ASSERT_NO_FATAL_FAILURE(start());
    driveOn(is_driven);
    if (is_driven) ASSERT_EQ(sentIn(2).size(), 2U);
    gate_->finish([this] { driven_ = false; });
    const auto ended = [&] { return test::stands(commands_.all().back()); };
    if (is_driven) EXPECT_TRUE(test::waitFor(ended));
    const std::size_t all = commands_.count();
    EXPECT_EQ(all > before, is_driven) << "a vehicle that nothing drives is told nothing";
    driven_ = true;
    ASSERT_TRUE(stop(true)) << "it hears, and obeys";
    EXPECT_TRUE(sentIn(5).empty());
    EXPECT_EQ(commands_.count(), all);
    ASSERT_TRUE(stop(false));
    driven_ = false;
    gate_.reset();
  }
}

TEST_F(CommandGateTest, CountsHandoversOfAVehicleThatNothingDrives) {
  ASSERT_NO_FATAL_FAILURE(start());
  driveOn(true);
  for (const bool on : {true, false}) ASSERT_TRUE(takeOver(on));
  EXPECT_EQ(gate_->handovers(), 0U) << "what is driven is paused";
  driveOn(false);
  for (const bool on : {true, false}) ASSERT_TRUE(takeOver(on));
  EXPECT_TRUE(test::waitFor([&] { return gate_->handovers() == 2; }));
  gate_->thread().ask([&] {
    EXPECT_EQ(handovers_, 2U);
    EXPECT_EQ(heard_, (std::vector<bool>{true, false, true, false}));
  });
}

// It has sent no zero itself.
TEST_F(CommandGateTest, AVehicleWhoseJoystickWasKilledGetsAZero) {
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_TRUE(takeOver(true));
  ASSERT_TRUE(sentIn(3).empty());
  ASSERT_TRUE(test::waitFor([&] { return !gate_->isManual(); }));
  gate_->thread().ask([] {});
  const auto all = sentIn(1);
  gate_->thread().ask([&] {
    ASSERT_EQ(sent_.size(), 1U);
    EXPECT_TRUE(sent_.front().isZero());
    EXPECT_EQ(handovers_, 2U);
  });
}

TEST_F(CommandGateTest, ATickThatThrowsStopsTheVehicle) {
  ASSERT_NO_FATAL_FAILURE(start());
  driveOn(true);
  ASSERT_EQ(sentIn(2).size(), 2U);
  gate_->thread().ask([&] { throws_ = true; });
  EXPECT_TRUE(commands_.waitFor(0, test::stands));
  gate_->thread().ask([&] { throws_ = false; });
  gate_->thread().ask([&] { EXPECT_GE(given_up_, 1); });
  EXPECT_EQ(sentIn(2).size(), 2U) << "and the next goes on";
}

TEST_F(CommandGateTest, SaysWhyTheVehicleStands) {
  ASSERT_NO_FATAL_FAILURE(start());
  gate_->thread().ask([&] { gate_->setSchedule({50.0, 0}); });
  EXPECT_TRUE(test::waitFor([&] { return !gate_->problem(0.0); }));
  const auto says = [&](const std::string& text) {
    return test::waitFor([&] {
      const auto why = gate_->problem(0.0);
      return why && why->find(text) != std::string::npos;
    });
  };
  ASSERT_TRUE(stop(true));
  EXPECT_TRUE(says("stopped by the topic /stop"));
  ASSERT_TRUE(stop(false));
  sky_.clock_runs = false;
  EXPECT_TRUE(says("ROS time stands still"));
  sky_.clock_runs = true;
  EXPECT_TRUE(test::waitFor([&] { return !gate_->problem(0.0); }));
}

TEST_F(CommandGateTest, AJoystickOfItsOwnIsNotYieldedTo) {
  ASSERT_NO_FATAL_FAILURE(start(CommandGate::Joystick::OWN));
  driveOn(true);
  EXPECT_EQ(sentIn(3).size(), 3U);
  ASSERT_TRUE(stop(true));
  for (const BodyVelocity& velocity : sentIn(3)) EXPECT_TRUE(velocity.isZero());
}

}  // namespace
}  // namespace grid_path_planner::nodes
