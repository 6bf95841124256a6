// Whether another node publishes a transform that this node is to publish.
//
//   TransformRivals rivals(nh, {"odom", "base_link"});
//   rivals.sent(stamp);                                   // of each transform of our own
//   if (!rivals.rival().empty()) beSilent(rivals.rival());
//
// tf has one parent for each frame: two that publish it make the vehicle jump to and fro. A node of the
// same process, which has our name, is known by stamps that are not ours.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2_msgs/TFMessage.h>

#include <deque>
#include <string>
#include <vector>

namespace grid_path_planner::nodes {

class TransformRivals {
 public:
  // `children`: the frames whose transform to their parent is ours.
  TransformRivals(ros::NodeHandle nh, const std::vector<std::string>& children);

  void sent(const ros::Time& stamp);
  // A sentence that names the first that was heard since reset(); empty: none.
  const std::string& rival() const { return rival_; }
  void reset() { rival_.clear(); }

 private:
  void hear(const tf2_msgs::TFMessage& message, const std::string& node);
  bool isOurs(const ros::Time& stamp, const std::string& node) const;

  std::vector<std::string> children_;
  std::deque<ros::Time> sent_;  // the newest last
  std::string rival_;
  ros::Subscriber subscriber_;
};

}  // namespace grid_path_planner::nodes
