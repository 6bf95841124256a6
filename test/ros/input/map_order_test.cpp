#include "ros/input/map_order.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

namespace grid_path_planner::nodes {
namespace {

RecentUpdates::Update updateAt(double stamp, int x = 0) {
  auto update = boost::make_shared<map_msgs::OccupancyGridUpdate>();
  update->header.stamp = ros::Time(stamp);
  update->x = x;
  update->width = update->height = 1;
  update->data = {100};
  return update;
}

// By a clock of the test's.
class MapOrderTest : public testing::Test {
 protected:
  MapOrderTest() {
    ros::Time::init();
    ros::Time::setNow(ros::Time(100.0));
  }
  ~MapOrderTest() override { ros::Time::init(); }

  MapOrder::Whole take(double stamp, const std::string& publisher = "/a") {
    const MapOrder::Whole whole = order_.judge(publisher, ros::Time(stamp), {});
    order_.tookWhole(whole);
    return whole;
  }
  void lay(const RecentUpdates::Update& update) {
    order_.tookUpdate(*update);
    order_.keep("/a", update);
  }

  MapOrder order_;
};

TEST_F(MapOrderTest, AnUpdateOfTheTimeOfTheMapIsNotOld) {
  take(50.0);
  EXPECT_TRUE(order_.isOld(*updateAt(49.9)));
  EXPECT_FALSE(order_.isOld(*updateAt(50.0))) << "nothing newer was measured";
  EXPECT_FALSE(order_.isOld(*updateAt(0.0))) << "it has no stamp";
}

TEST_F(MapOrderTest, AMapThatUpdatesOvertookIsTakenWithThem) {
  take(50.0);
  lay(updateAt(52.0, 1));
  const MapOrder::Whole whole = take(51.0);
  ASSERT_EQ(whole.newer.size(), 1U);
  EXPECT_FALSE(whole.lacks);
  EXPECT_TRUE(order_.isOld(*updateAt(51.5)));
}

// By "stamped later than now" it was guessed that time had gone back: also of what is stamped by a clock that is a second ahead.
TEST_F(MapOrderTest, WhatIsALittleAheadKeepsItsOrder) {
  take(101.0);
  EXPECT_TRUE(order_.isOld(*updateAt(100.9)));
  EXPECT_FALSE(order_.isOld(*updateAt(101.1)));
}

TEST_F(MapOrderTest, WhatIsHoursAheadIsNewerThanNothing) {
  take(7200.0);
  EXPECT_FALSE(order_.isOld(*updateAt(100.0)));
  EXPECT_FALSE(take(100.0).lacks);
}

TEST_F(MapOrderTest, AfterTimeWentBackStampsOfBeforeSayNothing) {
  take(90.0);
  lay(updateAt(95.0));
  order_.noteLoss();
  order_.noteAnnouncement("/a", ros::Time(96.0));
  order_.timeWentBack();
  ros::Time::setNow(ros::Time(94.0));  // by less than those are old
  EXPECT_FALSE(order_.isAwaited("/a"));
  EXPECT_FALSE(order_.isOld(*updateAt(93.0)));
  const MapOrder::Whole whole = take(93.5);
  EXPECT_FALSE(whole.lacks || whole.has_lost);
  EXPECT_TRUE(whole.newer.empty());
}

TEST_F(MapOrderTest, AMapFromBeforeALossHasItTooAndOneFromAfterItHasNot) {
  take(50.0);
  EXPECT_EQ(order_.note("/a", 1), 0U);
  EXPECT_EQ(order_.note("/a", 4), 2U);
  order_.noteLoss(ros::Time(60.0));
  EXPECT_TRUE(take(60.0).has_lost);
  EXPECT_FALSE(take(60.1).has_lost);
  EXPECT_FALSE(take(10.0, "/b").has_lost) << "of another one's maps nothing was";
}

TEST_F(MapOrderTest, AnAnnouncedMapIsAwaitedUntilItComesOrAnotherNodesDoes) {
  take(50.0);
  order_.noteAnnouncement("/b", ros::Time(60.0));
  EXPECT_FALSE(order_.isAwaited("/b")) << "the map is another one's";
  order_.noteAnnouncement("/a", ros::Time(50.0));
  EXPECT_FALSE(order_.isAwaited("/a")) << "it was there before its announcement";
  order_.noteAnnouncement("/a", ros::Time(60.0));
  ASSERT_TRUE(order_.isAwaited("/a"));
  EXPECT_TRUE(take(55.0).is_before);
  EXPECT_TRUE(order_.isAwaited("/a"));
  EXPECT_FALSE(take(60.0).is_before);
  EXPECT_FALSE(order_.isAwaited("/a"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
