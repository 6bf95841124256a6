// The one access to tf: poses, paths and points of one frame in another, with a sentence where tf
// knows no transform.
//
//   FrameTransforms transforms(nh);
//   const Pose vehicle = transforms.poseOf("base_link", "map", limit, stop);
//
// poseIn(), poseOf() and waitFor() wait for a transform: on the steady clock, so that a ROS clock that stands
// still does not delay them, and they ask the stop token while they wait. The other functions
// answer from what tf knows at once.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/path/path.h"
#include "ros/input/transform_receiver.h"

namespace grid_path_planner::nodes {

// `what()` is the sentence of a TRANSFORM_ERROR.
class TransformError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What a buffer of transforms knows, whoever fills it.
class FrameLookup {
 public:
  tf2_ros::Buffer& buffer() { return buffer_; }

  // `pose` in `frame`, at the pose's stamp (0: the latest); one without a frame is in `map_frame`. Throws InputError
  // for what poseFromMessage refuses, TransformError, Stopped. `limit` in seconds.
  path::Pose poseIn(const std::string& frame, const geometry_msgs::PoseStamped& pose,
                    const std::string& map_frame, double limit, const base::StopToken& stop) const;

  // The latest pose of the frame `vehicle` in `frame`; with `max_age` one that is within so many
  // seconds of now, which is waited for too. Throws TransformError, Stopped.
  path::Pose poseOf(const std::string& vehicle, const std::string& frame, double limit,
                    const base::StopToken& stop, std::optional<double> max_age = {}) const;

  // The latest transform, or that at `stamp`. Throws TransformError with the reason: a frame that nothing names, a
  // transform that has ceased, else tf2's.
  geometry_msgs::TransformStamped transform(const std::string& target, const std::string& source,
                                            const ros::Time& stamp = ros::Time(0)) const;

  // The same, waited for up to `limit` seconds. Throws Stopped too.
  geometry_msgs::TransformStamped waitFor(const std::string& target, const std::string& source,
                                          const ros::Time& stamp, double limit,
                                          const base::StopToken& stop) const;

  struct RecentPose {
    path::Pose pose;
    double age;  // s; negative: stamped ahead; 0 where all of it is static
  };
  // The latest pose of `vehicle` in `frame`, if it is within `max_age` seconds of `now`. Throws
  // TransformError for an older one, or none.
  RecentPose recentPoseOf(const std::string& vehicle, const std::string& frame,
                          const ros::Time& now, double max_age) const;

  // The path in the frame of its header, `map_frame` where that names none; poses that name another frame are
  // transformed. Throws InputError for a frame that tf does not know (while it knows `vehicle`), poses that cannot be
  // transformed, or by a transform older than `max_age` seconds only, and what pathFromMessage refuses.
  path::Path pathIn(const nav_msgs::Path& message, const std::string& vehicle,
                    const std::string& map_frame, double max_age) const;

  // The frame by which tf joins the two: above both, or one of them; empty where nothing does.
  std::string commonFrame(const std::string& one, const std::string& other) const;

  // The frames by which tf leads from one to the other, both and commonFrame() included; none where nothing joins them.
  std::vector<std::string> framesBetween(const std::string& one, const std::string& other) const;

  // Throws TransformError where what tf has between the two frames is older than `max_age` seconds at `now`. A static
  // transform, and one stamped ahead, as localization does, are not.
  void checkNotOlder(const std::string& to, const std::string& from, const ros::Time& now,
                     double max_age) const;

  // Points of the frame `from` in the frame `to`, by what was at `stamp`, or the latest where that is older, or `stamp` 0.
  // Throws TransformError.
  std::vector<Eigen::Vector3d> pointsIn(const std::string& to, const std::string& from,
                                        std::vector<Eigen::Vector3d> points,
                                        const ros::Time& stamp = ros::Time()) const;

  // Whether tf has `frame` fixed to the vehicle: its own frame, or one below it that no moving transform joins to it,
  // as a dock's is that its camera sees.
  bool movesWith(const std::string& vehicle, const std::string& frame) const;

  // Forgets everything but static transforms.
  void clear() { buffer_.clear(); }

 private:
  void checkKnown(const std::string& frame, const std::string& vehicle) const;

  tf2_ros::Buffer buffer_;
};

// The same of /tf and /tf_static.
class FrameTransforms : public FrameLookup {
 public:
  // `hearer`: see TransformReceiver. Whoever wants to hear tf does so by this, not by a second
  // subscription.
  explicit FrameTransforms(const ros::NodeHandle& nh, TransformReceiver::Hearer hearer = {})
      : receiver_(nh, buffer(), std::move(hearer)) {}

 private:
  TransformReceiver receiver_;
};

}  // namespace grid_path_planner::nodes
