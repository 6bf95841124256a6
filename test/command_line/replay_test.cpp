// Recordings that the test writes, as rosbag record does.
#include <gtest/gtest.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include <cmath>
#include <limits>
#include <random>

#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/planning/record/plan_record.h"
#include "run_command.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/mutation.h"
#include "support/random_map.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {

using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;
using nodes::occupancyToMessage;
using nodes::PlanQuestion;
using nodes::recordOf;
using path::Pose;
using planners::plannerNames;
using planning::PathPlanner;
using planning::PlannerOptions;
using planning::planThrough;

namespace {

using test::contains;
using Map = std::shared_ptr<const OccupancyGrid>;

Pose poseIn(std::mt19937& random, const GridGeometry& geometry) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  Pose pose;
  const double width = geometry.width(), height = geometry.height();
  pose.position << geometry.worldFromGrid({part(random) * width, part(random) * height}), 0.1;
  pose.yaw = 6.0 * part(random) - 3.0;
  return pose;
}

// What path_planner publishes of an answer of `planner`, and forgets.
PlanRecord answered(PathPlanner& planner, const PlanQuestion& question) {
  planner.setOptions(question.options);
  const planning::Plan plan = planThrough(planner, question.request).plan;
  PlanRecord record = recordOf(
      question, *planner.map(), plan,
      nodes::posesAlong(plan, *planner.map(), question.pose_spacing, question.options.heading));
  record.map_topic = "/a/projected_map";
  record.updates_topic = "/a/projected_map_updates";
  return record;
}

class ReplayTest : public testing::Test {
 protected:
  // `seconds`: the stamp, and the time of the recording.
  void writeMap(const OccupancyGrid& map, double seconds) {
    const ros::Time time(seconds);
    bag_->write("projected_map", ros::Time(next_++), occupancyToMessage(map, "map", time));
  }
  void writeUpdate(const OccupancyGrid& map, const CellRect& rect, double seconds) {
    map_msgs::OccupancyGridUpdate update;
    update.header.stamp = ros::Time(seconds);
    update.x = rect.column;
    update.y = rect.row;
    update.width = static_cast<std::uint32_t>(rect.width);
    update.height = static_cast<std::uint32_t>(rect.height);
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      update.data.insert(update.data.end(), map.row(row) + rect.column,
                         map.row(row) + rect.column + rect.width);
    bag_->write("projected_map_updates", ros::Time(next_++), update);
  }
  void writePlan(const PlanRecord& record) {
    bag_->write("plan_record", ros::Time(next_++), record);
  }
  Outcome replay(std::vector<std::string> arguments = {}) {
    bag_.reset();
    arguments.insert(arguments.begin(), {"replay", file_});
    return runCommand(runReplay, arguments);
  }

  // A plan on a small map, to be changed by tests.
  PlanRecord plan() {
    PathPlanner planner;
    planner.setMap(room_);
    PlanQuestion question;
    question.request.start.position = {0.5, 0.5, 0.0};
    question.request.goal.position = {5.5, 2.5, 0.0};
    return answered(planner, question);
  }

  const test::TemporaryFolder folder_;
  const std::string file_ = folder_.path("plans.bag");
  std::unique_ptr<rosbag::Bag> bag_ = std::make_unique<rosbag::Bag>(file_, rosbag::bagmode::Write);
  unsigned next_ = 1;  // time of recording, s
  const Map room_ = std::make_shared<const OccupancyGrid>(test::AsciiMap({"......",  //
                                                                          ".####.",  //
                                                                          "......"})
                                                              .map);
};

// Maps, their updates, planners and options at random: all plans are repeated, whatever came before.
TEST_F(ReplayTest, EveryPlanOfEveryPlannerIsIdentical) {
  std::mt19937 random(1715);
  OccupancyGrid map = test::randomOccupancy(random, 60, 0.2, 0.1);
  while (map.geometry().size() < 900) map = test::randomOccupancy(random, 60, 0.2, 0.1);
  writeMap(map, 1.0);
  int plans = 0;
  for (int step = 0; step < 12; ++step) {
    for (const CellRect& changed : test::randomRects(random, map.geometry(), 5)) {
      const CellRect rect = changed.intersection(map.geometry().rect());
      if (rect.width <= 0 || rect.height <= 0) continue;
      for (int row = rect.row; row < rect.row + rect.height; ++row)
        for (int column = rect.column; column < rect.column + rect.width; ++column)
          map[Cell{column, row}] = random() % 3 == 0 ? 100 : 0;
      writeUpdate(map, rect, 2.0 + step);
    }
    PathPlanner planner;
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    for (const std::string& name : plannerNames()) {
      PlanQuestion question;
      question.options.planner = name;
      question.options.costmap.radius = random() % 2 * 0.7;
      question.options.costmap.kernel = 1 + static_cast<int>(random() % 2);
      question.options.costmap.decay = 0.5;
      question.options.smooth = random() % 2 == 0;
      question.options.tolerance = 0.1 * static_cast<double>(random() % 20);
      question.pose_spacing = random() % 2 == 0 ? -1.0 : 0.37;
      question.request.start = poseIn(random, map.geometry());
      question.request.goal = poseIn(random, map.geometry());
      if (random() % 3 == 0) question.request.via = {poseIn(random, map.geometry()).position};
      writePlan(answered(planner, question));
      ++plans;
    }
  }
  const Outcome outcome = replay();
  EXPECT_EQ(outcome.code, 0) << outcome.printed;
  const std::string count = std::to_string(plans);
  EXPECT_TRUE(contains(outcome.printed, count + " of " + count + " plans are identical"));
  EXPECT_TRUE(contains(outcome.printed, "identical: FOUND")) << outcome.printed;
}

// A repair depends on what was planned before: the whole history is planned again.
TEST_F(ReplayTest, AnIncrementalPlannerIsRepeatedWithItsHistory) {
  std::mt19937 random(4);
  OccupancyGrid map(GridGeometry(40, 40, 1.0));
  writeMap(map, 1.0);
  PathPlanner planner;
  PlanQuestion question;
  question.options.planner = "incremental_a_star";
  question.options.smooth = false;
  question.request.goal.position = {38.5, 33.5, 0.0};
  for (int step = 0; step < 30; ++step) {
    const CellRect rect{static_cast<int>(random() % 38), static_cast<int>(random() % 38), 2, 2};
    const std::int8_t value = random() % 2 == 0 ? 100 : 0;
    for (int row = rect.row; row < rect.row + 2; ++row)
      for (int column = rect.column; column < rect.column + 2; ++column)
        map[Cell{column, row}] = value;
    writeUpdate(map, rect, 2.0 + step);
    const auto next = std::make_shared<const OccupancyGrid>(map);
    if (planner.hasMap())
      planner.updateMap(next, {rect});
    else
      planner.setMap(next);
    question.request.start.position = {1.5 + step * 0.5, 2.5, 0.0};
    writePlan(answered(planner, question));
  }
  const Outcome outcome = replay();
  EXPECT_EQ(outcome.code, 0) << outcome.printed;
  EXPECT_TRUE(contains(outcome.printed, "after the plans before it")) << outcome.printed;
}

// A* answers while weighted_jump_point has prepared little, by another path.
TEST_F(ReplayTest, WhoAnsweredInPlaceOfThePlannerAnswersAgain) {
  std::mt19937 random(9);
  OccupancyGrid map(GridGeometry(400, 400, 1.0), 0);
  for (int i = 0; i < 4000; ++i) map[test::randomCell(random, map.geometry())] = 100;
  writeMap(map, 1.0);
  PathPlanner planner;
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  PlanQuestion question;
  question.options.costmap.decay = 0.3;
  question.request.start.position = {3.5, 7.5, 0.0};
  question.request.goal.position = {390.5, 333.5, 0.0};
  const PlanRecord record = answered(planner, question);
  ASSERT_EQ(record.answered_by, "a_star");
  writePlan(record);
  planner.finishPreparation(StopToken());
  writePlan(answered(planner, question));
  const Outcome outcome = replay();
  EXPECT_EQ(outcome.code, 0) << outcome.printed;
  EXPECT_TRUE(contains(outcome.printed, ", by a_star")) << outcome.printed;
  EXPECT_TRUE(contains(outcome.printed, ", by weighted_jump_point\n")) << outcome.printed;
}

// What path_planner records where weighted_jump_point let A* answer a question that it answers itself now.
TEST_F(ReplayTest, APlannerThatHadSpentItsPreparationIsRepeated) {
  std::mt19937 random(10);
  OccupancyGrid map(GridGeometry(120, 120, 1.0), 0);
  for (int i = 0; i < 1100; ++i) map[test::randomCell(random, map.geometry())] = 100;
  map[Cell{1, 1}] = map[Cell{110, 100}] = 0;
  writeMap(map, 1.0);
  PathPlanner planner;
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  PlanQuestion question;
  question.options.planner = "a_star";
  question.options.costmap.decay = 0.3;
  question.options.smooth = false;
  question.request.start.position = {1.5, 1.5, 0.0};
  question.request.goal.position = {110.5, 100.5, 0.0};
  PlanRecord record = answered(planner, question);
  const std::string asked = "planner: a_star";
  record.options.replace(record.options.find(asked), asked.size(), "planner: weighted_jump_point");
  writePlan(record);
  const Outcome outcome = replay();
  EXPECT_EQ(outcome.code, 0) << outcome.printed;
  EXPECT_TRUE(contains(outcome.printed, "by a_star in place of weighted_jump_point"))
      << outcome.printed;
}

// The recorder had the map after updates that are newer, and path_planner before them.
TEST_F(ReplayTest, AMapThatComesLaterThanItsUpdatesIsTheSame) {
  OccupancyGrid open = *room_;
  open[Cell{2, 1}] = 0;
  writeUpdate(open, {2, 1, 1, 1}, 2.0);
  writeMap(*room_, 1.0);
  PathPlanner planner;
  planner.setMap(std::make_shared<const OccupancyGrid>(open));
  PlanQuestion question;
  question.request.start.position = {0.5, 0.5, 0.0};
  question.request.goal.position = {5.5, 2.5, 0.0};
  writePlan(answered(planner, question));
  EXPECT_EQ(replay().code, 0);
}

TEST_F(ReplayTest, TheLastBitOfOnePoseIsSeen) {
  PlanRecord record = plan();
  ASSERT_EQ(record.status, "FOUND");
  record.poses[4] = std::nextafter(record.poses[4], 100.0);
  writeMap(*room_, 1.0);
  writePlan(plan());
  writePlan(record);
  const Outcome outcome = replay();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.printed, "plan 1: identical: FOUND")) << outcome.printed;
  EXPECT_TRUE(
      contains(outcome.printed, "plan 2: differs: another path of the same cost; pose 2 is"))
      << outcome.printed;
  EXPECT_EQ(runCommand(runReplay, {"replay", file_, "--plan", "1"}).code, 0);
}

TEST_F(ReplayTest, FailuresAreRepeatedToo) {
  PathPlanner planner;
  planner.setMap(room_);
  PlanQuestion question;
  question.request.start.position = {0.5, 0.5, 0.0};
  question.request.goal.position = {2.5, 1.5, 0.0};
  writeMap(*room_, 1.0);
  writePlan(answered(planner, question));
  question.request.goal.position.x() = -30.0;
  writePlan(answered(planner, question));
  const Outcome outcome = replay();
  EXPECT_EQ(outcome.code, 0) << outcome.printed;
  EXPECT_TRUE(contains(outcome.printed, "plan 1: identical: GOAL_OCCUPIED")) << outcome.printed;
  EXPECT_TRUE(contains(outcome.printed, "plan 2: identical: GOAL_OUTSIDE_MAP")) << outcome.printed;
}

TEST_F(ReplayTest, WhatCannotBeRepeatedSaysWhy) {
  const PlanRecord good = plan();
  PlanRecord late = good, other = good, unknown = good, lacking = good, odd = good, wide = good,
             far = good;
  late.status = "TIMEOUT";
  other.map_checksum += 1;
  unknown.options += "warp: 9\n";
  lacking.options = "planner: a_star\n";
  odd.poses.pop_back();
  wide.pose_spacing = std::numeric_limits<double>::quiet_NaN();
  far.start[1] = 1e300;
  writeMap(*room_, 1.0);
  for (const PlanRecord& record : {late, other, unknown, lacking, odd, wide, far})
    writePlan(record);
  const Outcome outcome = replay();
  EXPECT_EQ(outcome.code, 1);
  for (const char* reason :
       {"plan 1: cannot be repeated: its time limit", "plan 2: cannot be repeated: its map is not",
        "plan 3: cannot be repeated: its options have warp",
        "plan 4: cannot be repeated: its options lack",
        "plan 5: cannot be repeated: its lists of numbers",
        "plan 6: cannot be repeated: its pose_spacing is",
        "plan 7: cannot be repeated: its start, goal or via-points", "0 of 7 plans are identical"})
    EXPECT_TRUE(contains(outcome.printed, reason)) << reason << '\n' << outcome.printed;
}

TEST_F(ReplayTest, AnotherVersionIsNamedWhereThePathDiffers) {
  PlanRecord record = plan();
  record.version = "0.0.9";
  writeMap(*room_, 1.0);
  writePlan(record);
  record.cost += 1.0;
  writePlan(record);
  const Outcome outcome = replay();
  EXPECT_TRUE(contains(outcome.printed, "plan 1: identical")) << outcome.printed;
  EXPECT_TRUE(contains(outcome.printed, "recorded by version 0.0.9")) << outcome.printed;
}

TEST_F(ReplayTest, TextOfABagDoesNotReachTheTerminalAsItIs) {
  PlanRecord record = plan();
  record.version = "\x1b[2J";
  record.cost += 1.0;
  writePlan(record);
  writeMap(*room_, 1.0);
  EXPECT_TRUE(contains(replay().printed, "recorded by version ?[2J"));
}

TEST_F(ReplayTest, PicturesAndWaypointsAreWritten) {
  writeMap(*room_, 1.0);
  writePlan(plan());
  EXPECT_EQ(replay({"--out", folder_.path("")}).code, 0);
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"plan_1.png", "plan_1.yaml", "plans.bag"}));
}

TEST_F(ReplayTest, BadInputIsNamed) {
  writeMap(*room_, 1.0);
  EXPECT_TRUE(contains(replay().error, "plans.bag: has no grid_path_planner/PlanRecord"));
  EXPECT_TRUE(contains(runCommand(runReplay, {"replay", "no.bag"}).error, "no.bag"));
  EXPECT_TRUE(contains(runCommand(runReplay, {"replay", file_, "--out", "no/folder"}).error,
                       "--out needs a folder that exists"));
}

TEST_F(ReplayTest, APlanThatIsNotThereIsBadInput) {
  writeMap(*room_, 1.0);
  writePlan(plan());
  EXPECT_EQ(replay({"--plan", "2"}).error, "--plan 2: the bag has 1 plans");
}

// Topics of these names with other types, and a map that is none.
TEST_F(ReplayTest, StrangersMessagesChangeNothing) {
  nav_msgs::OccupancyGrid none = occupancyToMessage(*room_, "map", ros::Time(3.0));
  none.data.pop_back();
  bag_->write("/a/projected_map", ros::Time(1), std_msgs::String());
  bag_->write("/plan_record", ros::Time(1), std_msgs::String());
  writeMap(*room_, 1.0);
  bag_->write("projected_map", ros::Time(3), none);
  writeUpdate(*room_, {5, 2, 1, 1}, 4.0);
  writePlan(plan());
  const Outcome outcome = replay();
  EXPECT_EQ(outcome.code, 0) << outcome.printed << outcome.error;
}

TEST_F(ReplayTest, DamagedRecordingsAreAnsweredOrRefused) {
  writeMap(*room_, 1.0);
  writeUpdate(*room_, {1, 1, 2, 1}, 2.0);
  writePlan(plan());
  bag_.reset();
  const std::string whole = test::contentOf(file_);
  std::mt19937 random(20261123);
  int answered = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::string file = folder_.write("damaged.bag", test::mutated(whole, random));
    const Outcome outcome = runCommand(runReplay, {"replay", file});
    if (outcome.error.empty())
      ++answered;
    else
      EXPECT_TRUE(contains(outcome.error, "damaged.bag")) << outcome.error;
  }
  EXPECT_GT(answered, 0);
  EXPECT_LT(answered, 200);
}

}  // namespace
}  // namespace grid_path_planner::command_line
