// The plugin that pluginlib loads for move_base, on a real costmap_2d and beside the planners that
// move_base has.
#include <nav_core/base_global_planner.h>
#include <tf2/utils.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "planning/cost_weights.h"
#include "ros/support/costmap_fixture.h"

namespace grid_path_planner::nodes {

using costmap_2d::LETHAL_OBSTACLE, costmap_2d::NO_INFORMATION;
using planning::CostWeights;
using Poses = std::vector<geometry_msgs::PoseStamped>;

namespace {

constexpr char kOurs[] = "grid_path_planner/GridPathPlanner";

class MoveBasePlanner : public testing::Test {
 protected:
  explicit MoveBasePlanner(unsigned seed = 7) : random_(seed), site_(test::siteMap(random_)) {}

  boost::shared_ptr<nav_core::BaseGlobalPlanner> planner(const std::string& type,
                                                         const std::string& name) {
    auto made = loader_.createInstance(type);
    made->initialize(name, &site_.ros());
    return made;
  }

  // In weights x metres; infinite where it enters a cell in collision.
  double costOf(const Poses& plan) {
    const CostWeights weights({});
    double cost = 0.0;
    test::forEachPiece(site_, plan, [&](double length, unsigned char cell) {
      const int weight = weights.weight(cell);
      cost += weight == 0 ? std::numeric_limits<double>::infinity() : weight * length;
    });
    return cost;
  }

  void drawColumn(unsigned column, unsigned from, unsigned to, unsigned char cost) {
    const boost::unique_lock<costmap_2d::Costmap2D::mutex_t> lock(*site_.cells().getMutex());
    for (unsigned row = from; row < to; ++row) site_.cells().setCost(column, row, cost);
  }
  void clear() { site_.cells().resetMap(0, 0, 200, 200); }

  std::mt19937 random_;
  pluginlib::ClassLoader<nav_core::BaseGlobalPlanner> loader_{"nav_core",
                                                              "nav_core::BaseGlobalPlanner"};
  test::Site site_;
};

TEST_F(MoveBasePlanner, CostsNoMoreThanPlansOfGlobalPlannerAndNavfn) {
  const auto ours = planner(kOurs, "ours");
  const auto global_planner = planner("global_planner/GlobalPlanner", "global_planner");
  const auto navfn = planner("navfn/NavfnROS", "navfn");
  int compared = 0;
  double sum = 0.0, sum_of_theirs = 0.0;
  for (int query = 0; query < 60; ++query) {
    const auto start = site_.freePose(random_), goal = site_.freePose(random_);
    Poses plan;
    double told = 0.0;
    const bool found = ours->makePlan(start, goal, plan, told);
    const double cost = costOf(plan);
    EXPECT_TRUE(std::isfinite(cost)) << "query " << query << " leads through cells in collision";
    for (const auto& peer : {global_planner, navfn}) {
      Poses theirs;
      if (!peer->makePlan(start, goal, theirs)) continue;
      const double cost_of_theirs = costOf(theirs);
      if (!std::isfinite(cost_of_theirs)) continue;
      ASSERT_TRUE(found) << "query " << query;
      EXPECT_LE(cost, 1.1 * cost_of_theirs + 0.1) << "query " << query;
      sum += cost;
      sum_of_theirs += cost_of_theirs;
      ++compared;
    }
    if (!found) continue;
    EXPECT_EQ(plan.front().pose.position.x, start.pose.position.x);
    EXPECT_EQ(plan.back().pose.position.y, goal.pose.position.y);
    EXPECT_LE(cost / 0.05, told * 1.001 + 1.0) << "what is told counts the largest weight touched";
  }
  EXPECT_GT(compared, 60);
  EXPECT_LT(sum, sum_of_theirs);
  std::cout << compared << " plans of others cost " << sum_of_theirs / sum << " of ours\n";
}

TEST_F(MoveBasePlanner, NeitherUnknownNorLethalCellsAreEnteredAgainstItsOptions) {
  const auto ours = planner(kOurs, "ours"), strict = planner(kOurs, "strict");
  clear();
  drawColumn(100, 0, 200, NO_INFORMATION);
  const auto start = test::stampedPose(1.025, 5.025), goal = test::stampedPose(9.025, 5.025);
  Poses plan;
  EXPECT_TRUE(ours->makePlan(start, goal, plan));
  EXPECT_FALSE(strict->makePlan(start, goal, plan));
  EXPECT_TRUE(plan.empty());

  drawColumn(100, 0, 200, 0);
  drawColumn(20, 99, 102, LETHAL_OBSTACLE);  // around the start: one cell is passed, as by others
  EXPECT_TRUE(ours->makePlan(start, goal, plan));
  EXPECT_FALSE(strict->makePlan(start, goal, plan));
  for (unsigned column = 14; column < 27; ++column) drawColumn(column, 90, 111, LETHAL_OBSTACLE);
  EXPECT_FALSE(ours->makePlan(start, goal, plan)) << "the start is deep inside";
  EXPECT_FALSE(ours->makePlan(goal, start, plan)) << "so is the goal";
}

// The costmap's thread opens one of two doors and shuts the other, at any time. Every plan is legal
// on the costmap as it was at one time.
TEST_F(MoveBasePlanner, TheCostmapChangesWhileItPlans) {
  const auto ours = planner(kOurs, "ours");
  clear();
  drawColumn(100, 0, 200, LETHAL_OBSTACLE);
  const auto open = [&](bool left) {
    const boost::unique_lock<costmap_2d::Costmap2D::mutex_t> lock(*site_.cells().getMutex());
    for (unsigned row = 0; row < 10; ++row) {
      site_.cells().setCost(100, 5 + row, left ? 0 : LETHAL_OBSTACLE);
      site_.cells().setCost(100, 185 + row, left ? LETHAL_OBSTACLE : 0);
    }
  };
  open(true);
  std::atomic<bool> done{false};
  std::thread doors([&] {
    for (bool left = false; !done; left = !left) open(left);
  });
  for (int i = 0; i < 200; ++i) {
    Poses plan;
    EXPECT_TRUE(ours->makePlan(test::stampedPose(1.0, 5.0), test::stampedPose(9.0, 5.0), plan));
    for (std::size_t pose = 1; pose < plan.size(); ++pose) {
      const auto &a = plan[pose - 1].pose.position, &b = plan[pose].pose.position;
      if (a.x > 5.025 || b.x < 5.025 || a.x == b.x) continue;
      const double y = a.y + (5.025 - a.x) / (b.x - a.x) * (b.y - a.y);
      EXPECT_TRUE((y > 0.25 && y < 0.75) || (y > 9.25 && y < 9.75)) << "through the wall at " << y;
    }
  }
  done = true;
  doors.join();
}

TEST_F(MoveBasePlanner, FollowsARollingWindow) {
  const auto ours = planner(kOurs, "ours");
  clear();
  Poses plan;
  ASSERT_TRUE(ours->makePlan(test::stampedPose(1.0, 5.0), test::stampedPose(9.0, 5.0), plan));
  site_.cells().updateOrigin(2.0, 0.0);
  EXPECT_FALSE(ours->makePlan(test::stampedPose(1.0, 5.0), test::stampedPose(9.0, 5.0), plan))
      << "the start lies outside now";
  EXPECT_TRUE(ours->makePlan(test::stampedPose(3.0, 5.0), test::stampedPose(11.0, 5.0), plan));
}

// Half the sides of a vehicle, in metres.
constexpr double kHalfLength = 0.8, kHalfWidth = 0.2;

// Whether some point of that vehicle lies in a lethal cell at a pose of the plan or while it turns from one heading to the next.
bool meetsLethalCells(test::Site& site, const Poses& plan) {
  const auto lethal = [&](double x, double y) {
    return std::min(x, y) > 0.0 && std::max(x, y) < 10.0 && site.costAt(x, y) == LETHAL_OBSTACLE;
  };
  const auto meets = [&](const geometry_msgs::Point& at, double yaw) {
    const double c = std::cos(yaw), s = std::sin(yaw);
    for (double x = -kHalfLength; x <= kHalfLength; x += 0.02)
      for (double y = -kHalfWidth; y <= kHalfWidth; y += 0.02)
        if (lethal(at.x + x * c - y * s, at.y + x * s + y * c)) return true;
    return false;
  };
  for (std::size_t i = 1; i < plan.size(); ++i) {
    const double from = tf2::getYaw(plan[i - 1].pose.orientation);
    const double turn = std::remainder(tf2::getYaw(plan[i].pose.orientation) - from, 2.0 * M_PI);
    const int steps = 1 + static_cast<int>(std::abs(turn) / 0.05);
    for (int step = 0; step <= steps; ++step)
      if (meets(plan[i].pose.position, from + turn * step / steps)) return true;
  }
  return false;
}

TEST_F(MoveBasePlanner, WithUseFootprintTheCostmapsOwnMeetsNothing) {
  std::vector<geometry_msgs::Point> corners(4);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i].x = i == 0 || i == 3 ? kHalfLength : -kHalfLength;
    corners[i].y = i < 2 ? kHalfWidth : -kHalfWidth;
  }
  site_.ros().setUnpaddedRobotFootprint(corners);
  site_.ros().updateMap();
  const auto disc = planner(kOurs, "ours"), ours = planner(kOurs, "footprint");
  int found = 0, met_by_disc = 0;
  for (int query = 0; query < 40; ++query) {
    const auto start = site_.freePose(random_), goal = site_.freePose(random_);
    Poses plan;
    if (disc->makePlan(start, goal, plan)) met_by_disc += meetsLethalCells(site_, plan);
    if (!ours->makePlan(start, goal, plan)) continue;
    ++found;
    EXPECT_FALSE(meetsLethalCells(site_, plan)) << "query " << query;
  }
  EXPECT_GT(found, 10);
  EXPECT_GT(met_by_disc, 2) << "of plans that only the inscribed radius was asked for";
  std::cout << found << " plans of 40 with the footprint, " << met_by_disc
            << " without meet something\n";
}

// The topic `footprint` of costmap_2d changes it while move_base runs.
TEST_F(MoveBasePlanner, AFootprintThatChangesCountsForTheNextPlan) {
  const auto ours = planner(kOurs, "footprint");
  clear();
  drawColumn(100, 0, 95, LETHAL_OBSTACLE);
  drawColumn(100, 105, 200, LETHAL_OBSTACLE);  // a door of 0.5 m
  const auto start = test::stampedPose(2.0, 5.0), goal = test::stampedPose(8.0, 5.0);
  Poses plan;
  EXPECT_TRUE(ours->makePlan(start, goal, plan));
  std::vector<geometry_msgs::Point> wide = site_.ros().getUnpaddedRobotFootprint();
  for (geometry_msgs::Point& corner : wide) corner.y *= 2.0;
  site_.ros().setUnpaddedRobotFootprint(wide);
  EXPECT_FALSE(ours->makePlan(start, goal, plan));
  EXPECT_TRUE(plan.empty());
}

TEST_F(MoveBasePlanner, WithAParameterThatCannotBeUsedItIsNotCreated) {
  try {
    planner(kOurs, "refused");
    FAIL() << "a planner of the name navfn";
  } catch (const pluginlib::PluginlibException& error) {
    EXPECT_NE(std::string(error.what()).find("navfn"), std::string::npos) << error.what();
  }
  Poses plan;
  EXPECT_FALSE(loader_.createInstance(kOurs)->makePlan({}, {}, plan)) << "it is not initialized";
}

}  // namespace
}  // namespace grid_path_planner::nodes
