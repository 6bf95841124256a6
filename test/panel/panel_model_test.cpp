#include "panel/panel_model.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "panel/pose_at.h"

namespace grid_path_planner::panel {
namespace {

using test::poseAt;
using Kind = RoutePoints::Kind;

PlanAnswer answerOf(const std::string& status) {
  PlanAnswer answer;
  answer.status = status;
  answer.message = "the sentence";
  answer.figures.planner = "a_star";
  if (answer.found()) answer.path.poses = {poseAt(0, 0), poseAt(1, 0)};
  return answer;
}

class PanelModelTest : public testing::Test {
 protected:
  // As "PCE DPRX S": plan, compare, explain, drive, pause, resume, cancel, save; '-': not now.
  std::string pressable() const {
    const Buttons may = model_.buttons();
    std::string text;
    const auto add = [&](bool on, char name) { text += on ? name : '-'; };
    add(may.plan, 'P');
    add(may.compare, 'C');
    add(may.explain, 'E');
    add(may.drive, 'D');
    add(may.pause, 'U');
    add(may.resume, 'R');
    add(may.cancel, 'X');
    add(may.save, 'S');
    return text;
  }
  void setGoal(double x = 5.0) { model_.place({Kind::GOAL, 0}, "map", poseAt(x, 0)); }
  void bothNodes() {
    model_.setPlanners(1);
    model_.setDrivers(1);
  }
  void planAndFind() {
    model_.plan();
    const auto request = model_.tick(0.0);
    ASSERT_TRUE(request);
    model_.planAnswered(request->id, answerOf("FOUND"), 0.0);
  }

  PanelModel model_;
};

TEST_F(PanelModelTest, WhatMayBePressed) {
  EXPECT_EQ(pressable(), "--------") << "no nodes";
  setGoal();
  EXPECT_EQ(pressable(), "--------") << "a goal for nobody";
  model_.setPlanners(1);
  EXPECT_EQ(pressable(), "PCE-----");
  model_.setDrivers(1);
  EXPECT_EQ(pressable(), "PCE-URX-") << "another's drive can be paused and cancelled";
  model_.plan();
  EXPECT_EQ(pressable(), "P---URX-") << "planning";
  planAndFind();
  EXPECT_EQ(pressable(), "PCEDURXS") << "found";
  model_.driveSent("1", 0.0);
  EXPECT_EQ(pressable(), "PCE-U-XS") << "driving";
  model_.driveHeard("1", {"paused", 1, 3.0, 0.0}, 0.0);
  EXPECT_EQ(pressable(), "PCE--RXS") << "paused";
  model_.driveEnded("1", true, "ARRIVED", "there");
  EXPECT_EQ(pressable(), "PCEDURXS");
  model_.clear();
  EXPECT_EQ(pressable(), "----URX-");
}

TEST_F(PanelModelTest, NoNodeIsAskedTwiceAtOnce) {
  bothNodes();
  setGoal();
  model_.callBegan(Call::COMPARE);
  EXPECT_EQ(pressable(), "P---URX-");
  model_.callEnded(Tone::BAD, "path_planner has not answered for 60 s");
  EXPECT_EQ(pressable(), "PCE-URX-");
  EXPECT_EQ(model_.tone(), Tone::BAD);
}

TEST_F(PanelModelTest, SaysWhatThePlannerSaid) {
  bothNodes();
  setGoal();
  model_.plan();
  const auto request = model_.tick(0.0);
  EXPECT_EQ(model_.tone(), Tone::BUSY);
  model_.planHeard(request->id, "searching", 0.1);
  EXPECT_EQ(model_.sentence(), "Planning: searching ...");
  model_.planAnswered(request->id, answerOf("UNREACHABLE"), 0.2);
  EXPECT_EQ(model_.sentence(), "UNREACHABLE: the sentence");
  EXPECT_EQ(model_.tone(), Tone::BAD);
  EXPECT_TRUE(model_.path().empty()) << "a failure takes the old path away";
}

TEST_F(PanelModelTest, APlanFollowsItsPointsOnceThereIsOne) {
  bothNodes();
  setGoal();
  EXPECT_FALSE(model_.tick(0.0)) << "nobody pressed Plan";
  planAndFind();
  setGoal(6.0);
  const auto request = model_.tick(0.0);
  ASSERT_TRUE(request);
  EXPECT_EQ(request->points.goal()->position.x(), 6.0);
  model_.planAnswered(request->id, answerOf("FOUND"), 0.0);
  model_.planAgain();
  EXPECT_TRUE(model_.tick(0.0)) << "a parameter changed";
}

TEST_F(PanelModelTest, TheBestOrderIsPlannedForAtOnceWhereThereIsOne) {
  bothNodes();
  setGoal();
  model_.setBestOrder(true);
  EXPECT_FALSE(model_.tick(0.0)) << "nobody pressed Plan";
  planAndFind();
  model_.setBestOrder(false);
  EXPECT_FALSE(model_.tick(0.0)) << "without via-points there is one order";
  for (int i = 0; i < 2; ++i) model_.addVia("map", poseAt(1, i));
  auto request = model_.tick(0.0);
  ASSERT_TRUE(request);
  EXPECT_FALSE(request->best_order);
  model_.planAnswered(request->id, answerOf("FOUND"), 0.0);
  model_.setBestOrder(true);
  request = model_.tick(0.0);
  ASSERT_TRUE(request);
  EXPECT_TRUE(request->best_order);
}

TEST_F(PanelModelTest, APlannerThatDiesLosesTheRequestAndSaysSo) {
  bothNodes();
  setGoal();
  model_.plan();
  const auto request = model_.tick(0.0);
  model_.setPlanners(0);
  EXPECT_EQ(model_.tone(), Tone::BAD);
  EXPECT_EQ(pressable(), "----URX-");
  model_.setPlanners(1);  // restarted: it knows nothing of the request
  EXPECT_FALSE(model_.tick(1.0));
  model_.planAnswered(request->id, answerOf("FOUND"), 1.0);
  EXPECT_TRUE(model_.path().empty());
  planAndFind();
  EXPECT_EQ(model_.tone(), Tone::GOOD);
}

TEST_F(PanelModelTest, APlannerThatFallsSilentIsGivenUp) {
  bothNodes();
  setGoal();
  model_.plan();
  ASSERT_TRUE(model_.tick(0.0));
  EXPECT_FALSE(model_.tick(RoutePlanning::kPatience + 1.0));
  EXPECT_EQ(model_.sentence(), "TIMEOUT: path_planner has not answered for 10 s");
  EXPECT_EQ(pressable(), "PCE-URX-");
}

TEST_F(PanelModelTest, CancelledPlansAreNotShown) {
  bothNodes();
  setGoal();
  model_.plan();
  const auto request = model_.tick(0.0);
  EXPECT_EQ(model_.cancelPlan(), request->id);
  EXPECT_EQ(model_.cancelPlan(), 0U);
  model_.planAnswered(request->id, answerOf("FOUND"), 0.0);
  EXPECT_TRUE(model_.path().empty());
}

TEST_F(PanelModelTest, ADriverThatDiesEndsTheDrive) {
  bothNodes();
  model_.driveSent("1", 0.0);
  model_.setDrivers(0);
  EXPECT_EQ(model_.driveText(), "LOST");
  EXPECT_EQ(model_.tone(), Tone::BAD);
}

// It was driving for ever, and Drive could not be pressed any more.
TEST_F(PanelModelTest, ADriverThatFallsSilentIsLostUntilItSpeaks) {
  bothNodes();
  setGoal();
  planAndFind();
  model_.driveSent("1", 0.0);
  model_.driveHeard("1", {"driving", 1, 3.0, 0.0}, 1.0);
  model_.tick(1.0 + PanelModel::kPatienceWithDrives);
  EXPECT_EQ(pressable(), "PCE-U-XS") << "driving";
  model_.tick(1.1 + PanelModel::kPatienceWithDrives);
  EXPECT_EQ(model_.driveText(), "LOST");
  EXPECT_EQ(model_.tone(), Tone::BAD);
  EXPECT_EQ(pressable(), "PCEDURXS");
  model_.driveHeard("1", {"driving", 1, 2.0, 0.0}, 20.0);
  EXPECT_EQ(pressable(), "PCE-U-XS") << "it was stopped, and goes on";
}

TEST_F(PanelModelTest, ADriveOfAnotherVehicleIsNotShown) {
  bothNodes();
  setGoal();
  planAndFind();
  model_.driveHeard("1", {"driving", 1, 3.0, 0.0}, 1.0);
  model_.leaveDriver();
  EXPECT_EQ(model_.driveText(), "no drive is reported");
  EXPECT_EQ(model_.progress().share(), std::nullopt);
  EXPECT_EQ(pressable(), "PCEDURXS");
}

// They come by two connections.
TEST_F(PanelModelTest, FeedbackAfterTheResultIsPassedOver) {
  bothNodes();
  setGoal();
  planAndFind();
  model_.driveSent("1", 0.0);
  model_.driveEnded("1", true, "ARRIVED", "there");
  model_.driveHeard("1", {"driving", 1, 0.1, 0.0}, 0.1);
  EXPECT_EQ(model_.driveText(), "ARRIVED");
  EXPECT_EQ(pressable(), "PCEDURXS");
  model_.driveHeard("2", {"driving", 0, 3.0, 0.0}, 0.2);
  EXPECT_EQ(pressable(), "PCE-U-XS") << "another goal";
  model_.driveEnded("3", false, "CANCELLED", "replaced by another goal");
  EXPECT_EQ(pressable(), "PCE-U-XS") << "not that one";
}

TEST_F(PanelModelTest, PlansOfOthersAreToldButNoEchoOfItsOwn) {
  bothNodes();
  setGoal();
  planAndFind();
  model_.otherPlan(answerOf("TIMEOUT"), 0.5);
  EXPECT_EQ(model_.sentence(), "FOUND: the sentence");
  model_.otherPlan(answerOf("TIMEOUT"), 2.0);
  EXPECT_EQ(model_.sentence(), "TIMEOUT: the sentence");
  EXPECT_FALSE(model_.path().empty()) << "the panel's own path stays";
}

TEST_F(PanelModelTest, TellsHowManyNodesThereAre) {
  EXPECT_EQ(model_.nodesText(), "no path_planner, no navigate_path");
  model_.setPlanners(2);
  model_.setDrivers(1);
  EXPECT_EQ(model_.nodesText(), "2 × path_planner, navigate_path");
}

TEST_F(PanelModelTest, NamesAndSentencesOfOthersAreCleaned) {
  bothNodes();
  setGoal();
  model_.plan();
  const auto request = model_.tick(0.0);
  PlanAnswer hostile = answerOf("FOUND\x1b[2J");
  hostile.message = std::string(100000, 'x') + "\n";
  hostile.figures.planner = "a\r\nb";
  hostile.figures.cost = 1e308 * 10.0;
  model_.planAnswered(request->id, hostile, 0.0);
  EXPECT_LT(model_.sentence().size(), 500U);
  EXPECT_EQ(model_.sentence().find('\x1b'), std::string::npos);
  EXPECT_EQ(model_.figures().substr(0, 15), "a  b: cost inf,");
  model_.driveHeard("1", {"x\ny", 0, 1.0, 0.0}, 0.0);
  EXPECT_EQ(model_.driveText(), "x y, waypoint 0, time left unknown");
}

// A law: whatever happens in whatever order, silence for long enough brings back a state in which
// everything that the nodes are there for may be pressed.
TEST_F(PanelModelTest, NoStateIsForEver) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> event(0, 12);
  unsigned last = 0;
  double now = 0.0;
  for (int round = 0; round < 20000; ++round) {
    now += 0.05;
    switch (event(random)) {
      case 0:
        setGoal(round % 7);
        break;
      case 1:
        model_.addVia("map", poseAt(1, 1));
        break;
      case 2:
        model_.plan();
        break;
      case 3:
        model_.planAnswered(last, answerOf(round % 2 ? "FOUND" : "UNREACHABLE"), now);
        break;
      case 4:
        model_.cancelPlan();
        break;
      case 5:
        model_.setPlanners(static_cast<std::size_t>(round % 3));
        break;
      case 6:
        model_.clear();
        break;
      case 7:
        model_.planHeard(last, "searching", now);
        break;
      case 8:
        model_.planAgain();
        break;
      case 9:
        model_.driveSent(std::to_string(round), now);
        break;
      case 10:
        model_.driveHeard(std::to_string(round - round % 9), {"driving", 1, 1.0, now}, now);
        break;
      case 11:
        model_.driveEnded(std::to_string(round - round % 7), true, "ARRIVED", "there");
        break;
      default:
        break;
    }
    if (const auto request = model_.tick(now)) last = request->id;
    if (round % 50 != 0) continue;
    bothNodes();
    setGoal();
    for (int requests = 0; requests < 3; ++requests) {
      now += RoutePlanning::kPatience + 1.0;
      if (const auto request = model_.tick(now)) last = request->id;
    }
    const Buttons may = model_.buttons();
    ASSERT_TRUE(may.plan && may.compare && may.explain && may.cancel) << "round " << round;
    ASSERT_TRUE(may.pause && may.resume) << "round " << round;
  }
}

}  // namespace
}  // namespace grid_path_planner::panel
