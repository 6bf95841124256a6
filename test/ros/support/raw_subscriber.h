// A subscriber without roscpp: it reads when it is asked to, and keeps its link whatever the master says.
//
//   RawSubscriber subscriber(uri, "/cmd_vel");
//   while (const auto message = subscriber.next<geometry_msgs::Twist>()) use(*message);  // until the node ends
#pragma once

#include <arpa/inet.h>
#include <ros/header.h>
#include <ros/serialization.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/guard/master/xmlrpc_call.h"
#include "ros/support/wait.h"

namespace grid_path_planner::test {

class RawSubscriber {
 public:
  // Of the node of this URI, on this machine. Throws where it does not answer.
  RawSubscriber(const std::string& uri, const std::string& topic) {
    XmlRpc::XmlRpcValue protocols;
    protocols[0][0] = "TCPROS";
    auto answer = nodes::callXmlRpc(
        uri, "requestTopic", {XmlRpc::XmlRpcValue("/raw"), XmlRpc::XmlRpcValue(topic), protocols},
        10.0);
    if (!answer) throw std::runtime_error(uri + " does not offer " + topic);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(static_cast<int&>((*answer)[2])));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval limit{kDeadline.count(), 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    sendHeader({{"callerid", "/raw"}, {"topic", topic}, {"type", "*"}, {"md5sum", "*"}});
    read(readLength());
  }
  ~RawSubscriber() { ::close(socket_); }
  RawSubscriber(const RawSubscriber&) = delete;
  RawSubscriber& operator=(const RawSubscriber&) = delete;

  // None where the link has ended, or nothing came before the deadline.
  template <class Message>
  std::optional<Message> next() {
    std::vector<std::uint8_t> bytes = read(readLength());
    if (bytes.empty()) return std::nullopt;
    Message message;
    ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::deserialize(stream, message);
    return message;
  }

 private:
  void sendHeader(const ros::M_string& fields) {
    boost::shared_array<std::uint8_t> bytes;
    std::uint32_t length = 0;
    ros::Header::write(fields, bytes, length);
    ::send(socket_, &length, 4, 0);
    ::send(socket_, bytes.get(), length, 0);
  }
  std::vector<std::uint8_t> read(std::size_t length) {
    std::vector<std::uint8_t> bytes(length);
    const ssize_t got = ::recv(socket_, bytes.data(), length, MSG_WAITALL);
    return got == static_cast<ssize_t>(length) ? bytes : std::vector<std::uint8_t>();
  }
  std::size_t readLength() {
    const std::vector<std::uint8_t> bytes = read(4);
    return bytes.empty() ? 0 : bytes[0] | bytes[1] << 8 | bytes[2] << 16;
  }

  const int socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
};

}  // namespace grid_path_planner::test
