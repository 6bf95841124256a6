// ROS time that comes late, that goes back, and that several threads read.
#include "ros/guard/node_time.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>

#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ros/guard/guarded_queue.h"
#include "ros/guard/scheduling/control_thread.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

// ROS time is that of /clock, which here comes from the tests.
class SimulatedClock {
 protected:
  SimulatedClock() {
    ros::Time::init();
    setClock(100.0);
    NodeTime();  // so that time that goes back from that of another test is known
  }
  ~SimulatedClock() { ros::Time::init(); }

  static void setClock(double seconds) { ros::Time::setNow(ros::Time(seconds)); }
};

class NodeTimeTest : private SimulatedClock, public testing::Test {
 protected:
  using SimulatedClock::setClock;

  void note(const std::string& what) { noted_.push_back(what); }
  void callback() {
    queue_.addCallback(callbackOf([this] { note("callback"); }));
    behind_.callAvailable();
  }

  ros::CallbackQueue behind_;
  GuardedQueue queue_{behind_};
  NodeTime& time_ = queue_.time();
  std::vector<std::string> noted_;
};

using Noted = std::vector<std::string>;

// onSimpleGoal() of go_to_pose asked no clock: a goal of the new time that came right after /clock had gone back was driven to
// by the transforms of the old one, and then aborted.
TEST_F(NodeTimeTest, ACallbackThatMeetsAJumpBeginsAfterTheListenersInTheirOrder) {
  const auto first = time_.onJumpBack([&](double seconds) {
    note("first by " + std::to_string(seconds));
    EXPECT_EQ(time_.since(), ros::Time(93.0));
  });
  const auto second = time_.onJumpBack([&](double) { note("second"); });
  callback();
  setClock(93.0);
  callback();
  callback();
  EXPECT_EQ(noted_, (Noted{"callback", "first by 7.000000", "second", "callback", "callback"}));
}

TEST_F(NodeTimeTest, EachJumpIsTold) {
  int jumps = 0;
  const auto listening = time_.onJumpBack([&](double) { ++jumps; });
  for (const double now : {50.0, 60.0, 20.0, 19.999, 19.999, 70.0}) {
    setClock(now);
    callback();
  }
  EXPECT_EQ(jumps, 3);
}

// A callback of three seconds, in which time went two seconds back: when the next began it was later than before it.
TEST_F(NodeTimeTest, AJumpThatAnotherThreadFoundIsToldThoughTimeHasPassedTheOldOneAgain) {
  int jumps = 0;
  const auto listening = time_.onJumpBack([&](double seconds) {
    ++jumps;
    EXPECT_NEAR(seconds, 2.0, 1e-5);
  });
  callback();
  setClock(98.0);
  NodeTime().tellJumps();  // as tf's queue, or another nodelet's
  setClock(101.0);
  callback();
  EXPECT_EQ(jumps, 1);
  EXPECT_EQ(time_.since(), ros::Time(98.0)) << "not when it was told";
}

TEST_F(NodeTimeTest, EachQueueOfAProcessIsToldOnce) {
  ros::CallbackQueue other_behind;
  GuardedQueue other(other_behind);
  int here = 0, there = 0;
  const auto listening = time_.onJumpBack([&](double) { ++here; });
  const auto other_listening = other.time().onJumpBack([&](double) { ++there; });
  setClock(1.0);
  callback();
  EXPECT_EQ(std::pair(here, there), std::pair(1, 0));
  other.addCallback(callbackOf([] {}));
  other_behind.callAvailable();
  callback();
  EXPECT_EQ(std::pair(here, there), std::pair(1, 1));
  NodeTime begins_now;
  const auto now_listening = begins_now.onJumpBack([&](double) { ++here; });
  begins_now.tellJumps();
  EXPECT_EQ(here, 1) << "it has nothing to be told";
}

TEST_F(NodeTimeTest, AListenerThatThrowsKeepsNoOtherFromBeingTold) {
  const auto first = time_.onJumpBack([](double) { throw std::runtime_error("no memory"); });
  const auto second = time_.onJumpBack([&](double) { note("second"); });
  setClock(1.0);
  callback();
  EXPECT_EQ(noted_, (Noted{"second", "callback"}));
}

TEST_F(NodeTimeTest, AListenerMayEndItsListeningAndAddOthers) {
  std::shared_ptr<void> first, later;
  first = time_.onJumpBack([&](double) {
    note("first");
    first.reset();
    later = time_.onJumpBack([&](double) { note("later"); });
  });
  const auto second = time_.onJumpBack([&](double) { note("second"); });
  setClock(1.0);
  callback();
  setClock(0.5);
  callback();
  EXPECT_EQ(noted_, (Noted{"first", "second", "later", "callback", "second", "later", "callback"}));
}

TEST_F(NodeTimeTest, AJumpWhileTheQueueHoldsIsToldBeforeTheFirstThatItHeld) {
  const auto listening = time_.onJumpBack([&](double) { note("jump"); });
  queue_.hold();
  callback();
  setClock(1.0);
  callback();
  EXPECT_TRUE(noted_.empty());
  queue_.release();
  behind_.callAvailable();
  EXPECT_EQ(noted_, (Noted{"jump", "callback", "callback"}));
}

// Four threads serve the queue while the clock goes on, and back after every thousandth step.
TEST_F(NodeTimeTest, HoweverManyThreadsServeTheQueueEachJumpIsToldOnceAndBeforeAnyCallback) {
  constexpr int kJumps = 200, kThreads = 4;
  setClock(10.0);
  callback();
  std::atomic<int> jumps{0}, too_early{0}, at_jump{0};
  std::atomic<bool> done{false};
  const auto first = time_.onJumpBack([](double) { std::this_thread::yield(); });
  const auto second = time_.onJumpBack([&](double) { ++jumps; });
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i)
    threads.emplace_back([&] {
      while (!done) {
        const int before =
            at_jump;  // the clock after this jump was there before the callback began
        queue_.addCallback(callbackOf([&, before] { too_early += jumps < before; }));
        behind_.callOne();
      }
    });
  for (int jump = 1; jump <= kJumps; ++jump) {
    for (int step = 1; step < 1000; ++step) setClock(10.0 + 1e-3 * step);
    NodeTime().tellJumps();  // this time was seen
    setClock(10.0);
    at_jump = jump;
    EXPECT_TRUE(test::waitFor([&] { return jumps >= jump; }));
  }
  done = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(jumps, kJumps);
  EXPECT_EQ(too_early, 0);
}

// Beside the machine's own clock, which goes on meanwhile: a time that one thread had read before another's was taken for a
// jump, and path_planner, of which two threads ask, forgot tf and the start pose, twice in a minute of load.
TEST(NodeTime, TimeThatSeveralThreadsReadDoesNotGoBack) {
  ros::Time::init();
  NodeTime time;
  std::atomic<int> jumps{0};
  const auto listening = time.onJumpBack([&](double) { ++jumps; });
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int call = 0; call < 200000; ++call) time.tellJumps();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(jumps, 0);
}

// It commands a vehicle while others tell of a jump, however long that takes.
TEST_F(NodeTimeTest, AThreadThatCommandsIsToldBeforeItsNextWorkAndWaitsForNobody) {
  int jumps = 0;
  std::atomic<bool> other_tells{false}, may_end{false};
  ControlThread control([] {}, [] {}, [&](double) { ++jumps; });
  const auto slow = time_.onJumpBack([&](double) {
    other_tells = true;
    while (!may_end) std::this_thread::yield();
  });
  control.start(1000.0, 0);
  setClock(1.0);
  std::thread serves([&] { callback(); });
  EXPECT_TRUE(test::waitFor([&] { return other_tells.load(); }));
  EXPECT_EQ(control.ask([&] { return jumps; }), 1);
  may_end = true;
  serves.join();
  control.stop();
  EXPECT_EQ(jumps, 1);
}

TEST_F(NodeTimeTest, TheEndOfListeningWaitsForACallThatRuns) {
  std::atomic<bool> begins{false}, may_end{false};
  bool is_over = false;
  auto listening = time_.onJumpBack([&](double) {
    begins = true;
    while (!may_end) std::this_thread::yield();
    is_over = true;
  });
  setClock(1.0);
  std::thread serves([&] { callback(); });
  EXPECT_TRUE(test::waitFor([&] { return begins.load(); }));
  std::thread ends([&] {
    listening.reset();
    EXPECT_TRUE(is_over);
  });
  may_end = true;
  ends.join();
  serves.join();
}

// A message on /clock of which no node is to end.
TEST_F(NodeTimeTest, AClockAtTheEndOfTimeIsOneThatGoesBackFromThere) {
  double back = 0.0;
  const auto listening = time_.onJumpBack([&](double seconds) { back = seconds; });
  ros::Time last;
  last.sec = 4'294'967'295;
  last.nsec = 4'294'967'295;
  for (const ros::Time& end : {ros::Time(4'294'967'295, 900'000'000), ros::TIME_MAX, last}) {
    ros::Time::setNow(end);
    callback();
    EXPECT_TRUE(time_.problemWith(ros::Time(99.0)));
    EXPECT_FALSE(time_.problemWith(NodeTime::now()));
    setClock(100.0);
    callback();
    EXPECT_NEAR(back, 4'294'967'195.9, 0.2);
    EXPECT_EQ(time_.since(), ros::Time(100.0));
    EXPECT_TRUE(time_.problemWith(end));
  }
}

TEST_F(NodeTimeTest, BeginsWithTheFirstTimeThatThereIs) {
  setClock(6.0);
  NodeTime();
  setClock(0.0);  // use_sim_time, and no /clock yet
  NodeTime time;
  int jumps = 0;
  const auto listening = time.onJumpBack([&](double) { ++jumps; });
  time.tellJumps();
  EXPECT_FALSE(time.isThere());
  EXPECT_EQ(time.now(), ros::Time());
  EXPECT_EQ(time.since(), ros::Time());
  EXPECT_EQ(time.problemWith(ros::Time(5.0)), "there is no ROS time yet");
  setClock(7.0);
  time.tellJumps();
  EXPECT_TRUE(time.isThere());
  EXPECT_EQ(time.since(), ros::Time(7.0));
  setClock(0.0);  // as while a simulator is started anew
  time.tellJumps();
  EXPECT_EQ(jumps, 0) << "no time is not an earlier one";
  setClock(1.0);
  time.tellJumps();
  EXPECT_EQ(jumps, 1);
}

TEST_F(NodeTimeTest, SaysWhatIsWrongWithAStamp) {
  EXPECT_EQ(time_.problemWith(ros::Time()), "it has no stamp");
  EXPECT_EQ(time_.problemWith(ros::Time(100.0)), std::nullopt);
  EXPECT_EQ(time_.problemWith(ros::Time(110.0)), std::nullopt) << "as clocks of nodes differ";
  EXPECT_EQ(time_.problemWith(ros::Time(111.0)), "that is 11 s ahead of the time here");
  EXPECT_EQ(time_.problemWith(ros::Time(99.0)), "the node started at 100.000000000");
  setClock(5.0);
  callback();
  setClock(8.0);
  EXPECT_EQ(time_.problemWith(ros::Time(4.0)), "ROS time went back, to 5.000000000");
  EXPECT_EQ(time_.problemWith(ros::Time(6.0)), std::nullopt);
  EXPECT_EQ(time_.problemWith(ros::Time(99.0)), "that is 91 s ahead of the time here");
}

}  // namespace
}  // namespace grid_path_planner::nodes
