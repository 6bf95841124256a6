// In the storm of load cmd_vel was silent for up to a second although the control loop published every 20 ms:
// roscpp's one thread of connections read maps of 16 MB meanwhile. That thread stands still here.
#include "ros/common/outgoing/direct_publisher.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <ros/header.h>
#include <ros/node_handle.h>
#include <ros/poll_manager.h>
#include <ros/xmlrpc_manager.h>
#include <std_msgs/String.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "ros/common/master/xmlrpc_call.h"
#include "ros/support/latest.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

using XmlRpc::XmlRpcValue;

// A subscriber of its own, without roscpp: it reads when it is asked to.
class Socket {
 public:
  explicit Socket(const std::string& topic) {
    XmlRpcValue protocols;
    protocols[0][0] = "TCPROS";
    auto answer = callXmlRpc(ros::XMLRPCManager::instance()->getServerURI(), "requestTopic",
                             {XmlRpcValue("/socket"), XmlRpcValue(topic), protocols}, 10.0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(static_cast<int&>((*answer)[2])));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval limit{test::kDeadline.count(), 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    sendHeader({{"callerid", "/socket"}, {"topic", topic}, {"type", "*"}, {"md5sum", "*"}});
    read(readLength());
  }
  ~Socket() { ::close(socket_); }

  // The number that the next message begins with; -1 if none came before the deadline.
  int next() {
    const std::vector<std::uint8_t> bytes = read(readLength());
    return bytes.size() > 4 ? std::stoi(std::string(bytes.begin() + 4, bytes.end())) : -1;
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

// While it lives, roscpp's thread of connections does nothing.
class StandingThread {
 public:
  StandingThread() {
    listener_ = ros::PollManager::instance()->addPollThreadListener([this] {
      stands_ = true;
      while (!over_) ::usleep(1000);
    });
    EXPECT_TRUE(test::waitFor([this] { return stands_.load(); }));
  }
  ~StandingThread() {
    over_ = true;
    ros::PollManager::instance()->removePollThreadListener(listener_);
  }

 private:
  std::atomic<bool> stands_{false}, over_{false};
  boost::signals2::connection listener_;
};

class Direct : public testing::Test {
 protected:
  void publish(int number, std::size_t bytes = 0) {
    std_msgs::String message;
    message.data = std::to_string(number) + std::string(bytes, ' ');
    publisher_.publish(message);
  }
  bool isHeardBy(std::size_t listeners) {
    return test::waitFor([&] { return publisher_.numberOfListeners() == listeners; });
  }

  ros::NodeHandle nh_;
  DirectPublisher publisher_{nh_.advertise<std_msgs::String>("numbers", 100)};
};

TEST_F(Direct, SendsWhileRoscppsThreadOfConnectionsStands) {
  Socket one(publisher_.topic()), other(publisher_.topic());
  ASSERT_TRUE(isHeardBy(2));
  const StandingThread standing;
  publish(7);
  publish(8);
  for (Socket* socket : {&one, &other}) {
    EXPECT_EQ(socket->next(), 7);
    EXPECT_EQ(socket->next(), 8);
  }
}

// As a vehicle that takes up too little: what is left is the newest, in order, and whole.
TEST_F(Direct, LeavesWhatAConnectionDoesNotTakeToThatThread) {
  Socket socket(publisher_.topic());
  ASSERT_TRUE(isHeardBy(1));
  constexpr int kNumbers = 3000, kBytes = 10000;
  for (int number = 1; number <= kNumbers; ++number) publish(number, kBytes);
  int last = 0, heard = 0;
  while (last >= 0 && last < kNumbers) {
    const int number = socket.next();
    EXPECT_GT(number, last);
    last = number > last ? number : -1;
    ++heard;
  }
  EXPECT_EQ(last, kNumbers);
  EXPECT_LT(heard, kNumbers) << "the connection took all of it";
}

TEST_F(Direct, GoesOnWithoutASubscriberThatHasLeft) {
  Socket stays(publisher_.topic());
  {
    Socket leaves(publisher_.topic());
    ASSERT_TRUE(isHeardBy(2));
  }
  for (int number = 0; number < 100; ++number) publish(number);
  for (int number = 0; number < 100; ++number) EXPECT_EQ(stays.next(), number);
  EXPECT_TRUE(isHeardBy(1));
}

TEST_F(Direct, IsHeardInItsOwnProcess) {
  test::Latest<std_msgs::String> latest(nh_, "numbers");
  ASSERT_TRUE(isHeardBy(1));
  publish(5);
  ASSERT_TRUE(test::waitFor([&] { return latest.count() > 0; }));
  EXPECT_EQ(latest.all().back().data, "5");
}

}  // namespace
}  // namespace grid_path_planner::nodes
