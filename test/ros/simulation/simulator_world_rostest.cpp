// The simulator in a world: test/data/pool.sdf, a floor at z = -2 and a wall at x = 4.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/String.h>
#include <std_msgs/UInt32.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <cmath>

#include "ros/support/latest.h"
#include "ros/support/process.h"

namespace grid_path_planner::nodes {
namespace {

using nav_msgs::Odometry;
using sensor_msgs::CameraInfo;
using sensor_msgs::PointCloud2;
using test::Latest;
using test::Process;

std::vector<Eigen::Vector3d> pointsOf(const PointCloud2& cloud) {
  std::vector<Eigen::Vector3d> points;
  for (sensor_msgs::PointCloud2ConstIterator<float> at(cloud, "x"); at != at.end(); ++at)
    points.emplace_back(at[0], at[1], at[2]);
  return points;
}

Eigen::Vector3d positionOf(const Odometry& message) {
  const auto& p = message.pose.pose.position;
  return {p.x, p.y, p.z};
}

Eigen::Isometry3d isometryOf(const geometry_msgs::Transform& t) {
  return Eigen::Translation3d(t.translation.x, t.translation.y, t.translation.z) *
         Eigen::Quaterniond(t.rotation.w, t.rotation.x, t.rotation.y, t.rotation.z);
}

class SimulatorWorldTest : public testing::Test {
 protected:
  SimulatorWorldTest() { ros::param::del("/simulator"); }

  // Unless a test is about pictures they are tiny: ones of 320x240 take a Debug build seconds.
  void start(std::vector<std::string> arguments) {
    const bool about_pictures =
        std::any_of(arguments.begin(), arguments.end(),
                    [](const std::string& a) { return a.rfind("_camera_width", 0) == 0; });
    if (!about_pictures)
      arguments.insert(arguments.end(), {"_camera_width:=8", "_camera_height:=6"});
    arguments.push_back("--world=" GPP_TEST_DATA "/pool.sdf");
    simulator_ = std::make_unique<Process>("simulator", arguments);
    ASSERT_TRUE(truth_.waitForMoreThan(truth_.count()));
    ASSERT_TRUE(test::waitFor([&] { return commands_.getNumSubscribers() > 0; }));
  }

  // Drives ahead until the true position is one that `done` takes.
  template <class Done>
  bool driveUntil(double surge, Done done) {
    geometry_msgs::Twist message;
    message.linear.x = surge;
    return test::waitFor([&] {
      commands_.publish(message);
      const auto all = truth_.all();
      return !all.empty() && done(all.back());
    });
  }

  ros::NodeHandle nh_;
  Latest<Odometry> truth_{nh_, "ground_truth"};
  ros::Publisher commands_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 10);
  std::unique_ptr<Process> simulator_;
};

const std::vector<std::string> kSmallCamera = {"_camera_width:=40", "_camera_height:=30",
                                               "_camera_pitch:=0.4", "_camera_noise_base:=0.0",
                                               "_camera_noise_per_m2:=0.0"};

TEST_F(SimulatorWorldTest, TheCameraSeesTheWorldWhereTfSaysThatItIs) {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  Latest<PointCloud2> clouds(nh_, "depth_camera/points");
  start(kSmallCamera);
  ASSERT_TRUE(driveUntil(0.5, [](const Odometry& o) { return positionOf(o).x() > 0.5; }));
  const auto cloud = clouds.waitForMoreThan(clouds.count());
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->header.frame_id, "camera_optical_frame");
  EXPECT_EQ(cloud->width, 40u);
  EXPECT_EQ(cloud->height, 30u);
  EXPECT_FALSE(cloud->is_dense);
  ASSERT_TRUE(test::waitFor(
      [&] { return buffer.canTransform("map", cloud->header.frame_id, cloud->header.stamp); }));
  const Eigen::Isometry3d map_from_optical = isometryOf(
      buffer.lookupTransform("map", cloud->header.frame_id, cloud->header.stamp).transform);
  int on_wall = 0, on_floor = 0, elsewhere = 0;
  for (const Eigen::Vector3d& point : pointsOf(*cloud)) {
    if (!point.allFinite()) continue;
    EXPECT_GT(point.z(), 0.0) << "the optical axis looks ahead";
    const Eigen::Vector3d at = map_from_optical * point;
    if (std::abs(at.x() - 4.0) < 1e-3)
      ++on_wall;
    else if (std::abs(at.z() + 2.0) < 1e-3)
      ++on_floor;
    else
      ++elsewhere;
  }
  EXPECT_GT(on_wall, 100);
  EXPECT_GT(on_floor, 100);
  EXPECT_EQ(elsewhere, 0);
}

// A listener that clears its buffer as time jumps back would not get a static transform again.
TEST_F(SimulatorWorldTest, TransformsToTheCameraComeAgainAfterTimeJumpedBack) {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  const auto known = [&](double before) {
    return test::waitFor([&] {
      return buffer.canTransform("base_link", "camera_optical_frame", ros::Time(0)) &&
             buffer.lookupTransform("base_link", "camera_optical_frame", ros::Time(0))
                     .header.stamp.toSec() < before;
    });
  };
  start({"_start_time:=1000"});
  ASSERT_TRUE(known(2000.0));
  simulator_.reset();
  start({"_start_time:=1"});
  EXPECT_TRUE(known(500.0));
}

TEST_F(SimulatorWorldTest, CameraInfoSaysWhichPixelSeesWhichPoint) {
  Latest<PointCloud2> clouds(nh_, "depth_camera/points");
  Latest<CameraInfo> infos(nh_, "depth_camera/camera_info");
  start(kSmallCamera);
  std::optional<CameraInfo> info;
  const auto cloud = clouds.waitFor(0, [&](const PointCloud2& c) {
    for (const CameraInfo& i : infos.all())
      if (i.header.stamp == c.header.stamp) info = i;
    return info.has_value();
  });
  ASSERT_TRUE(cloud) << "with a camera_info of the same stamp";
  EXPECT_EQ(info->header.frame_id, cloud->header.frame_id);
  EXPECT_EQ(info->width, cloud->width);
  const std::vector<Eigen::Vector3d> points = pointsOf(*cloud);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    EXPECT_NEAR(info->K[0] * points[i].x() / points[i].z() + info->K[2],
                static_cast<double>(i % info->width), 1e-2);
    EXPECT_NEAR(info->K[4] * points[i].y() / points[i].z() + info->K[5],
                static_cast<double>(i / info->width), 1e-2);
  }
}

TEST_F(SimulatorWorldTest, PicturesComeAtTheirRateOfSimulatedTime) {
  Latest<PointCloud2> clouds(nh_, "depth_camera/points");
  start({"_camera_width:=8", "_camera_height:=6", "_camera_rate:=4", "_real_time_factor:=5",
         "_start_time:=100"});
  ASSERT_TRUE(test::waitFor([&] { return clouds.count() > 8; }));
  ros::Time before;
  for (const PointCloud2& cloud : clouds.all()) {
    const std::int64_t since = (cloud.header.stamp - ros::Time(100.0)).toNSec();
    EXPECT_EQ(since % 250000000, 0) << cloud.header.stamp;
    EXPECT_GT(cloud.header.stamp, before);
    before = cloud.header.stamp;
  }
}

// Pictures that take longer than their period hold simulated time back; none is left out. They take
// 1 ms or more, in a Debug build about a hundred times as long.
TEST_F(SimulatorWorldTest, TimeGoesSlowerWherePicturesTakeLonger) {
  Latest<CameraInfo> infos(nh_, "depth_camera/camera_info");
  Latest<rosgraph_msgs::Clock> clock(nh_, "/clock");
  Latest<PointCloud2> clouds(nh_, "depth_camera/points");
  start({"_camera_width:=160", "_camera_height:=120", "_camera_rate:=1000", "_time_step:=0.001",
         "_real_time_factor:=100"});
  ASSERT_TRUE(test::waitFor([&] { return clouds.count() > 0; }));
  const ros::SteadyTime begin = ros::SteadyTime::now();
  const std::size_t seen = infos.count();
  const ros::Time from = clock.all().back().clock;
  ASSERT_TRUE(test::waitFor([&] { return infos.count() > seen + 20; }));
  const double simulated = (clock.all().back().clock - from).toSec();
  EXPECT_LT(simulated, 20.0 * (ros::SteadyTime::now() - begin).toSec());
  const std::vector<CameraInfo> all = infos.all();
  for (std::size_t i = seen + 1; i < seen + 20; ++i)
    EXPECT_EQ((all[i].header.stamp - all[i - 1].header.stamp).toNSec(), 1000000);
}

TEST_F(SimulatorWorldTest, RunningIntoTheWorldEndsTheMotionAndIsPublishedByName) {
  Latest<std_msgs::UInt32> contacts(nh_, "contacts");
  Latest<std_msgs::String> touched(nh_, "contact");
  start({"_real_time_factor:=5"});
  const auto none = contacts.waitForMoreThan(0);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->data, 0u);
  EXPECT_EQ(touched.count(), 0u);
  ASSERT_TRUE(driveUntil(0.5, [](const Odometry& o) {
    return positionOf(o).x() > 3.7 - 1e-3 && o.twist.twist.linear.x == 0.0;
  }));
  EXPECT_NEAR(positionOf(truth_.all().back()).x(), 3.7, 1e-3) << "0.3 m before the wall";
  EXPECT_TRUE(contacts.waitFor(1, [](const std_msgs::UInt32& c) { return c.data == 1; }));
  const auto name = touched.waitForMoreThan(0);
  ASSERT_TRUE(name);
  EXPECT_EQ(name->data.find("wall"), 0u) << name->data;
  Latest<std_msgs::String> late(nh_, "contact");
  EXPECT_TRUE(late.waitForMoreThan(0)) << "latched";
  EXPECT_TRUE(simulator_->says("The vehicle has run into wall"));
}

TEST_F(SimulatorWorldTest, WithoutErrorsOdometryIsTheTruth) {
  Latest<Odometry> odom(nh_, "odom");
  start({"_initial_x:=-3.0", "_initial_yaw:=0.3"});
  ASSERT_TRUE(driveUntil(0.8, [](const Odometry& o) { return positionOf(o).x() > -2.5; }));
  const Odometry measured = *odom.waitForMoreThan(0);
  const auto truth =
      truth_.waitFor(0, [&](const Odometry& o) { return o.header.stamp == measured.header.stamp; });
  ASSERT_TRUE(truth);
  EXPECT_EQ(truth->header.frame_id, "map");
  EXPECT_EQ(truth->child_frame_id, "base_link");
  EXPECT_EQ(measured.header.frame_id, "odom");
  EXPECT_EQ(positionOf(measured), positionOf(*truth));
  EXPECT_EQ(measured.pose.pose.orientation.z, truth->pose.pose.orientation.z);
}

TEST_F(SimulatorWorldTest, OdometryThatErrsIsWhatTfCarries) {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  Latest<Odometry> odom(nh_, "odom");
  start({"_initial_x:=-3.0", "_odometry_drift:=0.3", "_real_time_factor:=3"});
  ASSERT_TRUE(driveUntil(0.8, [](const Odometry& o) { return positionOf(o).x() > -1.0; }));
  const Odometry measured = *odom.waitForMoreThan(0);
  const auto truth =
      truth_.waitFor(0, [&](const Odometry& o) { return o.header.stamp == measured.header.stamp; });
  ASSERT_TRUE(truth);
  EXPECT_GT((positionOf(measured) - positionOf(*truth)).norm(), 1e-3);
  EXPECT_EQ(positionOf(*truth).y(), 0.0) << "it drove straight ahead";
  ASSERT_TRUE(test::waitFor(
      [&] { return buffer.canTransform("map", "base_link", measured.header.stamp); }));
  const auto tf = buffer.lookupTransform("map", "base_link", measured.header.stamp).transform;
  EXPECT_NEAR(tf.translation.y, measured.pose.pose.position.y, 1e-9);
}

TEST(SimulatorWorld, AWorldThatCannotBeReadEndsItBeforeItStarts) {
  Process missing("simulator", {"--world=/no/such/world.sdf"});
  ASSERT_TRUE(missing.waitForExit());
  EXPECT_EQ(missing.exitCode(), 1);
  EXPECT_NE(missing.output().find("/no/such/world.sdf"), std::string::npos) << missing.output();
}

}  // namespace
}  // namespace grid_path_planner::nodes
