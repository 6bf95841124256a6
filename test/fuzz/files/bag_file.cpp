#include <nav_msgs/OccupancyGrid.h>
#include <rosbag/bag.h>

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/ros/bag.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::fuzz {
namespace {

std::string bagWith(rosbag::CompressionType compression) {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.resolution = 0.5f;
  map.info.width = 3;
  map.info.height = 2;
  map.info.origin.orientation.w = 1.0;
  map.data = {0, 0, 100, -1, 50, 7};
  const test::TemporaryFolder folder;
  rosbag::Bag bag(folder.path("fuzz.bag"), rosbag::bagmode::Write);
  bag.setCompression(compression);
  bag.write("projected_map", ros::Time(1, 0), map);
  bag.close();
  return test::contentOf(folder.path("fuzz.bag"));
}

std::vector<std::string> seedsOfBags() {
  return {bagWith(rosbag::compression::Uncompressed), bagWith(rosbag::compression::BZ2),
          bagWith(rosbag::compression::LZ4)};
}

FUZZ_TARGET(bag_file, seedsOfBags) {
  const std::string file = fileOf("fuzz.bag", input);
  mayRefuse([&] { grid::checkOccupancyValues(nodes::readMapFromBag(file)); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
