// What nodes that drive hear beside their path: when goals were given, how fast the vehicle is, where it may be fast.
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <std_msgs/String.h>

#include <cmath>

#include "following/speed_limit.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/gate/localization_gate.h"
#include "ros/input/finished_goals.h"
#include "ros/messages/velocity_message.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr int kMostPaths = 16;

std::string pathGivenAt(std::uint32_t seconds, const std::string& what) {
  nav_msgs::Path path;
  path.header.stamp = ros::Time(seconds + 1, 0);
  path.poses.resize(2);
  path.poses.front().header.stamp = path.header.stamp;
  path.poses.back().header.stamp = ros::Time(seconds, 0);
  return what + bytesOf(path);
}

std::vector<std::string> seedsOfGivenGoals() {
  const std::string drive(1, '\0'), end = "\x01", end_all = "\x02", forget = "\x03";
  return {pathGivenAt(10, drive) + pathGivenAt(10, end) + pathGivenAt(10, drive),
          pathGivenAt(10, drive) + pathGivenAt(20, end_all) + pathGivenAt(30, drive),
          pathGivenAt(0, end_all) + pathGivenAt(4294967290, forget)};
}

// As navigate_path and local_planner do it; the stamp of the path is the time of the end.
FUZZ_TARGET(finished_goals, seedsOfGivenGoals) {
  Messages messages(input);
  nodes::FinishedGoals goals;
  for (int i = 0; i < kMostPaths && !messages.atEnd(); ++i) {
    const int what = messages.byte() % 4;
    const auto path = messages.next<nav_msgs::Path>();
    if (!path) return;
    const ros::Time now(path->header.stamp.sec, path->header.stamp.nsec % 1000000000);
    if (what == 0 && !goals.isOver(*path)) goals.drive(*path);
    if (what == 1) goals.end();
    if (what == 2) goals.endAllUntil(now);
    if (what != 3) continue;
    goals.timeWentBack();
    nav_msgs::Path old = *path;
    old.poses.resize(1);
    old.poses[0].header.stamp = ros::TIME_MIN;
    mustHold(goals.isOver(old), "what path_planner got before time went back is over");
  }
}

std::vector<std::string> seedsOfLocalizationStatus() {
  std_msgs::String degraded, lost, none;
  degraded.data = "DEGRADED: fixes that agree contradict the pose; the pose is known to 0.4 m";
  lost.data = "LOST";
  none.data = "well: so it is";
  return {bytesOf(degraded) + bytesOf(lost), bytesOf(none)};
}

// Whatever it said, a vehicle holds for a reason that a log can take, or is driven by a share of its speed.
FUZZ_TARGET(localization_status, seedsOfLocalizationStatus) {
  Messages messages(input);
  nodes::LocalizationGate gate;
  for (double now = 0.0; !messages.atEnd(); now += 20.0) {
    const auto message = messages.next<std_msgs::String>();
    if (!message) return;
    gate.hear(message->data, now);
    const double share = gate.speedShare({});
    mustHold(share > 0.0 && share <= 1.0, "a share is one");
    if (const auto why = gate.problem(now, {}))
      mustHold(why->size() < 700 && why->find('\n') == std::string::npos, "a sentence is one");
  }
}

std::vector<std::string> seedsOfOdometry() {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = ros::Time(1000, 0);
  odometry.twist.twist.linear.x = 0.5;
  nav_msgs::Odometry old = odometry;
  old.header.stamp = ros::Time();
  return {bytesOf(odometry), bytesOf(old)};
}

FUZZ_TARGET(odometry_message, seedsOfOdometry) {
  const auto odometry = messageOf<nav_msgs::Odometry>(input);
  if (!odometry) return;
  for (const ros::Time& now : {ros::Time(1000, 0), ros::Time(0, 1), ros::Time(4294967295u, 0)}) {
    const auto velocity = nodes::measuredVelocity(*odometry, now, 0.5);
    mustHold(!velocity || velocity->isFinite(), "a velocity is finite");
  }
}

std::vector<std::string> seedsOfSpeedLimits() {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.resolution = 0.5F;
  map.info.width = map.info.height = 4;
  map.info.origin.orientation.w = 1.0;
  map.data.assign(16, 0);
  map.data[5] = 20;
  map.data[6] = 100;
  map.data[7] = -1;
  return {bytesOf(map)};
}

FUZZ_TARGET(speed_limit_map, seedsOfSpeedLimits) {
  const auto message = messageOf<nav_msgs::OccupancyGrid>(input);
  if (!message) return;
  mayRefuse([&] {
    nodes::frameName(message->header.frame_id);
    const grid::OccupancyGrid limits = nodes::occupancyFromMessage(*message);
    const following::FollowerOptions options;
    const double speed = following::allowedSpeed(
        limits, options, {{0.1, 0.7, 0.0}, {1.1, 0.8, 0.0}, {-0.5, 3.0, 0.0}});
    mustHold(speed >= 0.0 && speed <= options.max_speed, "a limit slows down");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
