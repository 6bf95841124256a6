// What is told of inputs that have ceased, and of poses that cannot be published.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <tf2_ros/transform_broadcaster.h>

#include "grid_path_planner/SetPose.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "ros/support/sensor_stream.h"
#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;
using test::contains;
using test::waitFor;

class LocalizerInputs : public testing::Test {
 protected:
  LocalizerInputs() { ros::param::del("/vehicle_localizer"); }

  // The newest of what is diagnosed of an input.
  DiagnosticStatus diagnosed(const std::string& input) const {
    const std::vector<DiagnosticArray> all = diagnostics_.all();
    for (auto array = all.rbegin(); array != all.rend(); ++array)
      for (const DiagnosticStatus& status : array->status)
        if (status.name == "vehicle_localizer: " + input) return status;
    DiagnosticStatus none;
    none.level = DiagnosticStatus::STALE;
    return none;
  }
  bool isOnce(const std::string& input, int level, const std::string& sentence) const {
    return waitFor([&] {
      const DiagnosticStatus status = diagnosed(input);
      return status.level == level && contains(status.message, sentence);
    });
  }
  bool hasStatus(const std::string& text) const {
    return waitFor([&] {
      const auto all = statuses_.all();
      return !all.empty() && contains(all.back().data, text);
    });
  }

  ros::NodeHandle nh_;
  test::Latest<DiagnosticArray> diagnostics_{nh_, "/diagnostics"};
  test::Latest<std_msgs::String> statuses_{nh_, "localization_status"};
  test::SensorStream stream_{nh_};
  test::LiveStream live_{stream_};
  test::Process node_{"vehicle_localizer", {}};
};

TEST_F(LocalizerInputs, ThatHaveCeasedAreSilentAndAPoseThatWasSetIsNot) {
  ASSERT_TRUE(hasStatus("OK:")) << node_.output();
  SetPose call;
  const ros::Time now = ros::Time::now();
  call.request.pose = stream_.marker(now, live_.secondsAt(now));
  ASSERT_TRUE(ros::service::call("vehicle_localizer/set_pose", call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  for (const char* input : {"IMU", "DVL", "depth", "USBL"})
    EXPECT_TRUE(isOnce(input, DiagnosticStatus::OK, "used")) << input;
  stream_.sends_imu = stream_.sends_dvl = stream_.sends_fixes = false;
  for (const char* input : {"IMU", "DVL", "depth"})
    EXPECT_TRUE(isOnce(input, DiagnosticStatus::WARN, "silent")) << input;
  EXPECT_TRUE(isOnce(nameOf(localization::Source::SET_POSE), DiagnosticStatus::OK, "used"));
  EXPECT_TRUE(isOnce(nameOf(localization::Source::HEADING), DiagnosticStatus::OK, "not heard"));
}

// It said OK while nothing was published.
TEST_F(LocalizerInputs, APoseThatCannotBePublishedIsToldByTheStatus) {
  ASSERT_TRUE(hasStatus("OK:")) << node_.output();
  tf2_ros::TransformBroadcaster broadcaster;
  EXPECT_TRUE(waitFor([&] {
    geometry_msgs::TransformStamped far = stream_.frames(ros::Time::now()).front();  // imu_link
    far.transform.translation.x = 2000.0;
    broadcaster.sendTransform(far);
    const auto all = statuses_.all();
    return contains(all.back().data, "DEGRADED: No pose is published: ");
  })) << node_.output();
  EXPECT_TRUE(hasStatus("OK:")) << node_.output();
}

}  // namespace
}  // namespace grid_path_planner::nodes
