// What follows what between a goal and its result: told as tables of events and orders.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "following/navigator_story.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::following {
namespace {

using path::Path;
using test::Story;
using test::straight;
using test::withSteps;

using Table = std::vector<std::pair<const char*, const char*>>;

void expectOrders(Story& story, const Table& table) {
  for (const auto& [event, orders] : table) EXPECT_EQ(story.after(event), orders) << event;
}

TEST(Navigator, PlansDrivesAndArrives) {
  Story story;
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 7", "DRIVE(7,0)"},
                       {"drives 5", ""},
                       {"end:ARRIVED", "SUCCEED"},
                       {"seconds 20", ""}});
  EXPECT_EQ(story.last_sentence, "ARRIVED: so it ended");
  EXPECT_EQ(story.navigator.state(), NavigatorState::IDLE);
}

TEST(Navigator, PlansAgainWhileItDrivesAndKeepsAPathThatIsAboutAsLong) {
  Story story;
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 20", "DRIVE(20,0)"},
                       {"drives 19", ""},
                       {"seconds 2.1", "PLAN"},
                       {"FOUND 18.5", ""},  // about what is left
                       {"seconds 2.1", "PLAN"},
                       {"FOUND 30", "DRIVE(30,0)"},  // what is left must be blocked somewhere
                       {"drives 29", ""},
                       {"seconds 2.1", "PLAN"},
                       {"FOUND 15", "DRIVE(15,0)"},  // a door was opened
                       {"drives 14", ""},
                       {"seconds 2.1", "PLAN"},
                       {"TIMEOUT", ""},  // no verdict: it drives on
                       {"drives 13", ""},
                       {"seconds 2.1", "PLAN"},
                       {"CANCELLED", ""},
                       {"end:ARRIVED", "SUCCEED"}});
}

TEST(Navigator, PlansFromWhereThePoseJumpedTo) {
  Story story;
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 20", "DRIVE(20,0)"},
                       {"drives 14", ""},
                       {"end:POSE_JUMP", "PLAN"},
                       {"FOUND 25", "DRIVE(25,0)"},
                       {"end:ARRIVED", "SUCCEED"}});
}

TEST(Navigator, EndsAtAVehicleThatDoesNotGoSideways) {
  Story story;
  expectOrders(story,
               {{"start", "PLAN"}, {"FOUND 20", "DRIVE(20,0)"}, {"end:WRONG_DRIVE", "ABORT"}});
}

// At eight times the speed of the wall clock the driver's feedback was metres old, and every path seemed another one.
TEST(Navigator, WhatWasDrivenSinceTheFeedbackIsNoOtherPath) {
  Story story;
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 20", "DRIVE(20,0)"},
                       {"at 5", ""},
                       {"drives 15", ""},
                       {"at 9", ""},
                       {"seconds 2.1", "PLAN"}});
  Path rest = straight(20);
  rest.poses[0].position.x() = 9.0;
  story.navigator.planned({base::Status::FOUND, "a path", rest}, story.now);
  EXPECT_EQ(story.after("seconds 0.1"), "");
}

TEST(Navigator, WithoutAReplanPeriodPlansOnlyWhereThePathIsBlocked) {
  NavigatorOptions options;
  options.replan_period = 0.0;
  Story story(options);
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 20", "DRIVE(20,0)"},
                       {"drives 19", ""},
                       {"seconds 30", ""},
                       {"obstructed 12", ""},
                       {"seconds 0.05", "PLAN"},
                       {"FOUND 12.1", "DRIVE(12.1,0)"}});  // another path is as long
}

// A planner with a smaller radius than the driver's check finds a path through the same gap, again and again.
TEST(Navigator, APathThatStaysBlockedThoughPathsAreFoundIsGivenUp) {
  Story story(withSteps("wait"));
  expectOrders(story, {{"start", "PLAN"}, {"FOUND 20", "DRIVE(20,0)"}, {"obstructed 10", ""}});
  int drives = 0;
  for (int i = 0; i < 100 && story.navigator.state() == NavigatorState::DRIVING; ++i) {
    if (story.after("seconds 0.2") == "PLAN") drives += story.after("FOUND 10") != "";
    if (story.navigator.state() == NavigatorState::DRIVING) story.after("obstructed 10");
  }
  EXPECT_EQ(drives, 2);
  EXPECT_EQ(story.navigator.step(), "wait");
  EXPECT_NEAR(story.now, 110.0, 0.5);
}

TEST(Navigator, NoStopByAHandIsTakenForAnObstacle) {
  for (const char* state : {"held 10", "paused 10"}) {
    Story story;
    expectOrders(story, {{"start", "PLAN"},
                         {"FOUND 20", "DRIVE(20,0)"},
                         {state, ""},
                         {"seconds 3600", ""},
                         {"drives 10", ""},
                         {"end:ARRIVED", "SUCCEED"}});
  }
}

TEST(Navigator, UnreachableIsAbortedWithThePlannersSentenceAfterEveryStep) {
  Story story;
  expectOrders(story, {{"start", "PLAN"},
                       {"UNREACHABLE", ""},  // waits; nothing was driven that it could drive back
                       {"seconds 4.9", ""},
                       {"seconds 0.2", "PLAN"},
                       {"at 0", ""},
                       {"UNREACHABLE", "DRIVE(0,1.6)"},
                       {"end:ARRIVED", "DRIVE(0,1.6)"},
                       {"end:ARRIVED", "DRIVE(0,1.6)"},
                       {"end:ARRIVED", "DRIVE(0,1.6)"},
                       {"end:ARRIVED", "PLAN"},
                       {"UNREACHABLE", "ABORT"}});
  EXPECT_EQ(story.last_sentence, "UNREACHABLE: so it was answered");
  const std::vector<std::string> told = {
      "UNREACHABLE: so it was answered; recovery 1 of 3: wait",
      "UNREACHABLE: so it was answered; recovery 2 of 3: back_off",
      "back_off is left out: nothing was driven that it could drive back",
      "UNREACHABLE: so it was answered; recovery 3 of 3: turn_and_look"};
  EXPECT_EQ(story.told, told);
}

TEST(Navigator, WhatCannotBecomeBetterIsAbortedAtOnce) {
  for (const char* status : {"INVALID_REQUEST", "GOAL_OUTSIDE_MAP", "NO_ANSWER"}) {
    Story story;
    expectOrders(story, {{"start", "PLAN"}, {status, "ABORT"}, {"seconds 60", ""}});
  }
  Story story(withSteps(""));
  expectOrders(story, {{"start", "PLAN"}, {"GOAL_OCCUPIED", "ABORT"}});
}

TEST(Navigator, BacksOffAlongTheDrivenPathAndPlansAgain) {
  Story story(withSteps("back_off"));
  expectOrders(story, {{"start", "PLAN"}, {"FOUND 20", "DRIVE(20,0)"}});
  for (int i = 0; i <= 24; ++i) story.navigator.moved({{0.125 * i, 0.0, 0.0}, 0.0});
  expectOrders(story, {{"drives 17", ""},
                       {"end:NO_PROGRESS", "DRIVE(2,0)"},
                       {"end:NO_PROGRESS", "PLAN"},  // it may have helped all the same
                       {"FOUND 18", "DRIVE(18,0)"}});
}

TEST(Navigator, AStepIsTriedAgainOnlyNearerToTheGoal) {
  Story story(withSteps("wait"));
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 20", "DRIVE(20,0)"},
                       {"drives 15", ""},
                       {"end:NO_PROGRESS", ""},
                       {"seconds 5.1", "PLAN"},
                       {"FOUND 15", "DRIVE(15,0)"},
                       {"drives 10", ""},
                       {"end:NO_PROGRESS", ""},  // nearer: it waits once more
                       {"seconds 5.1", "PLAN"},
                       {"FOUND 10", "DRIVE(10,0)"},
                       {"drives 9.8", ""},
                       {"end:NO_PROGRESS", "ABORT"}});
}

TEST(Navigator, PlansWithToleranceOnlyWhereItIsAskedTo) {
  Story story(withSteps("plan_with_tolerance"));
  expectOrders(story, {{"start", "PLAN"},
                       {"GOAL_OCCUPIED", "PLAN~0.5"},
                       {"FOUND 4", "DRIVE(4,0)"},
                       {"drives 3", ""},
                       {"seconds 2.1", "PLAN~0.5"},
                       {"FOUND 3", ""},
                       {"end:ARRIVED", "SUCCEED"}});
  EXPECT_EQ(story.last_sentence, "ARRIVED: so it ended; a path") << "says that it is not the goal";
}

TEST(Navigator, ClearsTheLasersObstaclesOnlyWhereItIsAskedTo) {
  Story story(withSteps("clear_scan"));
  expectOrders(story, {{"start", "PLAN"},
                       {"UNREACHABLE", "CLEAR_SCAN"},
                       {"seconds 0.9", ""},  // in which the map comes without them
                       {"seconds 0.2", "PLAN"},
                       {"FOUND 4", "DRIVE(4,0)"},
                       {"end:ARRIVED", "SUCCEED"},
                       {"start", "PLAN"},
                       {"UNREACHABLE", "CLEAR_SCAN"},
                       {"seconds 1.1", "PLAN"},
                       {"UNREACHABLE", "ABORT"}});
  EXPECT_EQ(NavigatorOptions().recovery_steps.find("clear"), std::string::npos) << "off by default";
}

TEST(Navigator, AGoalThatIsGoneStopsTheVehicle) {
  Story story(withSteps("wait"));
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 20", "DRIVE(20,0)"},
                       {"drives 19", ""},
                       {"seconds 2.1", "PLAN"},
                       {"GOAL_OCCUPIED", "STOP"},
                       {"end:CANCELLED", ""},  // of the drive that was stopped
                       {"seconds 5.1", "PLAN"},
                       {"FOUND 15", "DRIVE(15,0)"}});
}

TEST(Navigator, EndsAfterTheDriverHasStopped) {
  Story story;
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 7", "DRIVE(7,0)"},
                       {"cancel", "STOP"},
                       {"seconds 1", ""},
                       {"cancel", ""},
                       {"end:CANCELLED", "PREEMPT"}});
  EXPECT_EQ(story.last_sentence, "cancelled by whoever has sent the goal");
  EXPECT_EQ(story.navigator.sentence(), "cancelled by whoever has sent the goal");
  expectOrders(
      story,
      {{"start", "PLAN"}, {"FOUND 7", "DRIVE(7,0)"}, {"abort", "STOP"}, {"seconds 2.1", "ABORT"}});
  EXPECT_EQ(story.last_sentence, "the clock jumped; the driver has not said that it stopped");
}

TEST(Navigator, IsCancelledInEveryState) {
  const std::vector<Table> befores = {
      {},
      {{"UNREACHABLE", ""}},                             // waits
      {{"at 0", ""}, {"FOUND 7", "DRIVE(7,0)"}},         // drives
      {{"CANCELLED", ""}},                               // another's request took the place
      {{"FOUND 7", "DRIVE(7,0)"}, {"obstructed 3", ""}}  // stands
  };
  for (const Table& before : befores) {
    Story story;
    story.after("start");
    expectOrders(story, before);
    std::string orders = story.after("cancel");
    if (orders.find("STOP") != std::string::npos) orders += story.after("end:CANCELLED");
    EXPECT_EQ(orders.substr(orders.size() - 7), "PREEMPT");
    EXPECT_EQ(story.after("seconds 60"), "");
  }
}

TEST(Navigator, ACancelDuringRecoveryStopsTheRecovery) {
  Story story(withSteps("turn_and_look"));
  expectOrders(story, {{"at 0", ""},
                       {"start", "PLAN"},
                       {"UNREACHABLE", "DRIVE(0,1.6)"},
                       {"cancel", "STOP"},
                       {"end:CANCELLED", "PREEMPT"},
                       {"seconds 60", ""}});
}

TEST(Navigator, WhoCancelsTheDriveIsObeyed) {
  Story story;
  expectOrders(story, {{"start", "PLAN"}, {"FOUND 7", "DRIVE(7,0)"}, {"end:CANCELLED", "ABORT"}});
}

TEST(Navigator, ADriverThatWasStartedAgainGetsANewPath) {
  Story story(withSteps("wait"));
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 7", "DRIVE(7,0)"},
                       {"end:NO_ANSWER", ""},
                       {"seconds 5.1", "PLAN"},
                       {"FOUND 6", "DRIVE(6,0)"},
                       {"end:NO_ANSWER", ""},  // a metre nearer
                       {"seconds 5.1", "PLAN"},
                       {"FOUND 6", "DRIVE(6,0)"},
                       {"end:NO_ANSWER", "ABORT"}});
}

TEST(Navigator, AnotherClientOfThePlannerDelaysIt) {
  Story story;
  expectOrders(
      story,
      {{"start", "PLAN"}, {"CANCELLED", ""}, {"seconds 0.3", "PLAN"}, {"FOUND 7", "DRIVE(7,0)"}});
  Story starved;
  starved.after("start");
  std::string orders;
  for (int i = 0; i < 100 && orders != "ABORT"; ++i) {
    orders = starved.after("CANCELLED");
    starved.after("seconds 0.3");
  }
  EXPECT_EQ(orders, "ABORT");
}

TEST(Navigator, AnotherGoalStopsTheVehicleUntilThereIsAPathToIt) {
  Story story;
  expectOrders(story, {{"start", "PLAN"},
                       {"FOUND 7", "DRIVE(7,0)"},
                       {"start", "STOP PLAN"},
                       {"end:CANCELLED", ""},
                       {"FOUND 3", "DRIVE(3,0)"},
                       {"end:ARRIVED", "SUCCEED"}});
}

TEST(Navigator, RefusesStepsThatItDoesNotHave) {
  EXPECT_THROW(Navigator(withSteps("wait, dance")), base::InputError);
  EXPECT_THROW(Navigator(withSteps("wait,,back_off")), base::InputError);
  EXPECT_EQ(recoverySteps(" wait ,wait").size(), 2U);
  EXPECT_TRUE(recoverySteps("  ").empty());
}

}  // namespace
}  // namespace grid_path_planner::following
