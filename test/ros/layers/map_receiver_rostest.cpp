// Whole maps and updates, which have connections of their own and come in any order.
#include "ros/input/map_receiver.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/guarded_queue.h"
#include "ros/messages/map_announcement.h"
#include "ros/messages/map_topic.h"
#include "ros/support/latest.h"
#include "ros/support/wait.h"
#include "support/ascii_map.h"

namespace grid_path_planner::nodes {
namespace {

using grid::Cell;

// Of 1 m cells whose first column lies at `x`.
nav_msgs::OccupancyGrid mapAt(double x, const std::vector<std::string>& picture, double age) {
  auto message =
      occupancyToMessage(test::AsciiMap(picture).map, "map", ros::Time::now() - ros::Duration(age));
  message.info.origin.position.x = x;
  return message;
}

map_msgs::OccupancyGridUpdate cellAt(int column, std::int8_t value, double age) {
  auto update = updateOf({column, 0, 1, 1}, "map", ros::Time::now() - ros::Duration(age));
  update.data = {value};
  return update;
}

class MapReceiverTest : public testing::Test {
 protected:
  MapReceiverTest() {
    ros::NodeHandle nh;
    nh.setCallbackQueue(&guarded_);
    auto numbered = ros::AdvertiseOptions::create<map_msgs::OccupancyGridUpdate>(
        "projected_map_updates", 10, {}, {}, {}, nullptr);
    numbered.has_header = false;  // header.seq is the test's
    updates_ = nh_.advertise(numbered);
    receiver_.start(nh, [this](const MapChange& change) {
      if (std::exchange(fails_, false)) throw std::runtime_error("the listener has no memory");
      if (!change.changed) ++wholes_;
    });
    EXPECT_TRUE(test::waitFor([&] { return links_ > 0 && updates_.getNumSubscribers() > 0; }));
  }
  ~MapReceiverTest() override { receiver_.shutdown(); }

  bool comes(const std::function<bool()>& condition) {
    return test::waitFor([&] {
      queue_.callAvailable();
      return condition();
    });
  }
  void send(map_msgs::OccupancyGridUpdate update) {
    update.header.seq = ++number_;
    updates_.publish(update);
  }
  // Once all that was sent before is taken.
  bool isTaken() {
    map_msgs::OccupancyGridUpdate heartbeat;
    heartbeat.header.stamp = ros::Time(++beats_);
    send(heartbeat);
    return comes([&] {
      const auto heard = receiver_.heartbeat();
      return heard && heard->stamp == heartbeat.header.stamp;
    });
  }
  std::vector<std::int8_t> values() const {
    const auto map = receiver_.latest();
    return map.grid ? map.grid->values() : std::vector<std::int8_t>();
  }
  // With a wall in its last column; it is there when this returns.
  nav_msgs::OccupancyGrid firstMap(double age) {
    const auto map = mapAt(0.0, {"....#"}, age);
    maps_.publish(map);
    EXPECT_TRUE(hasCome(map));
    return map;
  }
  bool hasCome(const nav_msgs::OccupancyGrid& map) {
    return comes([&] { return values() == map.data; });
  }

  ros::NodeHandle nh_;
  std::atomic<int> links_{0};  // made so far
  ros::Publisher maps_ = nh_.advertise<nav_msgs::OccupancyGrid>(
      "projected_map", 1, [this](const ros::SingleSubscriberPublisher&) { ++links_; });
  ros::Publisher updates_;
  std::uint32_t number_ = 0;
  int beats_ = 0;
  bool fails_ = false;  // the listener, once
  int wholes_ = 0;      // whole maps that it was told of
  ros::CallbackQueue queue_;
  GuardedQueue guarded_{queue_};
  MapReceiver receiver_;
};

// By the code, an update that overtook the map of another place was laid at its column and row of the map before: free cells
// upon a wall, until the map was there.
TEST_F(MapReceiverTest, AnUpdateOfAMapOfAnotherPlaceWaitsForIt) {
  const auto before = firstMap(5.0);
  const auto grown = mapAt(-4.0, {"........#"}, 3.0);
  send(announcementOf(grown));
  send(cellAt(4, 0, 2.0));
  send(cellAt(2, 100, 2.0));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), before.data);
  maps_.publish(grown);
  EXPECT_TRUE(comes([&] { return values() == mapAt(-4.0, {"..#.....#"}, 0.0).data; }));
  send(cellAt(0, 100, 1.0));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), mapAt(-4.0, {"#.#.....#"}, 0.0).data) << "what comes then is laid at once";
  EXPECT_EQ(receiver_.lost(), "");
}

// As of costmap_2d, which announces nothing: it was refused, since it does not lie in the map before, and forgotten.
TEST_F(MapReceiverTest, AnUpdateBeyondTheMapIsLaidOnTheLargerOneThatItOvertook) {
  const auto before = firstMap(5.0);
  send(cellAt(7, 100, 1.0));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), before.data);
  EXPECT_NE(receiver_.refusal(), "");
  maps_.publish(mapAt(0.0, {"....#...."}, 2.0));
  EXPECT_TRUE(comes([&] { return values() == mapAt(0.0, {"....#..#."}, 0.0).data; }));
  EXPECT_EQ(receiver_.refusal(), "");
  EXPECT_EQ(receiver_.lost(), "");
}

TEST_F(MapReceiverTest, AMapFromBeforeTheAnnouncedOneIsTakenWithoutWhatFollowed) {
  firstMap(9.0);
  send(cellAt(1, 100, 6.0));
  send(announcementOf(mapAt(-4.0, {"........#"}, 5.0)));
  send(cellAt(4, 0, 4.0));
  ASSERT_TRUE(isTaken());
  maps_.publish(mapAt(0.0, {"..#.#"}, 7.0));
  EXPECT_TRUE(comes([&] { return values() == mapAt(0.0, {".##.#"}, 0.0).data; }));
  maps_.publish(mapAt(-4.0, {"........#"}, 5.0));
  EXPECT_TRUE(comes([&] { return values() == mapAt(-4.0, {"........#"}, 0.0).data; }));
}

TEST_F(MapReceiverTest, AMapThatCameBeforeItsAnnouncementIsNotAwaited) {
  const auto before = firstMap(5.0);
  send(announcementOf(before));
  send(cellAt(0, 100, 1.0));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), mapAt(0.0, {"#...#"}, 0.0).data);
}

// What was seen before, by reading: the first map of a publisher that was restarted is not announced, so that an update which
// overtook it was laid into the map of before.
TEST_F(MapReceiverTest, AnUpdateOfARestartedPublisherWaitsForItsMap) {
  const auto before = firstMap(5.0);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(isTaken());
  number_ = 0;
  send(cellAt(3, 100, 1.0));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), before.data);
  maps_.publish(mapAt(-4.0, {"........#"}, 2.0));
  EXPECT_TRUE(comes([&] { return values() == mapAt(-4.0, {"...#....#"}, 0.0).data; }));
  send(cellAt(0, 100, 0.5));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), mapAt(-4.0, {"#..#....#"}, 0.0).data) << "what comes then is laid at once";
  EXPECT_EQ(receiver_.lost(), "");
}

TEST_F(MapReceiverTest, ARestartedPublisherWhoseMapCameFirstIsNotWaitedFor) {
  firstMap(5.0);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(isTaken());
  const auto grown = mapAt(-4.0, {"........#"}, 2.0);
  maps_.publish(grown);
  ASSERT_TRUE(hasCome(grown));
  number_ = 0;
  send(cellAt(0, 100, 1.0));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), mapAt(-4.0, {"#.......#"}, 0.0).data);
  EXPECT_EQ(receiver_.lost(), "");
}

TEST_F(MapReceiverTest, AnAnnouncedMapThatDoesNotComeIsLost) {
  firstMap(5.0);
  send(announcementOf(mapAt(-4.0, {"........#"}, 3.0)));
  EXPECT_TRUE(comes([&] { return receiver_.lost().find("announced") != std::string::npos; }));
  EXPECT_TRUE(comes([&] { return links_ > 1; })) << "asked for";
  const auto other = mapAt(-4.0, {"#.......#"}, 0.0);
  maps_.publish(other);
  EXPECT_TRUE(hasCome(other));
  EXPECT_EQ(receiver_.lost(), "");
}

// By its stamp no map would ever be the one that was announced.
TEST_F(MapReceiverTest, AnAnnouncementFromTheFutureIsOverWithTheMapThatWasAskedFor) {
  firstMap(5.0);
  auto announcement = announcementOf(mapAt(-4.0, {"........#"}, 3.0));
  announcement.header.stamp = ros::TIME_MAX;
  send(announcement);
  ASSERT_TRUE(comes([&] { return links_ > 1; }));
  const auto asked = mapAt(-4.0, {"........#"}, 0.0);
  maps_.publish(asked);
  ASSERT_TRUE(hasCome(asked));
  send(cellAt(0, 100, 0.0));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), mapAt(-4.0, {"#.......#"}, 0.0).data);
  EXPECT_EQ(receiver_.lost(), "");
}

// Lost soon after a whole map was asked for, and nothing followed: it was not asked for again, and the vehicle stood for good.
TEST_F(MapReceiverTest, AnUpdateThatIsLostSoonAfterAnotherIsAskedForAgain) {
  firstMap(5.0);
  send(cellAt(0, 0, 4.0));
  ++number_;
  send(cellAt(1, 0, 3.0));
  ASSERT_TRUE(comes([&] { return links_ == 2; }));
  maps_.publish(mapAt(0.0, {"...##"}, 0.0));
  ASSERT_TRUE(comes([&] { return receiver_.lost().empty(); }));
  ++number_;
  send(cellAt(1, 0, 0.0));
  ASSERT_TRUE(comes([&] { return !receiver_.lost().empty(); }));
  EXPECT_TRUE(comes([&] { return links_ > 2; })) << "though no update has come since";
}

// costmap_2d stamps the map and not what changes in it: each change was dropped as older than the map, and the planner went
// on with the first one for ever.
TEST_F(MapReceiverTest, AnUpdateWithoutAStampCountsInTheOrderInWhichItComes) {
  const auto unstamped = [](int column, std::int8_t value) {
    auto update = cellAt(column, value, 0.0);
    update.header.stamp = ros::Time();
    return update;
  };
  const auto before = firstMap(5.0);
  send(unstamped(0, 100));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), mapAt(0.0, {"#...#"}, 0.0).data);
  EXPECT_EQ(receiver_.latest().stamp, before.header.stamp) << "of the newest message that has one";
  send(cellAt(1, 100, 1.0));
  send(unstamped(2, 100));
  ASSERT_TRUE(isTaken());
  EXPECT_EQ(values(), mapAt(0.0, {"###.#"}, 0.0).data);
  maps_.publish(mapAt(0.0, {"...##"}, 2.0));
  EXPECT_TRUE(comes([&] { return values() == mapAt(0.0, {".#.##"}, 0.0).data; }))
      << "with what is stamped later, and without what came before it";
  EXPECT_EQ(receiver_.lost(), "");
}

// By the code, a listener that failed once never heard of the cells of that change, where the map itself had them.
TEST_F(MapReceiverTest, AChangeThatItsListenerDidNotTakeIsAskedForAndToldWhole) {
  firstMap(5.0);
  ASSERT_EQ(wholes_, 1);
  const int links = links_;
  fails_ = true;
  send(cellAt(0, 100, 4.0));
  ASSERT_TRUE(comes([&] { return !fails_ && !receiver_.lost().empty() && links_ > links; }));
  EXPECT_EQ(wholes_, 1);
  maps_.publish(mapAt(0.0, {"#...#"}, 0.0));  // as it is already
  ASSERT_TRUE(comes([&] { return receiver_.lost().empty(); }));
  EXPECT_EQ(wholes_, 2);
}

// A map that was refused had all updates forgotten that a good one was to be taken with.
TEST_F(MapReceiverTest, AMapThatIsRefusedTakesNothingWithIt) {
  firstMap(5.0);
  send(cellAt(0, 100, 1.0));
  ASSERT_TRUE(isTaken());
  auto bad = mapAt(0.0, {"....#"}, 0.0);
  bad.header.stamp = ros::TIME_MAX;
  bad.data.pop_back();
  maps_.publish(bad);
  ASSERT_TRUE(comes([&] { return !receiver_.refusal().empty(); }));
  maps_.publish(mapAt(0.0, {"..#.#"}, 2.0));
  EXPECT_TRUE(comes([&] { return values() == mapAt(0.0, {"#.#.#"}, 0.0).data; }));
  EXPECT_EQ(receiver_.lost(), "");
}

TEST(MapTopic, AnnouncesAMapOfAnotherPlace) {
  ros::NodeHandle nh("announced");
  GuardedQueue queue(*ros::getGlobalCallbackQueue());  // waits for what still runs
  nh.setCallbackQueue(&queue);
  MapTopic topic(nh, "map", true, [] {});
  const test::Latest<map_msgs::OccupancyGridUpdate> updates(nh, "map_updates");
  ASSERT_TRUE(test::waitFor([&] { return updates.connected(); }));
  topic.send(mapAt(0.0, {"....#"}, 5.0));
  topic.send(mapAt(0.0, {"#...#"}, 4.0));
  const auto grown = mapAt(-4.0, {"........#"}, 3.0);
  topic.send(grown);
  topic.send(cellAt(0, 100, 2.0));
  ASSERT_TRUE(updates.waitFor(0, [](const auto& update) { return !hasNoCells(update); }));
  const auto all = updates.all();
  ASSERT_EQ(all.size(), 2U) << "nothing of the first map, and of the second";
  EXPECT_TRUE(isAnnouncement(all.front()));
  EXPECT_EQ(all.front().header.stamp, grown.header.stamp);
}

}  // namespace
}  // namespace grid_path_planner::nodes
