// Sends the messages of a topic from the thread that publishes them.
//
//   DirectPublisher velocities(nh.advertise<geometry_msgs::Twist>("cmd_vel", 10));
//   velocities.publish(twist);
//
// roscpp hands what is published to the one thread of the process that reads and writes all connections:
// while that reads a map of 16 MB, for which it needed up to half a second on a busy machine, nothing is sent. Here the
// message is queued for each subscriber and written to its connection at once, as roscpp does with services.
// What a connection does not take, or one that is written to just then, is left to that thread. The order
// stays, as long as nothing is published otherwise on this topic of the process.
//
// For one thread. Subscribers of the same process are called as usual.
#pragma once

#include <ros/publication.h>
#include <ros/publisher.h>
#include <ros/serialization.h>

#include <string>
#include <vector>

namespace grid_path_planner::nodes {

class DirectPublisher {
 public:
  // Not latched.
  explicit DirectPublisher(ros::Publisher publisher);

  template <class Message>
  void publish(const Message& message) {
    if (numberOfListeners() > 0) send(ros::serialization::serializeMessage(message));
  }

  std::string topic() const { return publisher_.getTopic(); }
  std::size_t numberOfListeners() const {
    return publication_ ? publication_->getNumSubscribers() : 0;
  }

 private:
  void send(const ros::SerializedMessage& message);

  ros::Publisher publisher_;
  ros::PublicationPtr publication_;            // null where ROS was shut down
  std::vector<ros::SubscriberLinkPtr> links_;  // of send(), kept for its memory
};

}  // namespace grid_path_planner::nodes
