// path_planner where there is not enough memory for a map.
#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::poseAt;
using test::waitFor;

class MemoryTest : public test::PlannerTest {};

// Free, 1 m cells.
grid::OccupancyGrid emptyMap(int side) {
  grid::OccupancyGrid map(grid::GridGeometry(side, side, 1.0));
  for (std::int8_t& value : map.values()) value = 0;
  return map;
}

// A path_planner that may take so many KiB of address space. std::bad_alloc ended it.
std::vector<std::string> limitedTo(int kibibytes, const std::string& arguments) {
  return {"sh", "-c",
          "ulimit -v " + std::to_string(kibibytes) +
              " && exec " GPP_DEVEL
              "/lib/grid_path_planner/path_planner _planner:=dijkstra "
              "_timeout:=0 " +
              arguments};
}

// A request without memory is answered by a status, or the node ends in order, where the map before it had failed, too. Here
// std::bad_alloc ended it by a crash. One that is started again, as by respawn, plans.
TEST_F(MemoryTest, MemoryThatIsNotThereIsAStatusOrAnEndInOrder) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "shadow memory takes the address space that the limit is on";
#endif
  constexpr int kSide = 12000;  // cells; a search takes more than the limit below
  for (const char* limit : {"_memory_limit:=0", "_memory_limit:=1000000"}) {
    startPlanner(std::make_unique<test::Process>(limitedTo(2500000, limit)));
    maps_.publish(occupancyToMessage(emptyMap(kSide), "map", ros::Time::now()));
    nav_msgs::GetPlan call;
    call.request.start = poseAt(0.5, 0.5);
    call.request.goal = poseAt(kSide - 0.5, kSide - 0.5);
    const std::size_t told = statistics_.count();
    std::vector<PlanStatistics> answers;
    ASSERT_TRUE(waitFor([&] {
      ros::service::call("/path_planner/make_plan", call);  // fails where the node ends meanwhile
      const auto all = statistics_.all();
      std::copy_if(all.begin() + static_cast<std::ptrdiff_t>(told), all.end(),
                   std::back_inserter(answers),
                   [](const PlanStatistics& answer) { return answer.status != "NO_MAP"; });
      return !planner_->running() || !answers.empty();
    }));
    for (const PlanStatistics& answer : answers) {
      EXPECT_EQ(answer.status, "INVALID_REQUEST") << answer.message;
      EXPECT_NE(answer.message.find("memory"), std::string::npos) << answer.message;
    }
    planner_->end(SIGINT);
    EXPECT_EQ(planner_->exitCode(), 0);
    ASSERT_TRUE(waitFor([this] { return maps_.getNumSubscribers() == 0; }));
    startPlanner();
    publishMap(emptyMap(10));
    makePlan(poseAt(0.5, 0.5), poseAt(9.5, 9.5));
    EXPECT_EQ(answer_.status, "FOUND") << answer_.message;
    planner_.reset();
    ASSERT_TRUE(waitFor([this] { return maps_.getNumSubscribers() == 0; }));
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
