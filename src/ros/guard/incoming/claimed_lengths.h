// Whether a message in its serialized form holds what its lengths claim, asked before it is unpacked.
//
//   checkClaimedLengths<nav_msgs::OccupancyGrid>(bytes, length);     // throws InputError
//   subscriber = subscribeChecked<nav_msgs::Path>(nh, "path", 1, onPath);
//
// roscpp makes room for as many elements as a message claims to have before it looks whether they are
// there: 200 bytes that claim 2^32 - 1 cells take 4 GB and seconds, before they are refused. Here
// the lengths alone are read, in time in proportion to the bytes; nothing is allocated.
#pragma once

#include <ros/node_handle.h>
#include <ros/serialization.h>
#include <ros/subscribe_options.h>
#include <ros/subscription_callback_helper.h>

#include <boost/make_shared.hpp>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/process/huge_pages.h"

namespace grid_path_planner::nodes {

// Goes over a serialized message as roscpp's Serializer does, but steps over its arrays.
class ClaimedLengths : public ros::serialization::Stream {
 public:
  ClaimedLengths(std::uint8_t* bytes, std::uint32_t count) : Stream(bytes, count) {}

  template <class T>
  void next(T& value) {
    ros::serialization::deserialize(*this, value);
  }
  void next(std::string&) { step(length(), 1); }
  template <class T>
  void next(std::vector<T>&) {
    const std::uint32_t count = length();
    T element{};
    if constexpr (ros::message_traits::IsFixedSize<T>::value) {
      step(count, ros::serialization::serializationLength(element));
    } else {
      // None is serialized to nothing: it holds an array, whose length alone is 4 bytes.
      require(count, 4);
      for (std::uint32_t i = 0; i < count; ++i) next(element);
    }
  }

 private:
  std::uint32_t length() {
    std::uint32_t count = 0;
    next(count);
    return count;
  }
  void step(std::uint64_t count, std::uint64_t size) {
    require(count, size);
    advance(static_cast<std::uint32_t>(count * size));
  }
  void require(std::uint64_t count, std::uint64_t size) {
    if (count * size > getLength())
      throw base::InputError("it claims " + std::to_string(count) + " elements of " +
                             std::to_string(size) + " bytes in the last " +
                             std::to_string(getLength()));
  }
};

// Throws base::InputError, or roscpp's StreamOverrunException.
template <class Message>
void checkClaimedLengths(std::uint8_t* bytes, std::uint32_t count) {
  ClaimedLengths lengths(bytes, count);
  Message message;
  lengths.next(message);
}

// The message that was serialized to these bytes. Throws base::InputError where they are another one's,
// or fewer than it claims.
template <class Message>
Message messageFromBytes(std::string_view bytes) {
  auto* const data = reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data()));
  const auto count = static_cast<std::uint32_t>(bytes.size());
  Message message;
  try {
    checkClaimedLengths<Message>(data, count);
    ros::serialization::IStream stream(data, count);
    ros::serialization::deserialize(stream, message);
  } catch (const std::exception& error) {
    throw base::InputError(std::string("damaged: ") + error.what());
  }
  return message;
}

// Of messages whose `data` are bytes: cells, points, pixels.
template <class Message, class = void>
struct HasBytes : std::false_type {};
template <class Message>
struct HasBytes<Message, std::void_t<decltype(std::declval<Message&>().data.reserve(0))>>
    : std::bool_constant<sizeof(std::declval<Message&>().data[0]) == 1> {};

// For what a message of so many bytes has in `data`, nearly all of them.
template <class Message>
void makeRoom(Message& message, std::size_t bytes) {
  if constexpr (HasBytes<Message>::value) {
    if (bytes < kLargeBlock) return;
    message.data.reserve(bytes);
    adviseHugePages(message.data.data(), bytes);
  }
}

// Stands for a message that came without a byte: no callback gets it.
template <class Message>
const boost::shared_ptr<Message>& noMessage() {
  static const auto none = boost::make_shared<Message>();
  return none;
}

// `Parameter` is that of the callback, as in ros::SubscriptionCallbackHelperT.
//
// Where a message of no bytes is refused, roscpp 1.16 unpacks it again for the next subscriber that the
// process has for its topic, as two nodelets for tf: from memory that it has freed, up to 4 GB of it.
template <class Parameter>
class CheckedMessages : public ros::SubscriptionCallbackHelperT<Parameter> {
 public:
  using Base = ros::SubscriptionCallbackHelperT<Parameter>;
  using Message = typename Base::NonConstType;

  // `refused`, where there is one, is called in the place of a line in the log, in the subscriber's thread.
  explicit CheckedMessages(const typename Base::Callback& callback,
                           std::function<void()> refused = {})
      : Base(callback), refused_(std::move(refused)) {}

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& given) override {
    if (given.length == 0 && ros::serialization::serializationLength(Message()) > 0)
      return noMessage<Message>();
    try {
      checkClaimedLengths<Message>(given.buffer, given.length);
    } catch (const std::exception&) {
      if (refused_) return noMessage<Message>();
      throw;
    }
    return unpacked(given);
  }
  void call(ros::SubscriptionCallbackHelperCallParams& given) override {
    if (given.event.getConstMessage() != noMessage<Message>())
      Base::call(given);
    else if (refused_)
      refused_();
    else
      tellGivenUp("A message", "it has no bytes");
  }

 private:
  // As Base::deserialize(), but with room for a large array.
  static ros::VoidConstPtr unpacked(const ros::SubscriptionCallbackHelperDeserializeParams& given) {
    const auto message = boost::make_shared<Message>();
    ros::serialization::PreDeserializeParams<Message> params;
    params.message = message;
    params.connection_header = given.connection_header;
    ros::serialization::PreDeserialize<Message>::notify(params);
    makeRoom(*message, given.length);
    ros::serialization::IStream stream(given.buffer, given.length);
    ros::serialization::deserialize(stream, *message);
    return message;
  }

  const std::function<void()> refused_;
};

// As NodeHandle::subscribe(); messages whose lengths lie are dropped, with roscpp's line in the log. Publishers are asked
// to send each message at once: else TCP may keep a small one back until the one before is acknowledged, up to 40 ms.
// Parameter: `const ros::MessageEvent<const Message>&` for a callback that asks who sent it. `refused` is for threads that
// must not wait for a log.
template <class Message, class Parameter = const Message&, class Callback>
ros::Subscriber subscribeChecked(ros::NodeHandle nh, const std::string& topic,
                                 std::uint32_t queue_size, const Callback& callback,
                                 std::function<void()> refused = {}) {
  ros::SubscribeOptions options(topic, queue_size, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper = boost::make_shared<CheckedMessages<Parameter>>(callback, std::move(refused));
  options.transport_hints.tcpNoDelay();
  return nh.subscribe(options);
}

}  // namespace grid_path_planner::nodes
