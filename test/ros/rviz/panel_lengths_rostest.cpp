// Messages of 200 bytes to the panel that claim to hold gigabytes, for which rviz made room.
#include <actionlib_msgs/GoalStatusArray.h>
#include <dynamic_reconfigure/Config.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sys/resource.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/PlanPathAction.h"
#include "ros/rviz/panel_window.h"
#include "ros/support/raw_bytes.h"

namespace grid_path_planner::nodes {
namespace {

using test::RawBytes;

constexpr std::size_t kClaimedBytes = std::size_t{1} << 30;

// What this process held at most, in bytes.
std::size_t peakOfThisProcess() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

class PanelLengths : public testing::Test {
 protected:
  // An array of elements of `size` bytes, whose length is `from_end` bytes before the end.
  template <class Message>
  void tellLie(const std::string& topic, std::size_t size, std::size_t from_end) {
    const ros::Publisher publisher = nh_.advertise<RawBytes<Message>>(topic, 10);
    ASSERT_TRUE(window_.waitFor([&] { return publisher.getNumSubscribers() > 0; })) << topic;
    const std::size_t before = peakOfThisProcess();
    const auto claimed = static_cast<std::uint32_t>(kClaimedBytes / size);
    publisher.publish(RawBytes<Message>{test::lyingBytes<Message>(claimed, from_end)});
    // What roscpp sends in one turn comes before what is given to it afterwards.
    hear("first");
    hear("second");
    EXPECT_LT(peakOfThisProcess(), before + kClaimedBytes / 2) << topic;
  }

  void hear(const std::string& sentence) {
    NavigatePathActionResult result;
    result.result.status = "ARRIVED";
    result.result.message = std::to_string(++heard_) + " " + sentence;
    results_.publish(RawBytes<NavigatePathActionResult>{test::bytesOfMessage(result)});
    EXPECT_TRUE(window_.waitFor([&] { return window_.shows(result.result.message); }));
  }

  int heard_ = 0;
  ros::NodeHandle nh_;
  test::PanelWindow window_;
  ros::Publisher results_ =
      nh_.advertise<RawBytes<NavigatePathActionResult>>("navigate_path/result", 10);
};

TEST_F(PanelLengths, ThatLieTakeNoMemory) {
  ASSERT_TRUE(window_.waitFor([&] { return results_.getNumSubscribers() > 0; }));
  tellLie<actionlib_msgs::GoalStatusArray>("plan_path/status", sizeof(actionlib_msgs::GoalStatus),
                                           4);
  tellLie<actionlib_msgs::GoalStatusArray>("navigate_path/status",
                                           sizeof(actionlib_msgs::GoalStatus), 4);
  tellLie<PlanPathActionResult>("plan_path/result", 4, 4);
  tellLie<NavigatePathActionResult>("navigate_path/result", 4, 4 + 2 * 8);
  tellLie<dynamic_reconfigure::Config>("path_planner/parameter_updates",
                                       sizeof(dynamic_reconfigure::GroupState), 4);
}

}  // namespace
}  // namespace grid_path_planner::nodes
