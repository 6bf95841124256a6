#include "ros/input/map_data.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace grid_path_planner::nodes {
namespace {

constexpr double kTimeout = 3.0;

// Both clocks at so many seconds.
Instant at(double ros, double wall) {
  const std::chrono::duration<double> since(wall);
  return {ros::Time(ros),
          std::chrono::steady_clock::time_point() +
              std::chrono::duration_cast<std::chrono::steady_clock::duration>(since)};
}
Instant at(double seconds) {
  return at(seconds, seconds);
}

bool isOld(const MapData& data, const Instant& now, double driven = 0.0) {
  return data.problem(now, driven, kTimeout).has_value();
}

// The vehicle drove on for 10 m by a map into which nothing had entered since its camera was dead: heartbeats went on.
TEST(MapData, OfACameraThatHasCeasedIsOldWhateverItsMessengerSays) {
  MapData data;
  data.noteMap(ros::Time(100.0), at(100.0));
  for (int i = 0; i <= 10; ++i) {
    data.noteHeartbeat(ros::Time(100.0), at(100.0 + i));
    EXPECT_EQ(isOld(data, at(100.0 + i)), i > 3) << i;
  }
  const std::string why = *data.problem(at(110.0), 0.0, kTimeout);
  EXPECT_NE(why.find("its newest data is 10 s old"), std::string::npos) << why;
  data.noteHeartbeat(ros::Time(110.0), at(110.2));
  EXPECT_FALSE(isOld(data, at(110.2)));
}

TEST(MapData, GrowsOldBetweenMessagesAndAMapMakesItNewToo) {
  MapData data;
  data.noteHeartbeat(ros::Time(100.0), at(100.5));
  EXPECT_FALSE(isOld(data, at(102.9)));
  EXPECT_TRUE(isOld(data, at(103.1)));
  data.noteMap(ros::Time(102.0), at(103.1));
  EXPECT_FALSE(isOld(data, at(103.1)));
  EXPECT_NEAR(data.age(at(104.0)), 2.0, 1e-6);
}

// At 20 times real time a heartbeat a second says once in 20 s how new the map is.
TEST(MapData, GrowsOldByTheSlowerClock) {
  MapData data;
  data.noteHeartbeat(ros::Time(100.0), at(100.5, 10.0));
  EXPECT_FALSE(isOld(data, at(120.5, 11.0)));
  EXPECT_TRUE(isOld(data, at(160.5, 13.0)));
  EXPECT_FALSE(isOld(data, at(100.5, 1000.0))) << "ROS time stands still";
  EXPECT_FALSE(isOld(data, at(50.0, 10.5))) << "it has gone back";
}

// As after ROS time went back, while no cloud has come since.
TEST(MapData, FromAheadIsOfAnotherTime) {
  MapData data;
  data.noteHeartbeat(ros::Time(102.0), at(100.0));
  EXPECT_FALSE(isOld(data, at(100.0))) << "clocks of two machines differ";
  data.noteHeartbeat(ros::Time(900.0), at(100.0));
  EXPECT_NE(data.problem(at(100.0), 0.0, kTimeout)->find("800 s ahead"), std::string::npos);
}

TEST(MapData, OfAFileIsNeverOld) {
  MapData served;
  served.noteMap(ros::Time(100.0), at(100.0));
  served.noteMap(ros::Time(100.0), at(5000.0));  // what is latched, for a new subscription
  EXPECT_FALSE(isOld(served, at(1e6), 1e6));
  MapData read;  // by projected_map, which has had no cloud
  read.noteMap(ros::Time(100.0), at(100.0));
  read.noteHeartbeat(ros::Time(), at(101.0));
  read.noteMap(ros::Time(102.0), at(102.0));
  read.noteHeartbeat(ros::Time(), at(103.0));
  EXPECT_FALSE(isOld(read, at(1e6), 1e6));
}

// gmapping sends a map every 5 s, while the vehicle moves.
TEST(MapData, OfAPublisherWithoutHeartbeatsIsOldAfterThreeOfItsLongestWaits) {
  MapData data;
  for (const double sent : {100.0, 104.0, 109.0, 110.0}) data.noteMap(ros::Time(sent), at(sent));
  EXPECT_FALSE(isOld(data, at(600.0))) << "the vehicle stands, and so does the map";
  EXPECT_FALSE(isOld(data, at(600.0), 14.9));
  EXPECT_TRUE(isOld(data, at(600.0), 15.1));
  EXPECT_NE(data.problem(at(600.0), 15.1, kTimeout)->find("every 5 s"), std::string::npos);
  const std::uint64_t before = data.changes();
  data.noteMap(ros::Time(), at(601.0));
  EXPECT_GT(data.changes(), before) << "by which the driver knows from when to count";
}

TEST(MapData, OfAFastPublisherIsGivenTheTimeout) {
  MapData data;
  for (int i = 0; i < 5; ++i) data.noteMap(ros::Time(100.0 + 0.1 * i), at(100.0 + 0.1 * i));
  EXPECT_FALSE(isOld(data, at(200.0), 2.9));
  EXPECT_TRUE(isOld(data, at(200.0), 3.1));
}

// It was edited: the next map comes when somebody edits it again.
TEST(MapData, OfAMapThatIsSentAgainAfterAMinuteNothingIsExpected) {
  MapData data;
  data.noteMap(ros::Time(100.0), at(100.0));
  data.noteMap(ros::Time(400.0), at(400.0));
  EXPECT_FALSE(isOld(data, at(1e6), 1e6));
  data.noteMap(ros::Time(405.0), at(405.0));
  EXPECT_TRUE(isOld(data, at(1e6), 1e6));
}

}  // namespace
}  // namespace grid_path_planner::nodes
