// Messages as bytes, as they come over a connection, and back.
#pragma once

#include <ros/serialization.h>
#include <ros/time.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::fuzz {

// Messages one after the other, each judged and unpacked as nodes do it, and bytes between them that say what is
// done with them.
class Messages {
 public:
  explicit Messages(std::string bytes) : bytes_(std::move(bytes)) {}

  bool atEnd() const { return at_ == bytes_.size(); }
  // Beyond the end: 0.
  std::uint8_t byte() { return atEnd() ? 0 : static_cast<std::uint8_t>(bytes_[at_++]); }

  // None, and the end, where the bytes are no such message.
  template <class Message>
  std::optional<Message> next() {
    auto* const begin = reinterpret_cast<std::uint8_t*>(bytes_.data()) + at_;
    const auto left = static_cast<std::uint32_t>(bytes_.size() - at_);
    Message message;
    try {
      nodes::checkClaimedLengths<Message>(begin, left);
      ros::serialization::IStream stream(begin, left);
      ros::serialization::deserialize(stream, message);
      at_ = bytes_.size() - stream.getLength();
      return message;
    } catch (const base::InputError&) {
    } catch (const ros::serialization::StreamOverrunException&) {
    }
    at_ = bytes_.size();
    return std::nullopt;
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

// None for bytes that are no such message.
template <class Message>
std::optional<Message> messageOf(std::string bytes) {
  return Messages(std::move(bytes)).next<Message>();
}

// What ros::Time::now() is from now on.
inline void setTime(const ros::Time& now) {
  ros::Time::init();
  ros::Time::setNow(now);
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
