// Messages as bytes, as they come over a connection, and back.
#pragma once

#include <ros/serialization.h>

#include <optional>
#include <string>
#include <vector>

namespace grid_path_planner::fuzz {

// As roscpp's IStream, but a list is no longer than the bytes that are left: roscpp takes the memory
// that a length asks for before it looks, which is its business and not what is looked for here.
class BoundedStream : public ros::serialization::Stream {
 public:
  BoundedStream(std::uint8_t* data, std::uint32_t count) : Stream(data, count) {}

  template <class Value>
  void next(Value& value) {
    ros::serialization::deserialize(*this, value);
  }

  template <class Value, class Allocator>
  void next(std::vector<Value, Allocator>& values) {
    std::uint32_t count = 0;
    next(count);
    if (count > getLength()) throw ros::serialization::StreamOverrunException("a list is too long");
    values.resize(count);
    for (Value& value : values) next(value);
  }
};

// None for bytes that are no such message.
template <class Message>
std::optional<Message> messageOf(std::string bytes) {
  BoundedStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                       static_cast<std::uint32_t>(bytes.size()));
  try {
    Message message;
    stream.next(message);
    return message;
  } catch (const ros::serialization::StreamOverrunException&) {
    return std::nullopt;
  }
}

template <class Message>
std::string bytesOf(const Message& message) {
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

}  // namespace grid_path_planner::fuzz
