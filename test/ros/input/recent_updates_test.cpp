#include "ros/input/recent_updates.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

namespace grid_path_planner::nodes {
namespace {

const ros::Time kTaken(100.0);

RecentUpdates::Update updateAt(double stamp, int x, std::int8_t value, std::size_t cells = 1) {
  auto update = boost::make_shared<map_msgs::OccupancyGridUpdate>();
  update->header.stamp = ros::Time(stamp);
  update->x = x;
  update->width = static_cast<std::uint32_t>(cells);
  update->height = 1;
  update->data.assign(cells, value);
  return update;
}

nav_msgs::OccupancyGrid mapOf(std::uint32_t width, std::uint32_t height) {
  nav_msgs::OccupancyGrid map;
  map.info.width = width;
  map.info.height = height;
  map.data.assign(std::size_t{width} * height, 0);
  return map;
}

std::vector<int> columnsOf(const std::vector<RecentUpdates::Update>& updates) {
  std::vector<int> columns;
  for (const auto& update : updates) columns.push_back(update->x);
  return columns;
}

TEST(RecentUpdates, AreThoseOfThePublisherThatAreNewerThanTheMap) {
  RecentUpdates recent;
  recent.keep("/a", updateAt(1.0, 1, 100), kTaken);
  recent.keep("/a", updateAt(2.0, 2, 100), kTaken);
  recent.keep("/b", updateAt(3.0, 3, 100), kTaken);
  recent.keep("/a", updateAt(3.0, 4, 100), kTaken);
  recent.keep("/a", updateAt(100.1, 5, 100), kTaken);  // /clock is late
  EXPECT_EQ(columnsOf(recent.since("/a", ros::Time(1.0), ros::Time(3.0))),
            std::vector<int>({2, 4}));
  recent.forgetBefore("/a", ros::Time(1.0), kTaken);
  EXPECT_EQ(columnsOf(recent.since("/a", ros::Time(1.0))), std::vector<int>({2, 4, 5}))
      << "for the next map";
  EXPECT_TRUE(recent.since("/b", ros::Time(0.0)).empty()) << "of another publisher's map";
}

// What was seen before, by reading: an update whose stamp was hours ahead was laid upon every later map of its publisher, also
// where these had an obstacle; once it was forgotten, every map lacked it.
TEST(RecentUpdates, OneFromFarAheadIsNotKept) {
  RecentUpdates recent;
  for (const double stamp : {110.1, 7200.0, 4294967295.0})
    recent.keep("/a", updateAt(stamp, 1, 0), kTaken);
  EXPECT_TRUE(recent.since("/a", ros::Time(50.0)).empty());
  for (int i = 0; i < 1001; ++i) recent.keep("/a", updateAt(60.0, i, 0), kTaken);
  EXPECT_TRUE(recent.complete(ros::Time(60.0)));
}

// As where its machine's clock is set back: those of before would be laid upon maps that were sent after them.
TEST(RecentUpdates, AreForgottenWhereTheClockOfTheirPublisherWentBack) {
  RecentUpdates recent;
  recent.keep("/b", updateAt(105.0, 9, 0), kTaken);
  recent.keep("/a", updateAt(104.0, 1, 0), kTaken);
  recent.keep("/a", updateAt(105.0, 2, 0), kTaken);
  recent.keep("/a", updateAt(101.0, 3, 100), kTaken);
  EXPECT_EQ(columnsOf(recent.since("/a", ros::Time(100.5))), std::vector<int>({3}));
  EXPECT_EQ(columnsOf(recent.since("/b", ros::Time(100.5))), std::vector<int>({9}));
  EXPECT_FALSE(recent.complete(ros::Time(100.5)));
}

TEST(RecentUpdates, AreCompleteUntilTheOldestAreForgotten) {
  RecentUpdates recent;
  for (int i = 0; i < 1000; ++i) recent.keep("/a", updateAt(1.0 + 0.01 * i, i, 0), kTaken);
  EXPECT_TRUE(recent.complete(ros::Time(0.5)));
  recent.keep("/a", updateAt(20.0, 0, 0), kTaken);
  EXPECT_FALSE(recent.complete(ros::Time(0.5)));
  EXPECT_TRUE(recent.complete(ros::Time(1.0))) << "of its own time is in it";
  recent.keep("/a", updateAt(21.0, 0, 0, 15'999'500), kTaken);
  EXPECT_FALSE(recent.complete(ros::Time(5.0))) << "16 MB";
  EXPECT_EQ(recent.since("/a", ros::Time(19.0)).size(), 2U);
}

// A map without a stamp would be overwritten with all that had come before it.
TEST(RecentUpdates, AreNoneForAMapOfNoTime) {
  RecentUpdates recent;
  recent.keep("/a", updateAt(1.0, 1, 100), kTaken);
  EXPECT_TRUE(recent.since("/a", ros::Time()).empty());
}

TEST(RecentUpdates, AreNotCompleteForAMapThatIsOlderThanOneThatWasTaken) {
  RecentUpdates recent;
  recent.keep("/a", updateAt(2.0, 1, 100), kTaken);
  recent.forgetBefore("/a", ros::Time(3.0), kTaken);
  EXPECT_FALSE(recent.complete(ros::Time(1.0)));
  EXPECT_TRUE(recent.complete(ros::Time(3.0)));
}

// It would be older than all that is kept of its publisher, as where that clock was set back.
TEST(RecentUpdates, OneOfNoTimeIsNotKeptAndForgetsNoOther) {
  RecentUpdates recent;
  recent.keep("/a", updateAt(1.0, 1, 100), kTaken);
  recent.keep("/a", updateAt(0.0, 2, 100), kTaken);
  EXPECT_EQ(columnsOf(recent.since("/a", ros::Time(0.5))), std::vector<int>({1}));
  EXPECT_TRUE(recent.complete(ros::Time(0.5)));
}

// From a map of a time that has not come, every later one of any publisher counted as lacking updates.
TEST(RecentUpdates, AreCompleteAfterAMapFromTheFuture) {
  RecentUpdates recent;
  recent.forgetBefore("/x", ros::TIME_MAX, kTaken);
  EXPECT_TRUE(recent.complete(kTaken));
}

TEST(RecentUpdates, WithoutValuesAndFramesThatNoMapHas) {
  RecentUpdates recent;
  recent.keep("/a", updateAt(1.0, 1, 101), kTaken);
  auto lies = boost::make_shared<map_msgs::OccupancyGridUpdate>(*updateAt(1.0, 1, 0));
  lies->width = lies->height = 4'000'000'000U;
  recent.keep("/a", lies, kTaken);
  for (const std::string& frame : {std::string("a'b"), std::string(1'000'000, 'a')}) {
    auto of_no_frame = boost::make_shared<map_msgs::OccupancyGridUpdate>(*updateAt(1.0, 1, 0));
    of_no_frame->header.frame_id = frame;
    recent.keep("/a", of_no_frame, kTaken);
  }
  EXPECT_TRUE(recent.since("/a", ros::Time(0.5)).empty());
}

TEST(WithUpdates, HasTheNewestOfThoseThatLieInIt) {
  nav_msgs::OccupancyGrid map = mapOf(4, 2);
  auto second_row = boost::make_shared<map_msgs::OccupancyGridUpdate>(*updateAt(1.0, 2, 50, 2));
  second_row->y = 1;
  auto of_another_frame = boost::make_shared<map_msgs::OccupancyGridUpdate>(*updateAt(1.0, 0, 7));
  of_another_frame->header.frame_id = "odom";
  const auto merged =
      withUpdates(map, {updateAt(1.0, 1, 100), updateAt(2.0, 1, -1), second_row, of_another_frame,
                        updateAt(3.0, 3, 100, 2), updateAt(3.0, -1, 100)});
  EXPECT_EQ(merged.data, std::vector<std::int8_t>({0, -1, 0, 0, 0, 0, 50, 50}));
  map.data.pop_back();
  EXPECT_EQ(withUpdates(map, {updateAt(1.0, 1, 100)}).data, map.data) << "a map that is refused";
}

}  // namespace
}  // namespace grid_path_planner::nodes
