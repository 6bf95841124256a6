// A vehicle whose driver publishes odom -> base_link, from an origin of its own: map -> odom joined the map to this node's
// odometry, so that the vehicle was somewhere else in tf, OK.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include "ros/simulation/transform_message.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "ros/support/sensor_stream.h"
#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using Eigen::Isometry3d;
using test::contains;
using test::waitFor;

class LocalizerBesideADriver : public testing::Test {
 protected:
  LocalizerBesideADriver() { ros::param::del("/vehicle_localizer"); }

  Isometry3d truthAt(const ros::Time& stamp) const {
    const double t = live_.secondsAt(stamp);
    return Eigen::Translation3d(stream_.positionAt(t)) * stream_.trajectory.stateAt(t).attitude;
  }
  // As the driver would, without errors.
  void drive() {
    const ros::Time now = ros::Time::now();
    auto message = transformOf("odom", "base_link", map_from_odometry_.inverse() * truthAt(now));
    message.header.stamp = now;
    broadcaster_.sendTransform(message);
  }
  // Metres by which tf has a point of the vehicle, a metre ahead, elsewhere; none where it does not know.
  std::optional<double> error() const {
    try {
      const auto found = buffer_.lookupTransform("map", "base_link", ros::Time(0));
      const auto& p = found.transform.translation;
      const auto& q = found.transform.rotation;
      const Isometry3d pose =
          Eigen::Translation3d(p.x, p.y, p.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z);
      const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();
      return (pose * ahead - truthAt(found.header.stamp) * ahead).norm();
    } catch (const tf2::TransformException&) {
      return {};
    }
  }
  bool isSaid(const std::string& text) const {
    const auto all = statuses_.all();
    return !all.empty() && contains(all.back().data, text);
  }

  const Isometry3d map_from_odometry_ =
      Eigen::Translation3d(7.0, -4.0, 1.0) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ());
  ros::NodeHandle nh_;
  test::Latest<std_msgs::String> statuses_{nh_, "localization_status"};
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_};
  tf2_ros::TransformBroadcaster broadcaster_;
  test::SensorStream stream_{nh_};
  test::LiveStream live_{stream_};
  test::Process node_{"vehicle_localizer", {"_publish_odom_to_base:=false"}};
};

TEST_F(LocalizerBesideADriver, TheMapIsJoinedToItsOdometry) {
  ASSERT_TRUE(waitFor([&] { return isSaid("DEGRADED: No map -> odom is published"); }))
      << node_.output();
  EXPECT_FALSE(buffer_._frameExists("odom"));
  ASSERT_TRUE(waitFor([&] {
    drive();
    return isSaid("OK:") && error();
  })) << node_.output();
  double largest = 0.0;
  int looked = 0;
  EXPECT_TRUE(waitFor([&] {
    drive();
    largest = std::max(largest, error().value_or(0.0));
    return ++looked > 50;
  }));
  EXPECT_LT(largest, 0.3);
  ASSERT_TRUE(waitFor([&] { return isSaid("No map -> odom is published"); })) << "it has ceased";
}

}  // namespace
}  // namespace grid_path_planner::nodes
