#include "ros/guard/outgoing/latched_message.h"

#include <boost/thread/mutex.hpp>

// The latched message is private in roscpp. Naming private members in an explicit instantiation is the one thing
// that C++ allows.
namespace grid_path_planner::nodes {
namespace {

using Send = void (ros::Publisher::*)(const boost::function<ros::SerializedMessage()>&,
                                      ros::SerializedMessage&) const;

template <class Publisher, auto member, Send send>
struct PublisherMembers {
  friend const auto& implementationOf(const Publisher& publisher) { return publisher.*member; }
  friend void sendSerialized(const Publisher& publisher, const ros::SerializedMessage& message) {
    ros::SerializedMessage sent;
    (publisher.*send)([&] { return message; }, sent);
  }
};
const auto& implementationOf(const ros::Publisher& publisher);
void sendSerialized(const ros::Publisher& publisher, const ros::SerializedMessage& message);
template struct PublisherMembers<ros::Publisher, &ros::Publisher::impl_, &ros::Publisher::publish>;

void latch(const ros::Publisher& publisher, const ros::SerializedMessage& message) {
  const auto& implementation = implementationOf(publisher);
  if (!implementation || !implementation->latch_) return;
  const boost::mutex::scoped_lock lock(implementation->last_message_mutex_);
  implementation->last_message_ = message;
}

}  // namespace

void publishSerialized(const ros::Publisher& publisher, const ros::SerializedMessage& message) {
  if (!publisher) return;  // ROS was shut down
  latch(publisher, message);
  sendSerialized(publisher, message);
}

void forgetLatched(const ros::Publisher& publisher) {
  latch(publisher, {});
}

}  // namespace grid_path_planner::nodes
