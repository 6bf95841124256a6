// ros/guard/incoming/: messages whose lengths lie, and subscriptions bounded in bytes: without a roscore.
#include <geometry_msgs/PolygonStamped.h>
#include <gtest/gtest.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/message_deserializer.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Empty.h>
#include <tf2_msgs/TFMessage.h>

#include <vector>

#include "grid_path_planner/ComparePlans.h"
#include "ros/guard/incoming/bounded_subscription.h"
#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Message>
Bytes serialized(const Message& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <class Message>
bool accepted(Bytes bytes) {
  try {
    checkClaimedLengths<Message>(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    return true;
  } catch (const base::InputError&) {
    return false;
  } catch (const ros::serialization::StreamOverrunException&) {
    return false;
  }
}

// Each 4 bytes of the message in turn claim 2^32 - 1 elements.
template <class Message>
int refusedClaims(const Message& message) {
  const Bytes bytes = serialized(message);
  int refused = 0;
  for (std::size_t i = 0; i + 4 <= bytes.size(); ++i) {
    Bytes lies = bytes;
    std::fill_n(lies.begin() + static_cast<std::ptrdiff_t>(i), 4, std::uint8_t{0xff});
    if (!accepted<Message>(lies)) ++refused;
  }
  return refused;
}

template <class Message>
void expectTruthAndNoLies(const Message& message, int lengths) {
  const Bytes bytes = serialized(message);
  EXPECT_TRUE(accepted<Message>(bytes));
  EXPECT_GE(refusedClaims(message), lengths);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(
        accepted<Message>(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))));
}

TEST(ClaimedLengths, OfEveryMessageThatNodesTakeAreTrueOrRefused) {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.data.resize(20);
  expectTruthAndNoLies(map, 2);
  map_msgs::OccupancyGridUpdate update;
  update.data.resize(9);
  expectTruthAndNoLies(update, 2);
  nav_msgs::Path path;
  path.poses.resize(3);
  path.poses[1].header.frame_id = "odom";
  expectTruthAndNoLies(path, 5);
  sensor_msgs::PointCloud2 cloud;
  cloud.fields.resize(3);
  cloud.data.resize(100);
  expectTruthAndNoLies(cloud, 6);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(2);
  expectTruthAndNoLies(transforms, 5);
  sensor_msgs::Joy joy;
  joy.axes.resize(8);
  joy.buttons.resize(10);
  expectTruthAndNoLies(joy, 3);
  ComparePlans::Request comparison;
  comparison.planners = {"a_star", "anya"};
  expectTruthAndNoLies(comparison, 6);
  expectTruthAndNoLies(nav_msgs::Odometry(), 2);  // with arrays of a fixed length
}

SerializedArrival arrivalOf(std::size_t bytes, std::uint8_t mark) {
  return {Bytes(bytes, mark), nullptr, {}};
}

// 150 updates of 16 MB that waited took 1.4 GB.
TEST(Inbox, HoldsNoMoreBytesThanItMay) {
  constexpr std::size_t kMost = 1 << 20;
  Inbox inbox({kAnyNumber, kMost});
  for (std::uint8_t i = 0; i < 100; ++i) {
    inbox.add(arrivalOf(100000, i));
    EXPECT_LE(inbox.bytes(), kMost);
  }
  EXPECT_EQ(inbox.take()->bytes.front(), 90) << "the oldest were lost";
  int left = 0;
  while (inbox.take()) ++left;
  EXPECT_EQ(left, 9);
  EXPECT_EQ(inbox.bytes(), 0u);
}

TEST(Inbox, OneMessageMayWaitWhateverItsSize) {
  Inbox inbox({kAnyNumber, 1000});
  EXPECT_TRUE(inbox.add(arrivalOf(5000, 1)));
  EXPECT_FALSE(inbox.add(arrivalOf(6000, 2))) << "it takes the place of the first";
  EXPECT_EQ(inbox.take()->bytes.size(), 6000u);
}

TEST(Inbox, HoldsNoMoreMessagesThanItMay) {
  Inbox inbox({3, 1 << 20});
  for (std::uint8_t i = 0; i < 10; ++i) EXPECT_EQ(inbox.add(arrivalOf(10, i)), i < 3);
  for (const std::uint8_t left : {7, 8, 9}) EXPECT_EQ(inbox.take()->bytes.front(), left);
  EXPECT_FALSE(inbox.take());
}

// What was seen before, by every_node under ThreadSanitizer: two subscribers of /tf in one process, and a
// stranger who published nothing, not even a length. The first was refused, and for the second roscpp
// unpacked what it had freed, as a message of up to 4 GB: vehicle_localizer died.
template <class Message>
int timesCalledByNoBytes() {
  int called = 0;
  const auto helper =
      boost::make_shared<CheckedMessages<const Message&>>([&](const Message&) { ++called; });
  const ros::SerializedMessage nothing(boost::shared_array<std::uint8_t>(new std::uint8_t[1]), 0);
  ros::MessageDeserializer both(helper, nothing, boost::make_shared<ros::M_string>());
  const ros::VoidConstPtr first = both.deserialize();
  EXPECT_TRUE(first) << "else roscpp asks again";
  EXPECT_EQ(both.deserialize(), first);
  using Event = ros::MessageEvent<const void>;
  ros::SubscriptionCallbackHelperCallParams given;
  given.event =
      Event(first, both.getConnectionHeader(), ros::Time(1), false, Event::CreateFunction());
  helper->call(given);
  return called;
}

// A `stop` of no bytes, or too few, was a line in the log by the thread that commands: it waited for whoever reads that.
TEST(CheckedMessages, WhereTheyAreCountedNobodyIsCalled) {
  int called = 0, refused = 0;
  const auto helper = boost::make_shared<CheckedMessages<const sensor_msgs::Joy&>>(
      [&](const sensor_msgs::Joy&) { ++called; }, [&] { ++refused; });
  for (const std::uint32_t length : {0u, 5u}) {
    const ros::SerializedMessage bytes(
        boost::shared_array<std::uint8_t>(new std::uint8_t[8]{255, 255, 255, 255}), length);
    ros::MessageDeserializer deserializer(helper, bytes, boost::make_shared<ros::M_string>());
    const ros::VoidConstPtr message = deserializer.deserialize();
    ASSERT_TRUE(message) << "roscpp would say that there is none";
    using Event = ros::MessageEvent<const void>;
    ros::SubscriptionCallbackHelperCallParams given;
    given.event = Event(message, deserializer.getConnectionHeader(), ros::Time(1), false,
                        Event::CreateFunction());
    helper->call(given);
  }
  EXPECT_EQ(called, 0);
  EXPECT_EQ(refused, 2);
}

TEST(CheckedMessages, OneWithoutAByteIsUnpackedOnceAndReachesNobody) {
  ros::Time::init();  // for the line in the log
  EXPECT_EQ(timesCalledByNoBytes<tf2_msgs::TFMessage>(), 0);
  EXPECT_EQ(timesCalledByNoBytes<sensor_msgs::Joy>(), 0);
  EXPECT_EQ(timesCalledByNoBytes<std_msgs::Empty>(), 1) << "which has none";
}

}  // namespace
}  // namespace grid_path_planner::nodes
