#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "ros/input/frame_lookup.h"

namespace grid_path_planner::nodes {
namespace {

// What the fuzzer found: tf2 subtracts the times for the text of its error, and roscpp throws another where they are 2^31 s
// apart. A goal stamped 2065 was given up without a word to who had sent it.
TEST(FrameLookup, SaysThatATimeFarFromAllOfTfIsNoneOfIt) {
  ros::Time::init();
  for (const auto& [known, asked] : {std::pair<std::uint32_t, std::uint32_t>{10, 3000000000},
                                     std::pair<std::uint32_t, std::uint32_t>{3000000000, 10}}) {
    FrameLookup lookup;
    for (std::uint32_t second : {known, known + 1}) {
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = ros::Time(second, 0);
      transform.header.frame_id = "map";
      transform.child_frame_id = "odom";
      transform.transform.rotation.w = 1.0;
      lookup.buffer().setTransform(transform, "test");
    }
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = "odom";
    pose.header.stamp = ros::Time(asked, 0);
    pose.pose.orientation.w = 1.0;
    for (const Moving moving : {Moving::NO, Moving::AT_STAMP})
      EXPECT_THROW(lookup.place(pose, {"map", 0.5, moving}), TransformError) << asked;
  }
}

geometry_msgs::TransformStamped link(const std::string& parent, const std::string& child,
                                     double stamp = 10.0, double x = 0.0) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(stamp);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.rotation.w = 1.0;
  return transform;
}

void join(FrameLookup& lookup, const std::string& parent, const std::string& child) {
  lookup.buffer().setTransform(link(parent, child), "test", true);
}

geometry_msgs::PoseStamped poseIn(const std::string& frame, double x, double stamp = 0.0) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = frame;
  pose.header.stamp = ros::Time(stamp);
  pose.pose.position.x = x;
  pose.pose.orientation.w = 1.0;
  return pose;
}

// earth -> map -> odom -> base_link -> camera, and map -> dock, of which only earth and the camera stand still. The
// vehicle drives at 1 m/s from x = 8 at 8 s to 10 at 10 s, and odom drifts as fast backwards.
class Place : public testing::Test {
 protected:
  Place() {
    join(lookup_, "earth", "map");
    join(lookup_, "base_link", "camera");
    for (const double second : {8.0, 9.0, 10.0}) {
      for (const auto& moving :
           {link("map", "odom", second, -second), link("odom", "base_link", second, 2.0 * second),
            link("map", "dock", second, 5.0)})
        lookup_.buffer().setTransform(moving, "test");
    }
    at(10.0);
  }
  void at(double now) {
    ros::Time::init();
    ros::Time::setNow(ros::Time(now));
  }

  double place(const geometry_msgs::PoseStamped& pose, Moving moving, double max_age = 0.5) const {
    return lookup_.place(pose, {"map", max_age, moving, "base_link"}).position.x();
  }
  std::string refusal(const geometry_msgs::PoseStamped& pose, Moving moving) const {
    try {
      return "placed at " + std::to_string(place(pose, moving));
    } catch (const TransformError& error) {
      return error.what();
    }
  }

  FrameLookup lookup_;
};

// What was seen: path_planner planned to a goal in the frame of a dock that nobody had seen for 40 s, and found a path
// there without a word.
TEST_F(Place, NothingIsPlacedByATransformThatHasCeased) {
  at(10.4);
  EXPECT_EQ(place(poseIn("dock", 1.0), Moving::WITH_VEHICLE), 6.0);
  at(50.0);
  for (const Moving moving : {Moving::NO, Moving::AT_STAMP, Moving::WITH_VEHICLE}) {
    EXPECT_EQ(refusal(poseIn("dock", 1.0), moving), "the transform from dock to map is 40.0 s old");
    EXPECT_EQ(refusal(poseIn("camera", 1.0), moving),
              "the transform from camera to map is 40.0 s old");
    EXPECT_EQ(refusal(poseIn("base_link", 1.0), moving),
              "the pose of base_link in map is 40.0 s old");
    EXPECT_EQ(place(poseIn("earth", 1.0), moving), 1.0) << "a static one has no age";
    EXPECT_EQ(place(poseIn("map", 1.0), moving), 1.0);
    EXPECT_EQ(place(poseIn("", 1.0), moving), 1.0) << "in the map";
  }
  at(4294967295.0);
  EXPECT_THROW(place(poseIn("dock", 1.0), Moving::NO), TransformError);
}

TEST_F(Place, AFrameThatMovesWithTheVehicleIsWhereItWasAtTheStamp) {
  EXPECT_EQ(place(poseIn("base_link", 1.0, 9.0), Moving::WITH_VEHICLE), 10.0);
  EXPECT_EQ(place(poseIn("camera", 1.0, 8.5), Moving::WITH_VEHICLE), 9.5);
  EXPECT_EQ(place(poseIn("camera", 1.0), Moving::WITH_VEHICLE), 11.0) << "a stamp of 0 is now";
  EXPECT_EQ(place(poseIn("odom", 12.0, 8.0), Moving::WITH_VEHICLE), 2.0)
      << "odom stands: where it is in the map is known best by the newest";
  EXPECT_EQ(place(poseIn("odom", 12.0, 8.0), Moving::AT_STAMP), 4.0) << "what was measured then";
  EXPECT_EQ(place(poseIn("odom", 12.0, 8.0), Moving::NO), 2.0);
}

// One hour old, or of a clock that is six hours ahead.
TEST_F(Place, AStampOfAnotherTimeCountsWhereTheFrameMoves) {
  at(4000.0);
  for (const double second : {3999.0, 4000.0}) {
    lookup_.buffer().setTransform(link("map", "odom", second), "test");
    lookup_.buffer().setTransform(link("odom", "base_link", second), "test");
  }
  for (const double stamp : {400.0, 25600.0}) {
    EXPECT_EQ(place(poseIn("map", 3.0, stamp), Moving::WITH_VEHICLE), 3.0);
    EXPECT_EQ(place(poseIn("odom", 3.0, stamp), Moving::WITH_VEHICLE), 3.0);
    EXPECT_THROW(place(poseIn("camera", 3.0, stamp), Moving::WITH_VEHICLE), TransformError);
  }
  EXPECT_EQ(refusal(poseIn("camera", 3.0, 25600.0), Moving::WITH_VEHICLE),
            "the transform from camera to map is 21600.0 s old at the stamp");
  EXPECT_EQ(place(poseIn("camera", 3.0, 4000.4), Moving::WITH_VEHICLE), 3.0)
      << "tf is a little later than the message";
  EXPECT_THROW(place(poseIn("camera", 3.0, 4000.4), Moving::AT_STAMP, 0.0), TransformError)
      << "what was measured waits";
}

// Localization stamps its transforms ahead so that nobody waits for them; a vehicle's pose ahead is of another clock, and
// would count as new for as long after it ceased.
TEST_F(Place, OneStampedAheadIsNotOld) {
  at(8.0);
  EXPECT_EQ(place(poseIn("odom", 12.0), Moving::WITH_VEHICLE), 2.0);
  EXPECT_THROW(place(poseIn("base_link", 12.0), Moving::WITH_VEHICLE), TransformError);
  at(9.6);
  EXPECT_EQ(place(poseIn("base_link", 0.0), Moving::WITH_VEHICLE), 10.0);
  EXPECT_NEAR(lookup_.placeVehicle({"map", 0.5, Moving::WITH_VEHICLE, "base_link"}).age, -0.4,
              1e-6);
}

TEST_F(Place, APathHasItsPosesInOneFrame) {
  nav_msgs::Path path;
  path.header.frame_id = "odom";
  path.poses = {poseIn("", 12.0), poseIn("dock", 1.0), poseIn("map", 7.0), poseIn("/odom", 13.0)};
  const path::Path placed = lookup_.place(path, {"map", 0.5, Moving::WITH_VEHICLE, "base_link"});
  EXPECT_EQ(placed.frame_id, "map");
  ASSERT_EQ(placed.poses.size(), 4u);
  const double expected[] = {2.0, 6.0, 7.0, 3.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(placed.poses[i].position.x(), expected[i]) << i;
  path.header.frame_id = "mars";
  EXPECT_THROW(lookup_.place(path, {"map", 0.5, Moving::WITH_VEHICLE, "base_link"}),
               base::InputError);
}

// local_planner placed it once and flew it, where navigate_path refused it.
TEST_F(Place, APathThatMovesWithTheVehicleIsRefusedAndAGoalIsNot) {
  const Placing by{"map", 0.5, Moving::WITH_VEHICLE, "base_link"};
  for (const char* frame : {"base_link", "camera"}) {
    nav_msgs::Path path;
    path.header.frame_id = frame;
    path.poses = {poseIn("", 1.0)};
    EXPECT_THROW(lookup_.place(path, by), base::InputError) << frame;
    path::Path of_file;
    of_file.frame_id = frame;
    EXPECT_THROW(lookup_.place(of_file, by), base::InputError) << frame;
    EXPECT_EQ(lookup_.place(poseIn(frame, 1.0), by).position.x(), 11.0) << frame;
  }
}

// The tf of utm is millions of metres from the map; one whose quaternion has nine digits turned it by centimetres there.
TEST(TransformsOfUtm, LeadToTheMillimetre) {
  FrameLookup lookup;
  TransformStamps stamps;
  geometry_msgs::TransformStamped utm = link("utm", "map");
  utm.transform.translation.x = 500000.0;
  utm.transform.translation.y = 4500000.0;
  utm.transform.rotation.z = 0.149438132;  // yaw 0.3
  utm.transform.rotation.w = 0.988771078;
  ASSERT_EQ(insertTransform(lookup.buffer(), stamps, utm, "/test", true, ros::Time(10.0)), "");
  geometry_msgs::PoseStamped goal = poseIn("utm", 500006.46061108634);
  goal.pose.position.y = 4500006.1855076095;
  goal.pose.orientation = utm.transform.rotation;
  const path::Pose placed = lookup.place(goal, {"map", 0.5, Moving::NO});
  EXPECT_NEAR(placed.position.x(), 8.0, 1e-6);
  EXPECT_NEAR(placed.position.y(), 4.0, 1e-6);
  EXPECT_NEAR(placed.yaw, 0.0, 1e-8);
  EXPECT_THROW(lookup.place(goal, {"utm", 0.5, Moving::NO}), base::InputError)
      << "in a map of that frame it is far";
  const path::Path file{"utm", {{{goal.pose.position.x, goal.pose.position.y, 0.0}, 0.3}}};
  EXPECT_NEAR(lookup.place(file, {"map", 0.5, Moving::NO}).poses[0].position.x(), 8.0, 1e-6);
}

// rospy's clients set no orientation.
TEST_F(Place, ZerosAreNoHeadingUnlessAnyWillDo) {
  geometry_msgs::PoseStamped goal = poseIn("odom", 12.0);
  goal.pose.orientation = geometry_msgs::Quaternion();
  Placing by{"map", 0.5, Moving::WITH_VEHICLE, "base_link"};
  EXPECT_THROW(lookup_.place(goal, by), base::InputError);
  by.zero_heading = ZeroHeading::ANY;
  EXPECT_TRUE(std::isnan(lookup_.place(goal, by).yaw));
  nav_msgs::Path path;
  path.header.frame_id = "odom";
  path.poses = {goal, goal};
  path.poses[1].pose.position.y = 3.0;
  for (const path::Pose& pose : lookup_.place(path, by).poses)
    EXPECT_NEAR(pose.yaw, M_PI / 2, 1e-12) << "along the path";
}

// earth -> map -> odom -> base_link -> imu_link, earth -> ship -> usbl
TEST(FrameLookup, TellsTheFramesByWhichOneLeadsToAnother) {
  FrameLookup lookup;
  for (const auto& [parent, child] :
       {std::pair("earth", "map"), std::pair("map", "odom"), std::pair("odom", "base_link"),
        std::pair("base_link", "imu_link"), std::pair("base_link", "dvl_link"),
        std::pair("earth", "ship"), std::pair("ship", "usbl"), std::pair("other", "alone")})
    join(lookup, parent, child);
  const auto between = [&](const char* one, const char* other) {
    const std::vector<std::string> frames = lookup.framesBetween(one, other);
    return std::set<std::string>(frames.begin(), frames.end());
  };
  using Frames = std::set<std::string>;
  EXPECT_EQ(between("imu_link", "dvl_link"), (Frames{"imu_link", "base_link", "dvl_link"}));
  EXPECT_EQ(between("base_link", "imu_link"), (Frames{"base_link", "imu_link"}));
  EXPECT_EQ(between("odom", "map"), (Frames{"odom", "map"}));
  EXPECT_EQ(between("imu_link", "usbl"),
            (Frames{"imu_link", "base_link", "odom", "map", "earth", "ship", "usbl"}));
  EXPECT_EQ(between("imu_link", "alone"), Frames{});
}

}  // namespace
}  // namespace grid_path_planner::nodes
