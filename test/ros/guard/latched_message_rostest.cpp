// A map of map_publisher's was never heard, on a busy machine by 3 of 31 subscribers: they had connected while it was published,
// after the message was given to roscpp's thread of connections and before it was latched.
#include "ros/guard/outgoing/latched_message.h"

#include <gtest/gtest.h>
#include <ros/node_handle.h>
#include <ros/xmlrpc_manager.h>
#include <std_msgs/String.h>

#include <optional>
#include <string>
#include <thread>

#include "ros/support/raw_subscriber.h"

namespace grid_path_planner::nodes {
namespace {

std::optional<std::string> firstOf(const std::string& topic) {
  test::RawSubscriber subscriber(ros::XMLRPCManager::instance()->getServerURI(), topic);
  const auto message = subscriber.next<std_msgs::String>();
  return message ? std::optional<std::string>(message->data) : std::nullopt;
}

std_msgs::String textOf(const std::string& text) {
  std_msgs::String message;
  message.data = text;
  return message;
}

TEST(LatchedMessage, IsHeardByWhoSubscribesWhileItIsPublished) {
  ros::NodeHandle nh;
  for (int round = 0; round < 100 && !HasFailure(); ++round) {
    const std::string topic = "/latched_" + std::to_string(round);
    const ros::Publisher publisher = nh.advertise<std_msgs::String>(topic, 1, true);
    std::optional<std::string> heard;
    std::thread subscriber([&] { heard = firstOf(topic); });
    publishLatched(publisher, textOf("map"));
    subscriber.join();
    EXPECT_EQ(heard, "map") << round;
  }
}

TEST(LatchedMessage, IsTheNewestThatWasNotForgotten) {
  ros::NodeHandle nh;
  const ros::Publisher publisher = nh.advertise<std_msgs::String>("/latched", 1, true);
  publishLatched(publisher, textOf("first"));
  publishLatched(publisher, textOf("second"));
  EXPECT_EQ(firstOf("/latched"), "second");
  forgetLatched(publisher);
  std::optional<std::string> heard;
  std::thread subscriber([&] { heard = firstOf("/latched"); });
  while (publisher.getNumSubscribers() == 0) std::this_thread::yield();
  publishLatched(publisher, textOf("third"));
  subscriber.join();
  EXPECT_EQ(heard, "third");
}

TEST(LatchedMessage, OfAPublisherThatDoesNotLatchIsNotKept) {
  ros::NodeHandle nh;
  const ros::Publisher publisher = nh.advertise<std_msgs::String>("/unlatched", 1);
  publishLatched(publisher, textOf("first"));
  std::optional<std::string> heard;
  std::thread subscriber([&] { heard = firstOf("/unlatched"); });
  while (publisher.getNumSubscribers() == 0) std::this_thread::yield();
  publishLatched(publisher, textOf("second"));
  subscriber.join();
  EXPECT_EQ(heard, "second");
}

}  // namespace
}  // namespace grid_path_planner::nodes
