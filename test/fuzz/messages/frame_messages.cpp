// What nodes ask of tf whoever filled it: paths and poses of other frames, and who else publishes transforms.
#include <nav_msgs/Path.h>
#include <tf2_msgs/TFMessage.h>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "ros/input/frame_lookup.h"
#include "ros/localization/transform_rivals.h"

namespace grid_path_planner::fuzz {
namespace {

const ros::Time kNowOfFrames(1000, 0);

geometry_msgs::TransformStamped linkOf(const std::string& parent, const std::string& child) {
  geometry_msgs::TransformStamped link;
  link.header.frame_id = parent;
  link.header.stamp = kNowOfFrames;
  link.child_frame_id = child;
  link.transform.translation.x = 1.0;
  link.transform.rotation.w = 1.0;
  return link;
}

std::string pathOfFrames(const std::string& frame, const std::string& other) {
  nav_msgs::Path path;
  path.header.frame_id = frame;
  path.poses.resize(2);
  for (auto& pose : path.poses) pose.pose.orientation.w = 1.0;
  path.poses[1].header.frame_id = other;
  return bytesOf(path);
}

std::vector<std::string> seedsOfFrames() {
  tf2_msgs::TFMessage links;
  links.transforms = {linkOf("map", "odom"), linkOf("odom", "base_link"), linkOf("map", "dock")};
  tf2_msgs::TFMessage loop;
  loop.transforms = {linkOf("map", "odom"), linkOf("odom", "map")};
  return {bytesOf(links) + pathOfFrames("map", "base_link"),
          bytesOf(links) + pathOfFrames("/odom", "dock"),
          bytesOf(loop) + pathOfFrames("odom", "x")};
}

void askFrames(const nodes::FrameLookup& frames, const nav_msgs::Path& path) {
  const auto mayFail = [](const auto& ask) {
    try {
      ask();
    } catch (const base::InputError&) {
    } catch (const nodes::TransformError&) {
    }
  };
  for (const nodes::Moving moving :
       {nodes::Moving::NO, nodes::Moving::AT_STAMP, nodes::Moving::WITH_VEHICLE}) {
    const nodes::Placing by{"map", 0.5, moving, "base_link"};
    mayFail([&] {
      const path::Path moved = frames.place(path, by);
      mustHold(moved.poses.size() == path.poses.size(), "every pose has its place");
    });
    mayFail([&] { frames.place({{1.0, 2.0, 3.0}}, path.header, by); });
    for (const geometry_msgs::PoseStamped& pose : path.poses)
      mayFail([&] { frames.place(pose, by); });
    mayFail([&] { frames.placeVehicle(by); });
  }
  frames.commonFrame("base_link", "dock");
  frames.framesBetween("base_link", "dock");
}

FUZZ_TARGET(frame_messages, seedsOfFrames) {
  Messages messages(input);
  const auto links = messages.next<tf2_msgs::TFMessage>();
  const auto path = messages.next<nav_msgs::Path>();
  if (!links || !path) return;
  setTime(kNowOfFrames);
  nodes::FrameLookup frames;
  nodes::TransformStamps stamps;
  for (const geometry_msgs::TransformStamped& link : links->transforms)
    nodes::insertTransform(frames.buffer(), stamps, link, "/fuzz", link.header.seq == 1,
                           kNowOfFrames);
  askFrames(frames, *path);
}

std::vector<std::string> seedsOfRivals() {
  tf2_msgs::TFMessage links;
  links.transforms = {linkOf("world", "map"), linkOf("map", "odom")};
  return {bytesOf(links)};
}

FUZZ_TARGET(rival_transforms, seedsOfRivals) {
  const auto message = messageOf<tf2_msgs::TFMessage>(input);
  if (!message) return;
  for (const bool is_static : {false, true}) {
    nodes::TransformRivals rivals({"odom", "base_link"});
    rivals.sent("odom", kNowOfFrames);
    mayRefuse([&] { rivals.hear(*message, "/rival", is_static); });
    mustHold(rivals.rival().find_first_of("\"'$`\\\n\r\t\x1b\x7f") == std::string::npos,
             "what is told of it is harmless");
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
