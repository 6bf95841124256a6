// A subscription whose waiting messages are bounded in number and bytes.
//
//   updates = subscribeBounded<map_msgs::OccupancyGridUpdate>(
//       nh, "projected_map_updates", {kAnyNumber, 64 << 20}, [](const auto& update) { use(update); });
//
// roscpp bounds what waits by number: 100 updates of a large map are gigabytes. Here a message is
// taken when it arrives, and the oldest ones are dropped while more wait than the bound; one message
// may wait whatever its size. The callback is called by the queue of the node handle, for one message after the
// other, whose lengths are true (claimed_lengths.h); others are dropped with a line in the log.
#pragma once

#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <boost/make_shared.hpp>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {

// Of the messages that wait.
struct WaitingBound {
  std::size_t messages;
  std::size_t bytes;
};

constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kMostWaitingBytes = std::size_t{64} << 20;  // of a topic

// A message as it came.
struct SerializedArrival {
  std::vector<std::uint8_t> bytes;
  boost::shared_ptr<ros::M_string> header;  // of the connection
  ros::Time received;
};

// Those that wait. Thread-safe.
class Inbox {
 public:
  explicit Inbox(const WaitingBound& most) : most_(most) {}
  // Drops the oldest where they are too much. Returns whether one more waits than before.
  bool add(SerializedArrival arrival);
  // The oldest.
  std::optional<SerializedArrival> take();
  std::size_t bytes() const;

 private:
  const WaitingBound most_;
  mutable std::mutex mutex_;
  std::deque<SerializedArrival> waiting_;
  std::size_t bytes_ = 0;
};

// Subscribes for the helper of `options`, which is called by the queue of `nh`.
ros::Subscriber subscribeBounded(ros::NodeHandle nh, ros::SubscribeOptions options,
                                 const WaitingBound& bound);

// As subscribeChecked().
template <class Message, class Parameter = const Message&, class Callback>
ros::Subscriber subscribeBounded(const ros::NodeHandle& nh, const std::string& topic,
                                 const WaitingBound& bound, const Callback& callback) {
  ros::SubscribeOptions options(topic, 1, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper = boost::make_shared<CheckedMessages<Parameter>>(callback);
  return subscribeBounded(nh, options, bound);
}

}  // namespace grid_path_planner::nodes
