// The image camera of the simulator, in test/data/pool.sdf: a floor and a wall.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "grid_path_planner/simulation/world.h"
#include "ros/simulation/simulator_options.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "simulation/camera/image_camera.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using nav_msgs::Odometry;
using sensor_msgs::CameraInfo;
using sensor_msgs::Image;
using test::Latest;
using test::Process;

constexpr char kWorld[] = GPP_TEST_DATA "/pool.sdf";

bool isPublished(const std::string& topic) {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  return std::any_of(topics.begin(), topics.end(),
                     [&](const ros::master::TopicInfo& info) { return info.name == topic; });
}

// The pose of a level vehicle.
simulation::VehicleState stateOf(const Odometry& odometry) {
  simulation::VehicleState state;
  const auto& p = odometry.pose.pose.position;
  const auto& q = odometry.pose.pose.orientation;
  state.position = {p.x, p.y, p.z};
  state.yaw = 2.0 * std::atan2(q.z, q.w);
  return state;
}

class SimulatorCamera : public testing::Test {
 protected:
  SimulatorCamera() { ros::param::del("/simulator"); }

  void start(std::vector<std::string> arguments) {
    for (const char* argument : {"_camera_width:=8", "_camera_height:=6", "_start_time:=100"})
      arguments.push_back(argument);
    arguments.push_back(std::string("--world=") + kWorld);
    simulator_ = std::make_unique<Process>("simulator", arguments);
    ASSERT_TRUE(truth_.waitForMoreThan(truth_.count())) << simulator_->output();
  }
  std::optional<Odometry> truthAt(const ros::Time& stamp) const {
    return truth_.waitFor(0, [&](const Odometry& o) { return o.header.stamp == stamp; });
  }

  ros::NodeHandle nh_;
  Latest<Odometry> truth_{nh_, "ground_truth"};
  std::unique_ptr<Process> simulator_;
};

TEST_F(SimulatorCamera, IsOffByDefault) {
  start({});
  EXPECT_FALSE(isPublished("/camera/image_raw"));
  Process blind("simulator", {"__name:=blind", "_image_camera_enabled:=true"});
  ASSERT_TRUE(blind.waitForExit());
  EXPECT_EQ(blind.exitCode(), 1);
  EXPECT_TRUE(blind.says("image_camera_enabled needs a world")) << blind.output();
}

// While the vehicle turns: an image is that of the pose at its stamp, bit for bit but for the rounding of
// a yaw that went through a quaternion.
TEST_F(SimulatorCamera, AnImageShowsThePoseAtItsStamp) {
  Latest<Image> images(nh_, "camera/image_raw");
  Latest<CameraInfo> infos(nh_, "camera/camera_info");
  start({"_image_camera_enabled:=true", "_image_camera_width:=32", "_image_camera_height:=24",
         "_image_camera_pitch:=0.2"});
  // Not before: /clock jumps back to its beginning there, which empties a buffer, sometimes after the first image.
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(test::waitFor(
      [&] { return buffer.canTransform("map", "image_camera_optical_frame", ros::Time(0)); }));
  const ros::Time known =
      buffer.lookupTransform("map", "image_camera_optical_frame", ros::Time(0)).header.stamp;
  ros::Publisher command = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  geometry_msgs::Twist turn;
  turn.angular.z = 0.5;
  ASSERT_TRUE(test::waitFor([&] {
    command.publish(turn);
    const auto all = images.all();
    return all.size() > 5 && all[all.size() - 5].header.stamp >= known &&
           std::abs(stateOf(truth_.all().back()).yaw) > 0.3;
  }));

  simulation::ImageCameraOptions options = vehicleImageCamera();
  options.enabled = true;
  options.width = 32;
  options.height = 24;
  options.mounting.pitch = 0.2;
  const simulation::ImageCamera camera(simulation::readWorld(kWorld), options);
  double least_yaw = 10.0, largest_yaw = -10.0;
  for (const Image& image : images.all()) {
    ASSERT_EQ(image.encoding, "rgb8");
    ASSERT_EQ(image.header.frame_id, "image_camera_optical_frame");
    const auto truth = truthAt(image.header.stamp);
    ASSERT_TRUE(truth);
    const simulation::VehicleState state = stateOf(*truth);
    least_yaw = std::min(least_yaw, state.yaw);
    largest_yaw = std::max(largest_yaw, state.yaw);
    const double seconds = image.header.stamp.toSec() - 100.0;
    const auto frame = static_cast<std::uint64_t>(std::floor(seconds * 5.0 + 1e-6));
    std::vector<std::uint8_t> expected;
    camera.render(mapFromBase(state) * camera.baseFromOptical(), frame, expected);
    ASSERT_EQ(image.data.size(), expected.size());
    int other = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
      other += std::abs(static_cast<int>(image.data[i]) - expected[i]) > 1;
    EXPECT_LT(other, 10) << "of " << expected.size() << " at " << seconds << " s";
    if (image.header.stamp >= known) {
      EXPECT_TRUE(test::waitFor([&] {
        return buffer.canTransform("map", "image_camera_optical_frame", image.header.stamp);
      }));
    }
  }
  EXPECT_GT(largest_yaw - least_yaw, 0.1);
  const auto info = infos.waitForMoreThan(0);
  ASSERT_TRUE(info);
  EXPECT_NEAR(info->K[0], 16.0 / std::tan(0.6), 1e-9);
  EXPECT_EQ(info->K[2], 15.5);
  EXPECT_TRUE(images.waitFor(
      0, [&](const Image& image) { return image.header.stamp == infos.all()[0].header.stamp; }));
}

// While the vehicle turns: nothing, then images, one of them again and again, and black ones.
TEST_F(SimulatorCamera, AFaultFileCutsItFreezesItAndMakesItBlack) {
  const test::TemporaryFolder folder;
  const std::string faults = folder.write("faults.yaml",
                                          "faults:\n"
                                          "  - {sensor: camera, from: 0, to: 1, kind: cut}\n"
                                          "  - {sensor: camera, from: 3, to: 4, kind: frozen}\n"
                                          "  - {sensor: camera, from: 4, to: 5, kind: nan}\n");
  Latest<Image> images(nh_, "camera/image_raw");
  start({"_image_camera_enabled:=true", "_image_camera_width:=32", "_image_camera_height:=24",
         "--sensor-faults=" + faults});
  ros::Publisher command = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  geometry_msgs::Twist turn;
  turn.angular.z = 0.5;
  ASSERT_TRUE(test::waitFor([&] {
    command.publish(turn);
    ros::WallDuration(0.02).sleep();
    const auto all = images.all();
    return !all.empty() && all.back().header.stamp.toSec() > 105.5;
  }));
  std::vector<std::uint8_t> before;
  int frozen = 0, black = 0, sound = 0;
  for (const Image& image : images.all()) {
    const double t = image.header.stamp.toSec() - 100.0;
    const bool is_black = std::all_of(image.data.begin(), image.data.end(),
                                      [](std::uint8_t value) { return value == 0; });
    EXPECT_GE(t, 1.0);
    EXPECT_EQ(is_black, t >= 4.0 && t < 5.0) << t;
    const bool is_frozen = t >= 3.0 && t < 4.0;
    if (is_frozen && !before.empty()) {
      EXPECT_EQ(image.data, before) << t;
    } else if (!is_black) {
      EXPECT_NE(image.data, before) << t;
    }
    before = image.data;
    ++(is_black ? black : is_frozen ? frozen : sound);
  }
  EXPECT_GT(frozen, 0);
  EXPECT_GT(black, 0);
  EXPECT_GT(sound, 1);
}

// An image takes some 0.1 s and is due in each step of 0.01 s: most are left out, and no step waits.
TEST_F(SimulatorCamera, NothingWaitsForARendering) {
  Latest<sensor_msgs::Imu> imu(nh_, "imu/data");
  start({"_image_camera_enabled:=true", "_image_camera_rate:=100", "_imu_enabled:=true",
         "_image_camera_width:=1280", "_image_camera_height:=960"});
  Latest<Image> images(nh_, "camera/image_raw");
  ASSERT_TRUE(images.waitForMoreThan(1));
  const std::vector<Image> all = images.all();
  const double apart = (all[1].header.stamp - all[0].header.stamp).toSec();
  EXPECT_GT(apart, 0.015) << "images were left out";
  ASSERT_TRUE(imu.waitFor(
      0, [&](const sensor_msgs::Imu& unit) { return unit.header.stamp >= all[1].header.stamp; }));
  const auto units = imu.all();
  for (std::size_t i = 1; i < units.size(); ++i)
    EXPECT_EQ((units[i].header.stamp - units[i - 1].header.stamp).toNSec(), 10000000) << i;
}

}  // namespace
}  // namespace grid_path_planner::nodes
