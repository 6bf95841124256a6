// In the storm of load cmd_vel was silent for up to a second although the control loop published every 20 ms:
// roscpp's one thread of connections read maps of 16 MB meanwhile. That thread stands still here.
#include "ros/guard/outgoing/direct_publisher.h"

#include <gtest/gtest.h>
#include <ros/node_handle.h>
#include <ros/poll_manager.h>
#include <ros/xmlrpc_manager.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <atomic>
#include <string>

#include "ros/support/latest.h"
#include "ros/support/raw_subscriber.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

// Its numbers; -1 if none came before the deadline.
class Socket {
 public:
  explicit Socket(const std::string& topic)
      : subscriber_(ros::XMLRPCManager::instance()->getServerURI(), topic) {}

  int next() {
    const auto message = subscriber_.next<std_msgs::String>();
    return message ? std::stoi(message->data) : -1;
  }

 private:
  test::RawSubscriber subscriber_;
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
