// path_planner while it is asked more than it can answer: the vehicle's map and path come first.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "grid_path_planner/ComparePlans.h"
#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {

using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using test::poseAt;
using test::waitFor;

// Free, 1 m cells. A search without a heuristic goes over all of them.
OccupancyGrid field(int side) {
  OccupancyGrid map(GridGeometry(side, side, 1.0));
  for (std::int8_t& value : map.values()) value = 0;
  return map;
}

// With a wall from the first row to all but the last.
OccupancyGrid divided(OccupancyGrid map) {
  for (int row = 0; row < map.height() - 1; ++row) map.row(row)[map.width() / 2] = 100;
  return map;
}

class LoadTest : public test::PlannerTest {
 protected:
  ~LoadTest() override {
    done_ = true;
    for (std::thread& client : clients_) client.join();
  }

  // Clients that ask one plan after the other, until the test ends.
  void startClients(int count, int side) {
    for (int i = 0; i < count; ++i)
      clients_.emplace_back([this, side] {
        nav_msgs::GetPlan call;
        call.request.start = poseAt(0.5, 0.5);
        call.request.goal = poseAt(side - 0.5, side - 0.5);
        while (!done_ && ros::service::call("/path_planner/make_plan", call)) ++answers_;
      });
  }

  static ComparePlans comparison(std::size_t questions, int side) {
    ComparePlans call;
    call.request.start = poseAt(0.5, 0.5);
    call.request.goal = poseAt(side - 0.5, side - 0.5);
    call.request.planners.assign(questions, "dijkstra");
    return call;
  }

  std::atomic<bool> done_{false};
  std::atomic<int> answers_{0};

 private:
  std::vector<std::thread> clients_;
};

// Four clients kept the thread that follows the map busy, and each new map went to the end of its
// queue: no planning map in 15 s, and the vehicle drove on towards the wall. The questions of clients have a thread of
// their own, so that few of them are answered meanwhile: the vehicle waits for none.
TEST_F(LoadTest, ABlockedPathIsReplannedWhateverIsAsked) {
  // A costmap and a plan, beside a thread that answers questions of the same size: the vehicle waits for none of these.
  constexpr int kSide = 1500, kMostAnswers = 20;
  startPlanner({"_planner:=dijkstra", "_timeout:=60", "_replan_period:=0"});
  placeVehicle(0.5, kSide / 2 + 0.5);
  const OccupancyGrid open = field(kSide), wall = divided(open);
  publishMap(open);
  sendGoal(poseAt(kSide - 0.5, kSide / 2 + 0.5));
  ASSERT_EQ(answer_.status, "FOUND") << answer_.message;
  startClients(4, kSide);
  ASSERT_TRUE(waitFor([this] { return answers_ > 0; }));
  const std::size_t paths = paths_.count(), maps = planning_maps_.count();
  const int before = answers_;
  ASSERT_TRUE(waitFor([&] {
    maps_.publish(occupancyToMessage(wall, "map", ros::Time::now()));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return paths_.count() > paths;
  })) << "not replanned; planning maps: "
      << planning_maps_.count() - maps << ", answers " << answers_;
  EXPECT_LE(answers_ - before, kMostAnswers);
  EXPECT_TRUE(passes(paths_.all().back(), kSide / 2 + 0.5, kSide - 0.5, 2.0));
}

TEST_F(LoadTest, AComparisonOfTooManyQuestionsIsRefused) {
  startPlanner();
  publishMap(field(10));
  ComparePlans call = comparison(1001, 10);
  ASSERT_TRUE(ros::service::call("/path_planner/compare_plans", call));
  ASSERT_EQ(call.response.results.size(), 1u);
  ASSERT_EQ(call.response.paths.size(), 1u);
  EXPECT_EQ(call.response.results[0].status, "INVALID_REQUEST");
  EXPECT_NE(call.response.results[0].message.find("at most 1000"), std::string::npos);
  call = comparison(1000, 10);
  ASSERT_TRUE(ros::service::call("/path_planner/compare_plans", call));
  EXPECT_EQ(call.response.results.size(), 1000u);
}

// Both threads of the services compared for clients that were gone, minutes long. Each client goes while its comparison,
// of minutes, is computed.
TEST_F(LoadTest, AComparisonEndsWithItsClient) {
  constexpr int kSide = 1000;
  startPlanner();
  publishMap(field(kSide));
  for (int i = 0; i < 4; ++i) {
    ros::ServiceClient client =
        nh_.serviceClient<ComparePlans>("/path_planner/compare_plans", true);
    std::thread asks([client]() mutable {
      ComparePlans call = comparison(1000, kSide);
      client.call(call);
    });
    const double begin = planner_->processorSeconds();
    EXPECT_TRUE(waitFor([&] { return planner_->processorSeconds() > begin + 0.5; }))
        << "it compares";
    client.shutdown();
    asks.join();
  }
  std::atomic<bool> answered{false};
  std::thread asks([&] {
    nav_msgs::GetPlan call;
    call.request.start = call.request.goal = poseAt(0.5, 0.5);
    answered = ros::service::call("/path_planner/make_plan", call);
  });
  EXPECT_TRUE(waitFor([&] { return answered.load(); })) << "it compares for nobody";
  if (!answered) planner_->signal(SIGKILL);
  asks.join();
  EXPECT_TRUE(waitFor([&] {
    const double begin = planner_->processorSeconds();
    std::this_thread::sleep_for(std::chrono::seconds(1));
    return planner_->processorSeconds() < begin + 0.2;
  })) << "it goes on comparing";
}

}  // namespace
}  // namespace grid_path_planner::nodes
