// The plugin that pluginlib loads for Move Base Flex, on a real costmap_2d.
#include <mbf_costmap_core/costmap_planner.h>
#include <mbf_msgs/GetPathResult.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "ros/support/costmap_fixture.h"

namespace grid_path_planner::nodes {

using mbf_msgs::GetPathResult;

namespace {

class MoveBaseFlexPlanner : public testing::Test {
 protected:
  MoveBaseFlexPlanner() : site_(test::siteMap(random_)) { site_.cells().resetMap(0, 0, 200, 200); }

  boost::shared_ptr<mbf_costmap_core::CostmapPlanner> planner(const std::string& name) {
    auto made = loader_.createInstance("grid_path_planner/GridPathPlanner");
    made->initialize(name, &site_.ros());
    return made;
  }

  // The goal lies in a lethal square of 1 m a side.
  void blockGoal() {
    for (unsigned row = 90; row < 110; ++row)
      for (unsigned column = 170; column < 190; ++column)
        site_.cells().setCost(column, row, costmap_2d::LETHAL_OBSTACLE);
  }

  std::mt19937 random_{11};
  pluginlib::ClassLoader<mbf_costmap_core::CostmapPlanner> loader_{
      "mbf_costmap_core", "mbf_costmap_core::CostmapPlanner"};
  test::Site site_;
  const geometry_msgs::PoseStamped start_ = test::stampedPose(1.0, 5.0);
  const geometry_msgs::PoseStamped goal_ = test::stampedPose(9.0, 5.0);
  std::vector<geometry_msgs::PoseStamped> plan_;
  double cost_ = 0.0;
  std::string message_;
};

TEST_F(MoveBaseFlexPlanner, AnswersWithOutcomesCostAndASentence) {
  const auto ours = planner("ours");
  const auto outcome = [&](const auto& start, const auto& goal, double tolerance = 0.0) {
    return ours->makePlan(start, goal, tolerance, plan_, cost_, message_);
  };
  EXPECT_EQ(outcome(start_, goal_), GetPathResult::SUCCESS);
  EXPECT_NEAR(cost_, 160.0, 1e-6) << "8 m of cells of 0.05 m and weight 1";
  EXPECT_EQ(message_.substr(0, 16), "a path of 8 m, c");
  EXPECT_EQ(plan_.size(), 161U);
  EXPECT_EQ(outcome(test::stampedPose(-1.0, 5.0), goal_), GetPathResult::INVALID_START);
  EXPECT_EQ(outcome(start_, test::stampedPose(11.0, 5.0)), GetPathResult::INVALID_GOAL);
  geometry_msgs::PoseStamped elsewhere = goal_;
  elsewhere.header.frame_id = "odom";
  EXPECT_EQ(outcome(start_, elsewhere), GetPathResult::TF_ERROR);
  EXPECT_EQ(message_, "the goal is in frame 'odom', the costmap in 'map'");
  blockGoal();
  EXPECT_EQ(outcome(start_, goal_), GetPathResult::INVALID_GOAL);
  EXPECT_TRUE(plan_.empty());
  EXPECT_EQ(outcome(start_, goal_, 1.0), GetPathResult::SUCCESS) << message_;
  for (unsigned row = 0; row < 200; ++row)
    site_.cells().setCost(100, row, costmap_2d::INSCRIBED_INFLATED_OBSTACLE);
  EXPECT_EQ(outcome(start_, test::stampedPose(7.0, 5.0)), GetPathResult::NO_PATH_FOUND);
}

TEST_F(MoveBaseFlexPlanner, IsNotInitializedBeforeThat) {
  const auto raw = loader_.createInstance("grid_path_planner/GridPathPlanner");
  EXPECT_EQ(raw->makePlan(start_, goal_, 0.0, plan_, cost_, message_),
            GetPathResult::NOT_INITIALIZED);
  EXPECT_FALSE(raw->cancel());
}

// A planner without a time limit that searches for many seconds: only cancel() ends it, whatever it is
// doing when that comes.
TEST_F(MoveBaseFlexPlanner, IsCancelledAtAnyTimeAndPlansAgain) {
  costmap_2d::Costmap2D& cells = site_.cells();
  cells.resizeMap(2000, 2000, 0.05, 0.0, 0.0);
  for (unsigned row = 0; row < 2000; ++row)
    for (unsigned column = 0; column < 2000; ++column)
      cells.setCost(column, row, static_cast<unsigned char>(random_() % 253));
  const auto slow = planner("slow");
  using Clock = std::chrono::steady_clock;
  double latest = 0.0;
  for (const int milliseconds : {0, 50, 200, 800}) {
    const Clock::time_point from = Clock::now() + std::chrono::milliseconds(milliseconds);
    std::atomic<bool> returned{false};
    std::thread canceller([&] {
      while (!returned) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (Clock::now() < from) continue;
        EXPECT_TRUE(slow->cancel());
      }
    });
    EXPECT_EQ(slow->makePlan(start_, test::stampedPose(99.0, 99.0), 0.0, plan_, cost_, message_),
              GetPathResult::CANCELED);
    latest = std::max(latest, std::chrono::duration<double>(Clock::now() - from).count());
    returned = true;
    canceller.join();
  }
  std::cout << "cancelled after " << 1e3 * latest << " ms at the latest\n";
  EXPECT_EQ(slow->makePlan(start_, test::stampedPose(1.5, 5.0), 0.0, plan_, cost_, message_),
            GetPathResult::SUCCESS);
}

}  // namespace
}  // namespace grid_path_planner::nodes
