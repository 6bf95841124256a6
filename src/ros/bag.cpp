#include "grid_path_planner/ros/bag.h"

#include <nav_msgs/OccupancyGrid.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "grid_path_planner/grid/map_format.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner {
namespace {

constexpr std::string_view kSignature = "#ROSBAG";

// The first bytes of a file; fewer where it is shorter.
std::string beginningOf(const std::string& file, std::size_t count) {
  std::string bytes(count, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

// rosbag's own sentences name neither the file nor the reason.
void checkIsBag(const std::string& file) {
  if (std::filesystem::is_directory(file)) throw InputError(file, "is a directory, expected a bag");
  if (!std::ifstream(file, std::ios::binary))
    throw InputError(file, std::string("cannot be read: ") + std::strerror(errno));
  if (beginningOf(file, kSignature.size()) != kSignature) throw InputError(file, "is not a bag");
}

std::string listOf(const std::set<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

// The names under which the bag knows `topic`, with and without a leading slash.
std::vector<std::string> namesInBag(rosbag::Bag& bag, const std::string& file,
                                    const std::string& topic) {
  std::vector<std::string> names;
  std::set<std::string> maps;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    if (connection->datatype != "nav_msgs/OccupancyGrid") continue;
    maps.insert(connection->topic);
    if (frameName(connection->topic) == frameName(topic)) names.push_back(connection->topic);
  }
  if (!names.empty()) return names;
  throw InputError(file,
                   "has no nav_msgs/OccupancyGrid on '" + topic + "'" +
                       (maps.empty() ? " nor on any other topic" : ", but on " + listOf(maps)));
}

nav_msgs::OccupancyGrid::ConstPtr firstMessage(const std::string& file, const std::string& topic) {
  rosbag::Bag bag(file, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery(namesInBag(bag, file, topic)));
  for (const rosbag::MessageInstance& instance : view)
    if (const auto message = instance.instantiate<nav_msgs::OccupancyGrid>()) return message;
  throw InputError(file, "has no message on '" + topic + "'");
}

}  // namespace

OccupancyGrid readMapFromBag(const std::string& file, const std::string& topic) {
  checkIsBag(file);
  nav_msgs::OccupancyGrid::ConstPtr message;
  try {
    message = firstMessage(file, topic);
  } catch (const rosbag::BagUnindexedException&) {
    throw InputError(file, "was not closed or is cut short (`rosbag reindex` may mend it)");
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(file, std::string("cannot be read as a bag: ") + error.what());
  }
  try {
    return occupancyFromMessage(*message);
  } catch (const InputError& error) {
    throw InputError(file, "the first map on '" + topic + "': " + error.what());
  }
}

OccupancyGrid readAnyMapFile(const std::string& file, const MapFileOptions& options) {
  const bool is_bag =
      extensionOf(file) == "bag" || beginningOf(file, kSignature.size()) == kSignature;
  if (!is_bag) return readMapFile(file, options);
  OccupancyGrid map = readMapFromBag(file);
  const GridGeometry& own = map.geometry();
  const GridGeometry geometry =
      mapGeometry(file, own.width(), own.height(), own.resolution(), own.origin(), options);
  return OccupancyGrid(geometry, std::move(map.values()));
}

}  // namespace grid_path_planner
