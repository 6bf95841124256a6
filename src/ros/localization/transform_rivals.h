// Whether another node publishes a transform that this node is to publish.
//
//   TransformRivals rivals({"odom", "base_link"});
//   rivals.hear(message, node, is_static);                // all that comes on tf
//   rivals.sent(child, stamp);                            // before each transform of our own
//   if (!rivals.rival().empty()) beSilent(rivals.rival());
//
// tf has one parent for each frame: two that publish it make the vehicle jump to and fro. A node of the
// same process, which has our name, is known by stamps that are not ours, or that come once more than we
// sent them. A static transform is a rival whoever sent it, and stays one: tf keeps it when its publisher
// is gone. Thread-safe.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <tf2_msgs/TFMessage.h>

#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace grid_path_planner::nodes {

class TransformRivals {
 public:
  // `children`: the frames whose transform to their parent is ours.
  explicit TransformRivals(std::vector<std::string> children);

  // `node`: who published the message.
  void hear(const tf2_msgs::TFMessage& message, const std::string& node, bool is_static);
  void sent(const std::string& child, const ros::Time& stamp);
  // Whether tf was listened to for so long that one that is there was heard.
  bool isKnown() const;
  // A sentence that names the first that was heard since reset(), or a static one; empty: none.
  std::string rival() const;
  void reset();

 private:
  bool isOurs(const std::string& child, const ros::Time& stamp, const std::string& node);
  std::string rivalIn(const geometry_msgs::TransformStamped& transform, const std::string& node,
                      bool is_static);

  const std::vector<std::string> children_;
  const ros::SteadyTime since_ = ros::SteadyTime::now();
  mutable std::mutex mutex_;
  struct Sent {
    std::string child;
    ros::Time stamp;
  };
  std::deque<Sent> sent_;  // and not heard yet, the newest last
  std::string rival_, static_rival_;
};

}  // namespace grid_path_planner::nodes
