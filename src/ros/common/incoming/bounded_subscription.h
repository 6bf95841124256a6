// A subscription whose waiting messages are bounded in bytes.
//
//   BoundedSubscription<map_msgs::OccupancyGridUpdate> updates(
//       nh, "projected_map_updates", 64 << 20, [](const auto& event) { use(*event.getMessage()); });
//
// roscpp bounds what waits by number: 100 updates of a large map are gigabytes. Here a message is
// taken when it arrives, and the oldest ones are dropped while more wait than the bound; one message
// may wait whatever its size. The callback is called by the queue of the node handle, for messages
// whose lengths are true (claimed_lengths.h).
#pragma once

#include <ros/callback_queue_interface.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <boost/make_shared.hpp>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ros/common/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {

// A message as it came.
struct SerializedArrival {
  std::vector<std::uint8_t> bytes;
  boost::shared_ptr<ros::M_string> header;  // of the connection
  ros::Time received;
};

// Those that wait. Thread-safe.
class Inbox {
 public:
  explicit Inbox(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  // Drops the oldest where they are too much. Returns whether one more waits than before.
  bool add(SerializedArrival arrival);
  // Empty bytes where none waits.
  SerializedArrival take();
  std::size_t bytes() const;

 private:
  const std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::deque<SerializedArrival> waiting_;
  std::size_t bytes_ = 0;
};

// Puts the messages of a topic into an inbox as they come, and has `queue` call `on_arrival` once for
// each. Thread-safe.
class ArrivalSubscription {
 public:
  ArrivalSubscription(ros::NodeHandle nh, ros::SubscribeOptions options, std::size_t most_bytes,
                      std::function<void(SerializedArrival)> on_arrival);
  ~ArrivalSubscription() { shutdown(); }
  // After this `on_arrival` is not called; it waits for a call that runs in another thread.
  void shutdown();
  std::string topic() const { return subscriber_.getTopic(); }

 private:
  void announce();
  std::uint64_t owner() const { return reinterpret_cast<std::uint64_t>(this); }

  // roscpp hands it each message as it arrives, in the thread that received it.
  class AtOnce : public ros::CallbackQueueInterface {
   public:
    void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t) override {
      callback->call();
    }
    void removeByID(std::uint64_t) override {}
  };

  const std::shared_ptr<Inbox> inbox_;
  const std::function<void(SerializedArrival)> on_arrival_;
  ros::CallbackQueueInterface& queue_;
  AtOnce at_once_;
  ros::Subscriber subscriber_;
};

template <class Message>
class BoundedSubscription {
 public:
  using Event = ros::MessageEvent<const Message>;

  BoundedSubscription(ros::NodeHandle nh, const std::string& topic, std::size_t most_bytes,
                      std::function<void(const Event&)> callback)
      : callback_(std::move(callback)),
        arrivals_(nh,
                  {topic, 1, ros::message_traits::md5sum<Message>(),
                   ros::message_traits::datatype<Message>()},
                  most_bytes, [this](SerializedArrival arrival) { unpack(std::move(arrival)); }) {}

  void shutdown() { arrivals_.shutdown(); }
  std::string topic() const { return arrivals_.topic(); }

 private:
  void unpack(SerializedArrival arrival) {
    const auto length = static_cast<std::uint32_t>(arrival.bytes.size());
    checkClaimedLengths<Message>(arrival.bytes.data(), length);
    const auto message = boost::make_shared<Message>();
    ros::serialization::IStream stream(arrival.bytes.data(), length);
    ros::serialization::deserialize(stream, *message);
    arrival.bytes = {};  // what the callback takes, it takes without them
    callback_(Event(message, arrival.header, arrival.received));
  }

  const std::function<void(const Event&)> callback_;
  ArrivalSubscription arrivals_;
};

}  // namespace grid_path_planner::nodes
