// What waits for a thread that is busy. Seen before: 20 goals of 8 MB waited, of 50 that may with 1 GB each, and 20 messages
// of tf of 8 MB, of 100: both were bounded by number only.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <atomic>
#include <future>

#include "ros/input/transform_receiver.h"
#include "ros/messages/navigate_path_action.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

constexpr std::size_t kMessages = 20, kLarge = 8 << 20;  // bytes of each
constexpr std::size_t kMostOfThem = kMostWaitingBytes / kLarge;

class WaitingBytes : public testing::Test {
 protected:
  WaitingBytes() { busy_.setCallbackQueue(&guarded_); }
  // A second subscriber, which is told of each message after the first one has it.
  template <class Message>
  ros::Subscriber count(const std::string& topic) {
    return nh_.subscribe<Message>(topic, kMessages,
                                  [this](const boost::shared_ptr<const Message>&) { ++arrived_; });
  }
  bool allHaveArrived() const {
    return test::waitFor([this] { return arrived_ == kMessages; });
  }

  ros::NodeHandle nh_, busy_;
  ros::CallbackQueue queue_;  // of a thread that has other work
  GuardedQueue guarded_{queue_};
  std::atomic<std::size_t> arrived_{0};
};

TEST_F(WaitingBytes, OfGoalsOfAnAction) {
  std::vector<std::string> got;
  actionlib::ActionServer<NavigatePathAction> server(
      busy_, "navigate_path", [&](auto handle) { got.push_back(handle.getGoalID().id); },
      [](auto) {}, false);
  server.start();
  const ros::Subscriber counter = count<NavigatePathActionGoal>("navigate_path/goal");
  ros::Publisher goals = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", kMessages);
  ASSERT_TRUE(test::waitFor([&] { return goals.getNumSubscribers() > 0; }));
  for (std::size_t i = 0; i < kMessages; ++i) {
    NavigatePathActionGoal goal;
    goal.goal_id.id = std::to_string(i);
    goal.goal.filename.assign(kLarge, 'x');
    goals.publish(goal);
  }
  ASSERT_TRUE(allHaveArrived());
  while (!queue_.isEmpty()) queue_.callAvailable();
  ASSERT_FALSE(got.empty());
  EXPECT_EQ(got.back(), std::to_string(kMessages - 1)) << "the oldest are dropped";
  EXPECT_LE(got.size(), kMostOfThem);
}

TEST_F(WaitingBytes, OfTransforms) {
  std::promise<void> release;
  std::shared_future<void> released = release.get_future().share();
  std::vector<std::string> got;  // in the receiver's thread
  std::atomic<bool> got_last{false};
  tf2_ros::Buffer buffer;
  ros::Publisher transforms = nh_.advertise<tf2_msgs::TFMessage>("/tf", kMessages);
  {
    TransformReceiver receiver(nh_, buffer,
                               [&](const tf2_msgs::TFMessage& message, const std::string&, bool) {
                                 released.wait();
                                 got.push_back(message.transforms.front().child_frame_id);
                                 got_last = got.back() == std::to_string(kMessages - 1);
                               });
    const ros::Subscriber counter = count<tf2_msgs::TFMessage>("/tf");
    ASSERT_TRUE(test::waitFor([&] { return transforms.getNumSubscribers() > 0; }));
    tf2_msgs::TFMessage message;
    message.transforms.resize(2);
    message.transforms[1].child_frame_id.assign(kLarge, 'x');  // refused, but not before it is read
    for (std::size_t i = 0; i < kMessages; ++i) {
      message.transforms[0].child_frame_id = std::to_string(i);
      transforms.publish(message);
    }
    EXPECT_TRUE(allHaveArrived());
    release.set_value();
    ASSERT_TRUE(test::waitFor([&] { return got_last.load(); }));
  }
  EXPECT_LE(got.size(), kMostOfThem + 1) << "and the one that was at work";
}

// What was seen before, by reading: roscpp gives the second one of a process what it has unpacked for the first, who had taken
// its bytes: the nodelet of a manager that was loaded second had no tf, no updates of maps and no clouds.
TEST_F(WaitingBytes, TwoInOneProcessGetEachMessage) {
  std::vector<std::string> got[2];
  ros::Subscriber subscribers[2];
  for (int i = 0; i < 2; ++i)
    subscribers[i] = subscribeBounded<actionlib_msgs::GoalID>(
        busy_, "shared", {kMessages, kMostWaitingBytes},
        [&got, i](const actionlib_msgs::GoalID& message) { got[i].push_back(message.id); });
  ros::Publisher publisher = nh_.advertise<actionlib_msgs::GoalID>("shared", kMessages);
  ASSERT_TRUE(test::waitFor([&] { return publisher.getNumSubscribers() > 0; }));
  std::vector<std::string> sent;
  for (std::size_t i = 0; i < kMessages; ++i) {
    actionlib_msgs::GoalID message;
    message.id = std::to_string(i);
    sent.push_back(message.id);
    publisher.publish(message);
  }
  test::waitFor([&] {
    queue_.callAvailable();
    return got[0].size() == kMessages && got[1].size() == kMessages;
  });
  for (const auto& each : got) EXPECT_EQ(each, sent);
}

// As roscpp has it of a subscription: never two at once, whoever serves the queue.
TEST_F(WaitingBytes, MessagesAreHandledOneAfterTheOther) {
  constexpr int kSmall = 300;
  std::atomic<int> at_once{0}, most{0};
  std::vector<std::string> got;
  std::atomic<std::size_t> count{0};
  const ros::Subscriber subscriber = subscribeBounded<actionlib_msgs::GoalID>(
      busy_, "in_turn", {kSmall, kMostWaitingBytes}, [&](const actionlib_msgs::GoalID& message) {
        most = std::max<int>(most, ++at_once);
        got.push_back(message.id);
        std::this_thread::yield();
        --at_once;
        ++count;
      });
  ros::AsyncSpinner spinner(4, &queue_);
  spinner.start();
  ros::Publisher publisher = nh_.advertise<actionlib_msgs::GoalID>("in_turn", kSmall);
  ASSERT_TRUE(test::waitFor([&] { return publisher.getNumSubscribers() > 0; }));
  std::vector<std::string> sent;
  for (int i = 0; i < kSmall; ++i) {
    actionlib_msgs::GoalID message;
    message.id = std::to_string(i);
    sent.push_back(message.id);
    publisher.publish(message);
  }
  ASSERT_TRUE(test::waitFor([&] { return count == kSmall; }));
  EXPECT_EQ(most, 1);
  EXPECT_EQ(got, sent);
}

}  // namespace
}  // namespace grid_path_planner::nodes
