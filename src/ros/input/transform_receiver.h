// Receives /tf and /tf_static into a buffer, in a thread of its own, and refuses what would end the
// process or stop all later transforms.
//
// In the place of tf2_ros::TransformListener: there a transform stamped near 2^32 s ends the process
// inside tf2 (its arithmetic of times throws), and one stamped years ahead stays the latest for
// years, since tf2 drops what is older than its newest by more than its length.
//
// Guaranteed: transforms that are stamped 0 or some seconds (4; 10 of simulated time, which may run
// many times faster than messages) ahead of ROS time, and all while there is none, are dropped with
// a warning; the stamps of static ones do not count. ROS time that jumps back clears the buffer. Stamps that come
// again, and those older than the buffer, do not reach tf2, which writes to stderr under the lock that every lookup
// waits for: whoever reads no log would stop the vehicle's control.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {

// The stamps that a buffer holds of each frame.
class TransformStamps {
 public:
  // `length` in s, the buffer's.
  explicit TransformStamps(double length = tf2::BufferCore::DEFAULT_CACHE_TIME);

  // Whether the buffer would take a transform of this frame and stamp; then it counts as taken.
  bool take(const std::string& child, const ros::Time& stamp);
  // tf2 did not take it for another reason.
  void giveBack(const std::string& child, const ros::Time& stamp);
  void clear() { of_.clear(); }

 private:
  const std::uint64_t length_;                         // ns
  std::map<std::string, std::set<std::uint64_t>> of_;  // by child: ns
};

// Puts the transform of `node` into the buffer where the rules above let it. Why not, in a sentence;
// empty where it was, and where its stamp came before.
std::string insertTransform(tf2::BufferCore& buffer, TransformStamps& stamps,
                            geometry_msgs::TransformStamped transform, const std::string& node,
                            bool is_static, const ros::Time& now);

class TransformReceiver {
 public:
  // Told each message before it is put into the buffer, in the receiver's thread.
  using Listener =
      std::function<void(const tf2_msgs::TFMessage&, const std::string& node, bool is_static)>;

  TransformReceiver(ros::NodeHandle nh, tf2_ros::Buffer& buffer, Listener listener = {});
  ~TransformReceiver();

 private:
  void receive(const tf2_msgs::TFMessage& message, const std::string& node, bool is_static);

  tf2_ros::Buffer& buffer_;
  const Listener listener_;
  TransformStamps stamps_;
  ros::CallbackQueue queue_;
  GuardedQueue guarded_{queue_};
  const std::shared_ptr<void> on_jump_back_;
  ros::Subscriber moving_, static_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace grid_path_planner::nodes
