// What a publisher has latched: set before it is sent, and dropped.
//
//   publishLatched(maps, message);
//   forgetLatched(maps);
//
// roscpp 1.15 latches a message only after it has handed it to the thread that sends: who subscribed in between, as nodes do
// that start together, never got it. On a busy machine 3 of 31 subscribers of a map missed it so. Here it is latched first, and
// who subscribes just then may get it twice.
//
// From forgetLatched() on, who subscribes gets nothing until something is published again; whoever has subscribed stays. roscpp
// offers only to give the topic up and to advertise it again, which asks the master, loses its subscribers for a moment, and
// is not safe beside other threads (topic_changes.h).
#pragma once

#include <ros/publisher.h>
#include <ros/serialization.h>

namespace grid_path_planner::nodes {

// A publisher that does not latch just publishes.
void publishSerialized(const ros::Publisher& publisher, const ros::SerializedMessage& message);

template <class Message>
void publishLatched(const ros::Publisher& publisher, const Message& message) {
  publishSerialized(publisher, ros::serialization::serializeMessage(message));
}

void forgetLatched(const ros::Publisher& publisher);

}  // namespace grid_path_planner::nodes
