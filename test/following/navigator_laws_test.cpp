// What holds of a navigator whatever comes, late, twice and out of turn.
#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "following/navigator_story.h"

namespace grid_path_planner::following {
namespace {

using test::Story;
using test::withSteps;

// An outside world that answers at random, late, twice and out of turn.
class RandomWorld {
 public:
  explicit RandomWorld(unsigned seed)
      : random_(seed),
        story_(withSteps("wait, back_off, turn_and_look, "
                         "plan_with_tolerance")) {}

  void run(int events) {
    for (int i = 0; i < events; ++i) judge(story_.after(event()));
  }
  // Answers as a world does in which no goal can be reached; whether the goal ends.
  bool endsInAHopelessWorld() {
    story_.after("drop");
    driving_ = false;
    running_ = true;
    judge(story_.after("start"));
    for (int i = 0; i < 2000 && running_; ++i) {
      judge(story_.after("UNREACHABLE"));
      driving_ = false;
      judge(story_.after(random_() % 2 == 0 ? "end:ARRIVED" : "end:NO_PROGRESS"));
      judge(story_.after("seconds 1"));
    }
    return !running_;
  }

 private:
  std::string event() {
    static const std::vector<std::string> events = {
        "start",        "cancel",        "abort",         "drop",
        "FOUND 5",      "FOUND 9",       "UNREACHABLE",   "TIMEOUT",
        "CANCELLED",    "GOAL_OCCUPIED", "at 1",          "at 3",
        "drives 8",     "drives 4",      "drives nan",    "paused 4",
        "held 4",       "obstructed 4",  "seconds 0.2",   "seconds 1.5",
        "seconds 12",   "end:ARRIVED",   "end:CANCELLED", "end:NO_PROGRESS",
        "end:NO_ANSWER"};
    const std::string chosen = events[random_() % events.size()];
    if (chosen == "start" || chosen == "drop") starting_ = chosen;
    if (chosen.rfind("end:", 0) == 0) driving_ = false;  // none goes on now
    return chosen;
  }

  // A goal ends once and only where there is one; nobody drives without a goal.
  void judge(const std::string& orders) {
    if (const std::string began = std::exchange(starting_, ""); !began.empty())
      running_ = began == "start";
    std::istringstream words(orders);
    for (std::string word; words >> word;) {
      const bool ends = word == "SUCCEED" || word == "ABORT" || word == "PREEMPT";
      if (word.rfind("DRIVE", 0) == 0) {
        EXPECT_TRUE(running_) << orders;
        driving_ = true;
      }
      if (word.rfind("PLAN", 0) == 0) {
        EXPECT_TRUE(running_) << orders;
      }
      if (word == "STOP") driving_ = false;
      if (!ends) continue;
      EXPECT_TRUE(running_) << orders << ": an end without a goal, or a second one";
      EXPECT_FALSE(driving_) << orders << ": it ends while the vehicle is driven";
      running_ = false;
    }
    EXPECT_EQ(running_, story_.navigator.state() != NavigatorState::IDLE) << orders;
  }

  std::mt19937 random_;
  Story story_;
  std::string starting_;
  bool running_ = false, driving_ = false;
};

TEST(NavigatorLaws, EveryGoalEndsOnceAndNobodyDrivesWithoutOne) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    RandomWorld world(seed);
    world.run(300);
    if (HasFailure()) return;
  }
}

TEST(NavigatorLaws, RecoveriesEnd) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    RandomWorld world(seed);
    world.run(50);
    EXPECT_TRUE(world.endsInAHopelessWorld()) << seed;
  }
}

}  // namespace
}  // namespace grid_path_planner::following
