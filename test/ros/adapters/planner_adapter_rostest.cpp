// What the plugins of move_base and of Move Base Flex do, but for the signatures of these.
#include "ros/adapters/planner_adapter.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <rosgraph_msgs/Log.h>

#include <atomic>
#include <cctype>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <thread>

#include "memory/failing_allocation.h"
#include "ros/support/latest.h"
#include "support/error_text.h"

namespace grid_path_planner::nodes {

using base::InputError, base::Status;
using geometry_msgs::PoseStamped;
using grid::Cell, grid::Grid, grid::GridGeometry;
using planning::Cost, planning::CostPlanner;

namespace {

PoseStamped poseAt(double x, double y, const std::string& frame = "map") {
  PoseStamped pose;
  pose.header.frame_id = frame;
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.w = 1.0;
  return pose;
}

// 100x100 cells of 0.1 m with a wall, which has a door.
struct Site {
  Site() : costs(GridGeometry(100, 100, 0.1)) {
    for (int row = 0; row < 100; ++row)
      if (row != 90) costs[Cell{50, row}] = planning::kLethalCost;
  }

  PlannerAdapter::GiveCosts give() {
    return [this](CostPlanner& planner) {
      planner.setCosts(costs.geometry(), costs.values().data(), 0.2);
    };
  }

  Grid<Cost> costs;
};

TEST(PlannerAdapter, TellsWhatMemoryItMayTake) {
  ros::param::set("/told/memory_limit", 500);
  const test::Latest<rosgraph_msgs::Log> log(ros::NodeHandle(), "/rosout");
  ASSERT_TRUE(test::waitFor([&] { return log.connected(); }));
  const PlannerAdapter adapter(ros::NodeHandle("/told"), "/map");
  EXPECT_TRUE(log.waitFor(0, [](const rosgraph_msgs::Log& line) {
    return line.msg == "Planning may take 500 MB (memory_limit)";
  }));
}

TEST(PlannerAdapter, PlansPublishesAndSpacesThePoses) {
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "/map");
  const test::Latest<nav_msgs::Path> published(ros::NodeHandle(), "/plain/plan");
  ASSERT_TRUE(test::waitFor([&] { return published.connected(); }));
  const auto answer =
      adapter.makePlan(poseAt(1.03, 1.0), poseAt(9.0, 1.07, "/map"), {}, site.give());
  ASSERT_TRUE(answer.found()) << answer.message;
  EXPECT_GT(answer.cost, 0.0);
  ASSERT_GT(answer.poses.size(), 150U);
  EXPECT_EQ(answer.poses.front().pose.position.x, 1.03);
  EXPECT_EQ(answer.poses.back().pose.position.y, 1.07);
  for (std::size_t i = 1; i < answer.poses.size(); ++i) {
    const auto &a = answer.poses[i - 1].pose.position, &b = answer.poses[i].pose.position;
    EXPECT_LE(std::hypot(b.x - a.x, b.y - a.y), 0.1 + 1e-9);
    EXPECT_EQ(answer.poses[i].header.frame_id, "map");
  }
  const auto plan = published.waitForMoreThan(0);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->poses.size(), answer.poses.size());
}

TEST(PlannerAdapter, RefusesWhatIsNoPoseOfTheCostmap) {
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "map");
  const auto status = [&](const PoseStamped& start, const PoseStamped& goal,
                          std::optional<double> tolerance = {}) {
    return adapter.makePlan(start, goal, tolerance, site.give()).status;
  };
  const PoseStamped here = poseAt(1, 1), there = poseAt(9, 1);
  EXPECT_EQ(status(poseAt(1, 1, "odom"), there), Status::TRANSFORM_ERROR);
  EXPECT_EQ(status(here, poseAt(9, 1, "")), Status::TRANSFORM_ERROR);
  PoseStamped no_pose = there;
  no_pose.pose.orientation.w = 0.0;
  EXPECT_EQ(status(here, no_pose), Status::INVALID_REQUEST);
  EXPECT_EQ(status(no_pose, there), Status::INVALID_REQUEST);
  no_pose.pose.orientation.w = 1.0;
  no_pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(status(here, no_pose), Status::INVALID_REQUEST);
  EXPECT_EQ(status(here, there, -0.1), Status::INVALID_REQUEST);
  EXPECT_EQ(status(here, there, std::nan("")), Status::INVALID_REQUEST);
  EXPECT_EQ(status(here, poseAt(11, 1)), Status::GOAL_OUTSIDE_MAP);
  EXPECT_EQ(status(here, there), Status::FOUND);
}

TEST(PlannerAdapter, TakesAVehicleThatTilts) {
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "map");
  PoseStamped start = poseAt(1, 1);
  start.pose.orientation.x = std::sin(0.1);
  start.pose.orientation.w = std::cos(0.1);
  EXPECT_TRUE(adapter.makePlan(start, poseAt(9, 1), {}, site.give()).found());
  EXPECT_EQ(adapter.makePlan(poseAt(1, 1), start, {}, site.give()).status, Status::INVALID_REQUEST)
      << "a goal that tilts";
}

TEST(PlannerAdapter, AnswersWhereTheCostmapCannotBeTaken) {
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "map");
  const auto answer = adapter.makePlan(poseAt(1, 1), poseAt(2, 2), {}, [](CostPlanner&) {
    throw InputError("the costmap has no cells yet");
  });
  EXPECT_EQ(answer.status, Status::INVALID_REQUEST);
  EXPECT_EQ(answer.message, "the costmap has no cells yet");
  EXPECT_EQ(adapter.makePlan(poseAt(1, 1), poseAt(2, 2), {}, [](CostPlanner&) {}).status,
            Status::NO_MAP);
}

TEST(PlannerAdapter, ReadsParametersAndWhoAsksNamesTheTolerance) {
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/given"), "map");
  site.costs[Cell{50, 90}] = planning::kUnknownCost;
  EXPECT_EQ(adapter.makePlan(poseAt(1, 1), poseAt(9, 1), {}, site.give()).status,
            Status::UNREACHABLE);
  EXPECT_TRUE(adapter.makePlan(poseAt(1, 1), poseAt(5.05, 1), {}, site.give()).found());
  EXPECT_EQ(adapter.makePlan(poseAt(1, 1), poseAt(5.05, 1), 0.0, site.give()).status,
            Status::GOAL_OCCUPIED);
}

TEST(PlannerAdapter, AParameterThatCannotBeUsedIsNamed) {
  EXPECT_EQ(test::errorText([] { PlannerAdapter adapter(ros::NodeHandle("/refused"), "map"); }),
            "/refused/inflation_weight must be an integer, got the string many");
}

// Text that a terminal obeys, or of a megabyte, went into the log and into the answer, which a client sees.
TEST(PlannerAdapter, NamesOfFramesThatAreNoneAreNotRepeated) {
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "map");
  for (const std::string& frame : {std::string("a\x1b[2J"), std::string(1000000, 'a')})
    for (const bool of_start : {true, false}) {
      const auto answer = adapter.makePlan(poseAt(1, 1, of_start ? frame : "map"),
                                           poseAt(9, 1, of_start ? "map" : frame), {}, site.give());
      EXPECT_EQ(answer.status, Status::INVALID_REQUEST);
      EXPECT_EQ(
          answer.message.find(of_start ? "start: the name of a frame" : "goal: the name of a"), 0U);
      EXPECT_LT(answer.message.size(), 200U);
      for (const char c : answer.message) EXPECT_FALSE(std::iscntrl(static_cast<unsigned char>(c)));
    }
}

// A failure whose sentence was another one each time was logged each time.
TEST(PlannerAdapter, LogsFailuresOnceInASecondAtMost) {
  const test::Latest<rosgraph_msgs::Log> log(ros::NodeHandle(), "/rosout");
  ASSERT_TRUE(test::waitFor([&] { return log.connected(); }));
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "map");
  const auto ask = [&](const std::string& frame) {
    adapter.makePlan(poseAt(1, 1, frame), poseAt(9, 1), {}, site.give());
  };
  const auto lines = [&](const std::string& frame) {
    std::size_t count = 0;
    for (const rosgraph_msgs::Log& line : log.all())
      count += line.msg.find("the start is in frame '" + frame) != std::string::npos ? 1 : 0;
    return count;
  };
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 100; ++i) ask("stranger_" + std::to_string(i));
  EXPECT_TRUE(test::waitFor([&] {  // what is wrong later is told, too
    ask("stranger_later");
    return lines("stranger_later") > 0;
  }));
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(static_cast<double>(lines("stranger_")), 2.0 + passed.count());
}

// What was seen before: what failed after the search was thrown on, into the thread of move_base that plans, which ended
// move_base with the velocity that it had sent.
TEST(PlannerAdapter, AnswersWhateverAllocationFails) {
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "map");
  bool happened = true;
  int number = 1;
  for (; happened; ++number) {
    std::optional<test::FailingAllocation> fails;
    PlannerAdapter::Answer answer;
    std::string thrown;
    try {
      answer = adapter.makePlan(poseAt(1, 1), poseAt(9, 1), {}, [&](CostPlanner& planner) {
        site.give()(planner);
        fails.emplace(number);
      });
    } catch (const std::exception& error) {
      thrown = error.what();
    }
    happened = fails->happened();
    fails.reset();
    ASSERT_EQ(thrown, "") << "allocation " << number;
    ASSERT_EQ(answer.found(), !answer.poses.empty()) << "allocation " << number;
    ASSERT_TRUE(answer.found() || !answer.message.empty()) << "allocation " << number;
  }
  EXPECT_GT(number, 20) << "so many allocations failed in turn";
  EXPECT_TRUE(adapter.makePlan(poseAt(1, 1), poseAt(9, 1), {}, site.give()).found());
}

// A plan of such poses takes hundreds of megabytes.
TEST(PlannerAdapter, PosesAreNotAskedForCloserThanAMillimetre) {
  const std::string refusal = "pose_spacing must be -1, 0, or at least 0.001 m, got 1e-09";
  ros::param::set("/dense/pose_spacing", 1e-9);
  EXPECT_EQ(test::errorText([] { PlannerAdapter adapter(ros::NodeHandle("/dense"), "map"); }),
            refusal);
  ros::param::set("/dense/pose_spacing", 0.001);
  const PlannerAdapter adapter(ros::NodeHandle("/dense"), "map");
  dynamic_reconfigure::Reconfigure request;
  using dynamic_reconfigure::ConfigTools;
  ConfigTools::appendParameter(request.request.config, "pose_spacing", 1e-9);
  ASSERT_TRUE(ros::service::call("/dense/set_parameters", request));
  double spacing = 0.0;
  ASSERT_TRUE(ConfigTools::getParameter(request.response.config, "pose_spacing", spacing));
  EXPECT_EQ(spacing, 0.001);
}

TEST(PlannerAdapter, CancelEndsWhatPlansAndNothingLater) {
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "map");
  const Grid<Cost> large(GridGeometry(1500, 1500, 0.1), 9);
  const auto give = [&](CostPlanner& planner) {
    planner.setCosts(large.geometry(), large.values().data(), 0.2);
  };
  const auto cancelled = adapter.makePlan(poseAt(1, 1), poseAt(149, 149), {}, [&](auto& planner) {
    give(planner);
    std::thread([&] { adapter.cancel(); }).join();  // as the server's thread does meanwhile
  });
  EXPECT_EQ(cancelled.status, Status::CANCELLED);
  EXPECT_TRUE(cancelled.poses.empty());
  EXPECT_TRUE(adapter.makePlan(poseAt(1, 1), poseAt(149, 149), {}, give).found());
}

TEST(PlannerAdapter, ThreadsWaitForOneAnother) {
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/plain"), "map");
  std::atomic<int> inside{0}, found{0};
  const auto ask = [&] {
    for (int i = 0; i < 20; ++i) {
      const auto answer = adapter.makePlan(poseAt(1, 1), poseAt(9, 1), {}, [&](auto& planner) {
        EXPECT_EQ(++inside, 1);
        site.give()(planner);
        --inside;
      });
      if (answer.found()) ++found;
    }
  };
  std::thread other(ask);
  ask();
  other.join();
  EXPECT_EQ(found, 40);
}

TEST(PlannerAdapter, IsReconfiguredAndARefusalChangesNothing) {
  Site site;
  PlannerAdapter adapter(ros::NodeHandle("/tuned"), "map");
  site.costs[Cell{50, 90}] = planning::kUnknownCost;
  const auto status = [&] {
    return adapter.makePlan(poseAt(1, 1), poseAt(9, 1), {}, site.give()).status;
  };
  EXPECT_EQ(status(), Status::FOUND);
  dynamic_reconfigure::Reconfigure request;
  using dynamic_reconfigure::ConfigTools;
  ConfigTools::appendParameter(request.request.config, "allow_unknown", false);
  ASSERT_TRUE(ros::service::call("/tuned/set_parameters", request));
  EXPECT_EQ(status(), Status::UNREACHABLE);
  ConfigTools::appendParameter(request.request.config, "free_weight",
                               41);  // above inflation_weight
  ASSERT_TRUE(ros::service::call("/tuned/set_parameters", request));
  int weight = 0;
  ASSERT_TRUE(ConfigTools::getParameter(request.response.config, "free_weight", weight));
  EXPECT_EQ(weight, 1);
  EXPECT_EQ(status(), Status::UNREACHABLE);
}

}  // namespace
}  // namespace grid_path_planner::nodes
