// The one door from a header to another frame: where what it bears is, or a sentence why tf does not say.
//
//   FrameTransforms transforms(nh);
//   Placing in_map{"map", 0.5, Moving::WITH_VEHICLE, "base_link"};
//   in_map.wait = limit;                                     // s; 0: what tf knows at once
//   const path::Pose goal = transforms.place(message, in_map);
//   const path::Pose vehicle = transforms.placeVehicle(in_map).level();
//
// Every caller says how old the transform may be and whether the frame moves: nothing is placed by a transform that has
// ceased. One of a frame that moves may be as much ahead, others by 10 s. Static transforms have no age. What waits does so
// on the steady clock, so that a ROS clock that stands still does not delay it, and asks the stop token.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>
#include <tf2_ros/buffer.h>

#include <Eigen/Geometry>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/path/path.h"
#include "ros/guard/node_time.h"
#include "ros/input/transform_receiver.h"
#include "ros/messages/zero_heading.h"

namespace grid_path_planner::nodes {

// `what()` is the sentence of a TRANSFORM_ERROR.
class TransformError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// By which transform something is placed.
enum class Moving {
  NO,           // the newest: of a frame that stands, as odom and utm do
  AT_STAMP,     // that at the stamp, 0: the newest: what a sensor measured
  WITH_VEHICLE  // AT_STAMP in a frame that is fixed to `vehicle`, NO in others: what somebody asks for
};

struct Placing {
  std::string into;      // a frame
  double max_age = 0.0;  // s, from the transform to now, or to the stamp where that counts
  Moving moving = Moving::AT_STAMP;
  std::string vehicle = {};  // its frame
  ZeroHeading zero_heading = ZeroHeading::REFUSED;
  std::string map_frame = {};  // that of headers that name none; "": `into`
  double wait = 0.0;           // s of the steady clock, for a transform that is new enough
  base::StopToken stop = {};
};

Eigen::Isometry3d isometryOf(const geometry_msgs::Transform& transform);

// Where a frame is in another one.
struct Placed {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  ros::Time stamp;   // of the transform; 0: all of it is static
  double age = 0.0;  // s, of the transform now; negative: stamped ahead

  path::Pose level() const;  // position and yaw of what may tilt
};

// What a buffer of transforms knows, whoever fills it.
class FrameLookup {
 public:
  tf2_ros::Buffer& buffer() { return buffer_; }

  // All throw TransformError where tf has no transform, or none that is new enough, and Stopped. Names of frames that are
  // none are an InputError.
  Placed place(const std_msgs::Header& header, const Placing& by) const;
  Placed placeVehicle(const Placing& by) const;  // the newest pose of by.vehicle
  // Throws InputError for what readPose() refuses, and for a place beyond 1e6 m in by.into. The yaw is NaN where
  // none is given and by.zero_heading says that any will do.
  path::Pose place(const geometry_msgs::PoseStamped& pose, const Placing& by) const;
  std::vector<Eigen::Vector3d> place(std::vector<Eigen::Vector3d> points,
                                     const std_msgs::Header& header, const Placing& by) const;
  // Poses that name another frame than the path are placed by their own headers. Throws InputError for a frame that tf
  // does not know (while it knows by.vehicle) or that moves with by.vehicle, for such poses that have no place, and as above.
  // Where no heading is given and any will do, the pose looks along the path.
  path::Path place(const nav_msgs::Path& message, const Placing& by) const;
  path::Path place(path::Path path, const Placing& by) const;  // of a file

  // The frame by which tf joins the two: above both, or one of them; empty where nothing does.
  std::string commonFrame(const std::string& one, const std::string& other) const;

  // The frames by which tf leads from one to the other, both and commonFrame() included; none where nothing joins them.
  std::vector<std::string> framesBetween(const std::string& one, const std::string& other) const;

  // Whether tf has `frame` fixed to the vehicle: its own frame, or one below it that no moving transform joins to it,
  // as a dock's is that its camera sees.
  bool movesWith(const std::string& vehicle, const std::string& frame) const;

  // Forgets everything but static transforms.
  void clear() { buffer_.clear(); }

 private:
  void checkStands(const std::string& frame, const Placing& by) const;
  // For what was measured at `stamp`; 0: the latest, of any age. Throws TransformError with the reason: a frame that
  // nothing names, a transform that has ceased, else tf2's.
  geometry_msgs::TransformStamped transform(const std::string& target, const std::string& source,
                                            const ros::Time& stamp = ros::Time(0)) const;
  Placed placedNow(const std::string& frame, const ros::Time& stamp, const Placing& by) const;
  geometry_msgs::TransformStamped nearest(const std::string& frame, const ros::Time& stamp,
                                          const Placing& by) const;

  tf2_ros::Buffer buffer_;
};

// The same of /tf and /tf_static, cleared where ROS time goes back, before a callback of the queue of `nh` (a GuardedQueue)
// begins.
class FrameTransforms : public FrameLookup {
 public:
  // `listener`: see TransformReceiver. Whoever wants to hear tf does so by this, not by a second
  // subscription.
  explicit FrameTransforms(const ros::NodeHandle& nh, TransformReceiver::Listener listener = {})
      : on_jump_back_(NodeTime::of(nh).onJumpBack([this](double) { clear(); })),
        receiver_(nh, buffer(), std::move(listener)) {}

 private:
  const std::shared_ptr<void> on_jump_back_;
  TransformReceiver receiver_;
};

}  // namespace grid_path_planner::nodes
