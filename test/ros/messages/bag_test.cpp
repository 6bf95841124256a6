#include "grid_path_planner/ros/bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>
#include <sys/stat.h>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "support/ascii_map.h"
#include "support/bounded_run.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using grid::GridGeometry;
using grid::MapFileOptions;
using grid::OccupancyGrid;

namespace {

using test::AsciiMap;
using test::contains;
using test::errorText;

class MapBag : public testing::Test {
 protected:
  // A bag of `maps` on `topic`, a second apart, among other messages.
  std::string write(const std::string& topic, const std::vector<OccupancyGrid>& maps,
                    rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
    const std::string file = folder_.path("a.bag");
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(1000);  // several chunks
    ros::Time time(100, 0);
    for (const OccupancyGrid& map : maps) {
      bag.write("/chatter", time, std_msgs::String());
      bag.write(topic, time, occupancyToMessage(map, "map", time));
      time += ros::Duration(1.0);
    }
    return file;
  }
  std::string errorOf(const std::string& file, const std::string& topic = "") {
    const std::string error = errorText([&] { readMapFromBag(file, topic); });
    return error.substr(std::min(error.size(), folder_.path("").size()));
  }

  const test::TemporaryFolder folder_;
  const OccupancyGrid first_ = AsciiMap({"..#", "?.."}, 0.05, {-1.0, 2.0, 0.0}).map;
  const OccupancyGrid second_ = AsciiMap({"####"}).map;
};

TEST_F(MapBag, TheFirstMapIsReadAndSlashesDoNotMatter) {
  for (const char* recorded : {"projected_map", "/projected_map"}) {
    const std::string file = write(recorded, {first_, second_});
    EXPECT_EQ(readMapFromBag(file), first_);
    EXPECT_EQ(readMapFromBag(file, "projected_map"), first_);
    EXPECT_EQ(readMapFromBag(file, "/projected_map"), first_);
    EXPECT_EQ(readAnyMapFile(file), first_);
  }
}

TEST_F(MapBag, EveryCompressionIsRead) {
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4})
    EXPECT_EQ(readMapFromBag(write("/projected_map", {first_, second_}, compression)), first_);
}

// The map may come long after the first messages of other topics.
TEST_F(MapBag, AMapInALaterChunkIsFound) {
  const std::string file = folder_.path("a.bag");
  {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    bag.setChunkThreshold(100);
    for (int i = 0; i < 50; ++i) bag.write("/chatter", ros::Time(1 + i), std_msgs::String());
    bag.write("/other_map", ros::Time(60), occupancyToMessage(second_, "map", ros::Time(60)));
    bag.write("/projected_map", ros::Time(61), occupancyToMessage(first_, "map", ros::Time(61)));
  }
  EXPECT_EQ(readMapFromBag(file), first_);
  EXPECT_EQ(readMapFromBag(file, "other_map"), second_);
}

// rosbag record was killed.
TEST_F(MapBag, ABagThatWasNotClosedIsRefusedWithTheRemedy) {
  std::string content = test::contentOf(write("/projected_map", {first_}));
  const std::size_t index = content.find("index_pos=") + 10;
  content.replace(index, 8, 8, '\0');
  EXPECT_TRUE(contains(errorOf(folder_.write("b.bag", content)), "`rosbag reindex` may mend it"));
}

TEST_F(MapBag, OptionsOverrideTheGeometry) {
  MapFileOptions options;
  options.resolution = 0.5;
  const OccupancyGrid map = readAnyMapFile(write("/projected_map", {first_}), options);
  EXPECT_EQ(map.geometry(), GridGeometry(3, 2, 0.5, {-1.0, 2.0, 0.0}));
  EXPECT_EQ(map.values(), first_.values());
}

TEST_F(MapBag, OtherFormatsAreReadToo) {
  EXPECT_EQ(
      readAnyMapFile(folder_.write("a.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n")).values(),
      AsciiMap({".#."}).map.values());
  EXPECT_TRUE(contains(errorText([&] { readAnyMapFile(folder_.path("none.map")); }),
                       "none.map: cannot be read: No such file or directory"));
}

// Of SLAM it is map_server's: it was refused, and of grid_path nothing could name it.
TEST_F(MapBag, TheOnlyTopicOfMapsIsTakenAndTold) {
  MapFileOptions options;
  std::vector<std::string> warnings;
  options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
  const std::string file = write("/map", {first_, second_});
  EXPECT_EQ(readAnyMapFile(file, options), first_);
  EXPECT_EQ(warnings,
            std::vector<std::string>{file + ": the map of its topic 'map' is taken, the only one"});
  options.bag_topic = "/map";
  EXPECT_EQ(readAnyMapFile(file, options), first_);
  EXPECT_EQ(warnings.size(), 1u) << "it was named";
}

TEST_F(MapBag, OfSeveralTopicsOneIsNamed) {
  const std::string file = folder_.path("a.bag");
  {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    bag.write("/costmap", ros::Time(1), occupancyToMessage(first_, "map", ros::Time(1)));
    bag.write("/map", ros::Time(2), occupancyToMessage(second_, "map", ros::Time(2)));
  }
  EXPECT_EQ(errorOf(file),
            "a.bag: has no nav_msgs/OccupancyGrid on 'projected_map', but on costmap, map: name "
            "one, with --topic, or bag_topic of map_publisher");
  MapFileOptions options;
  options.bag_topic = "map";
  EXPECT_EQ(readAnyMapFile(file, options), second_);
  EXPECT_TRUE(contains(errorText([&] { readAnyMapFile(folder_.write("a.map", "type"), options); }),
                       "a.map: is no bag, and has no topic 'map'"));
}

TEST_F(MapBag, ATopicThatIsNotThereIsToldWithThoseThatAre) {
  EXPECT_EQ(errorOf(write("/map", {first_}), "chatter"),
            "a.bag: has no nav_msgs/OccupancyGrid on 'chatter', but on map");
  EXPECT_EQ(errorOf(write("/map", {})),
            "a.bag: has no nav_msgs/OccupancyGrid on 'projected_map' nor on any other topic");
}

TEST_F(MapBag, BagsThatCannotBeReadAreNamed) {
  EXPECT_EQ(errorOf(folder_.path("none.bag")),
            "none.bag: cannot be read: No such file or directory");
  EXPECT_TRUE(contains(errorText([&] { readMapFromBag(folder_.path("")); }), "is a directory"));
  EXPECT_EQ(errorOf(folder_.write("b.bag", "")), "b.bag: is not a bag");
  EXPECT_EQ(errorOf(folder_.write("b.bag", "image: a.pgm")), "b.bag: is not a bag");
  EXPECT_TRUE(contains(errorText([&] { readAnyMapFile(folder_.write("b.bag", "x")); }),
                       "b.bag: is not a bag"));
}

// map_publisher waited for the other end for ever.
TEST_F(MapBag, APipeIsRefusedAtOnce) {
  const std::string pipe = folder_.path("pipe.bag");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(errorOf(pipe), "pipe.bag: is no regular file");
  EXPECT_TRUE(contains(errorText([&] { readAnyMapFile(pipe); }), "is no regular file"));
}

TEST_F(MapBag, ABagCutShortIsRefusedWhereverItIsCut) {
  const std::string whole = test::contentOf(write("/projected_map", {first_, second_}));
  for (std::size_t size = 1; size < whole.size(); size += 97)
    EXPECT_FALSE(errorOf(folder_.write("cut.bag", whole.substr(0, size))).empty()) << size;
  EXPECT_EQ(errorOf(folder_.write("cut.bag", whole)), "");
}

TEST_F(MapBag, AMapThatIsNoneIsRefused) {
  const std::string file = folder_.path("a.bag");
  nav_msgs::OccupancyGrid message = occupancyToMessage(first_, "map", ros::Time(1));
  message.data.pop_back();
  {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    bag.write("projected_map", ros::Time(1), message);
  }
  EXPECT_EQ(errorOf(file),
            "a.bag: the first map on 'projected_map': a map of 3x2 cells needs 6 values, got 5");
}

// As octomap_server's.
TEST_F(MapBag, AnOriginWithoutAnOrientationIsYawZeroAndTold) {
  nav_msgs::OccupancyGrid message = occupancyToMessage(first_, "map", ros::Time(1));
  message.info.origin.orientation.w = 0.0;
  const std::string file = folder_.path("a.bag");
  {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    bag.write("projected_map", ros::Time(1), message);
    bag.write("projected_map", ros::Time(2), message);
  }
  MapFileOptions options;
  std::vector<std::string> warnings;
  options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
  EXPECT_EQ(readAnyMapFile(file, options), first_);
  EXPECT_EQ(warnings,
            std::vector<std::string>{file + ": its origin has no orientation: yaw 0 is taken"});
}

// octomap_server sends a map without cells and frame before it has seen anything, and all that is recorded begins with it.
TEST_F(MapBag, MapsWithoutCellsArePassedOver) {
  const std::string file = folder_.path("a.bag");
  const auto record = [&](const std::vector<nav_msgs::OccupancyGrid>& maps) {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    ros::Time time(100, 0);
    for (const auto& map : maps) bag.write("projected_map", time += ros::Duration(1.0), map);
  };
  const nav_msgs::OccupancyGrid empty, first = occupancyToMessage(first_, "map", ros::Time(1));
  record({empty, empty, first});
  EXPECT_EQ(readMapFromBag(file), first_);
  record({empty, empty});
  EXPECT_EQ(errorOf(file), "a.bag: has no map with cells on 'projected_map'");
  nav_msgs::OccupancyGrid wrong;
  wrong.data = {0};
  record({wrong, first});
  EXPECT_TRUE(contains(errorOf(file), "at least one cell, got 0x0"));
}

TEST_F(MapBag, AnInflatedMapIsTold) {
  MapFileOptions options;
  std::vector<std::string> warnings;
  options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
  const OccupancyGrid costmap(GridGeometry(5, 1, 1.0), {50, 99, 100, 99, 50});
  EXPECT_EQ(readAnyMapFile(write("projected_map", {costmap}), options), costmap);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "a.bag: it is inflated, as costmap_2d's maps are"));
}

// 60 MB in some kB.
TEST_F(MapBag, AChunkThatUnpacksToMoreThanTheLimitIsRefused) {
  const OccupancyGrid large(GridGeometry(8000, 8000, 0.05));
  const std::string file = write("projected_map", {large}, rosbag::compression::BZ2);
  base::ReadOptions options;
  options.read_memory_limit = 100;
  const test::BoundedRun run =
      test::runBounded([&] { readMapFromBag(file, "projected_map", options); });
  EXPECT_TRUE(run.ended) << run;
  EXPECT_TRUE(contains(run.refusal, "read_memory_limit")) << run;
  EXPECT_LT(run.megabytes, 100.0) << run;
  EXPECT_EQ(readMapFromBag(file), large);
}

}  // namespace
}  // namespace grid_path_planner::nodes
