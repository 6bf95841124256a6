// Messages as bytes, right or not, published in the place of others.
//
//   ros::Publisher paths = nh.advertise<RawBytes<nav_msgs::Path>>("path", 10);
//   paths.publish(RawBytes<nav_msgs::Path>{lyingBytes<nav_msgs::Path>(20000000, 4)});
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace grid_path_planner::test {

// A message as it goes over the wire, of the type of another one.
template <class Message>
struct RawBytes {
  std::vector<std::uint8_t> bytes;
};

}  // namespace grid_path_planner::test

namespace ros::message_traits {

template <class Message>
struct MD5Sum<grid_path_planner::test::RawBytes<Message>> : MD5Sum<Message> {
  static const char* value(const grid_path_planner::test::RawBytes<Message>&) {
    return MD5Sum<Message>::value();
  }
  static const char* value() { return MD5Sum<Message>::value(); }
};
template <class Message>
struct DataType<grid_path_planner::test::RawBytes<Message>> : DataType<Message> {
  static const char* value(const grid_path_planner::test::RawBytes<Message>&) {
    return DataType<Message>::value();
  }
  static const char* value() { return DataType<Message>::value(); }
};
template <class Message>
struct Definition<grid_path_planner::test::RawBytes<Message>> : Definition<Message> {
  static const char* value(const grid_path_planner::test::RawBytes<Message>&) {
    return Definition<Message>::value();
  }
  static const char* value() { return Definition<Message>::value(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <class Message>
struct Serializer<grid_path_planner::test::RawBytes<Message>> {
  template <class Stream>
  static void write(Stream& stream, const grid_path_planner::test::RawBytes<Message>& message) {
    std::memcpy(stream.advance(static_cast<std::uint32_t>(message.bytes.size())),
                message.bytes.data(), message.bytes.size());
  }
  static std::uint32_t serializedLength(const grid_path_planner::test::RawBytes<Message>& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};

}  // namespace ros::serialization

namespace grid_path_planner::test {

template <class Message>
std::vector<std::uint8_t> bytesOfMessage(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

// A message with an array that claims so many elements, of which 100 bytes are there. `from_end`: how many bytes before the
// end a message without any elements has the length of that array.
template <class Message>
std::vector<std::uint8_t> lyingBytes(std::uint32_t claimed, std::size_t from_end) {
  std::vector<std::uint8_t> bytes = bytesOfMessage(Message());
  std::memcpy(&bytes[bytes.size() - from_end], &claimed, 4);
  bytes.resize(bytes.size() + 100);
  return bytes;
}

}  // namespace grid_path_planner::test
