#include "grid_path_planner/ros/bag.h"

#include <nav_msgs/OccupancyGrid.h>

#include <map>
#include <set>

#include "grid/foreign_values.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/messages/bag_reader.h"

namespace grid_path_planner::nodes {

using base::extensionOf;
using base::InputError;
using grid::GridGeometry;
using grid::MapFileOptions;
using grid::mapGeometry;
using grid::OccupancyGrid;
using grid::readMapFile;

namespace {

constexpr char kUsualTopic[] = "projected_map";
// The bytes of the message, the message, and the map made of it.
constexpr std::size_t kCopiesOfMap = 3;
constexpr std::string_view kBeginningOfBags = "#ROSBAG";

// The first bytes of a file; fewer where it is shorter.
std::string beginningOf(const std::string& file, std::size_t count) {
  return base::RegularFile(file).read(0, count);
}

using Warn = std::function<void(const std::string&)>;

bool isMap(const BagConnection& connection) {
  return connection.type == ros::message_traits::datatype<nav_msgs::OccupancyGrid>() &&
         connection.md5_sum == ros::message_traits::md5sum<nav_msgs::OccupancyGrid>();
}

std::string withoutSlash(const std::string& topic) {
  return !topic.empty() && topic.front() == '/' ? topic.substr(1) : topic;
}

// A topic of maps, and its connections.
using MapsOfTopic = std::map<std::string, std::set<std::uint32_t>>;

MapsOfTopic mapsOfTopics(const BagReader& bag) {
  MapsOfTopic maps;
  for (const BagConnection& connection : bag.connections())
    if (isMap(connection)) maps[withoutSlash(connection.topic)].insert(connection.id);
  return maps;
}

std::string listOf(const MapsOfTopic& maps) {
  std::string list;
  for (const auto& [topic, connections] : maps) list += (list.empty() ? "" : ", ") + topic;
  return list;
}

// That of `topic`, or of kUsualTopic, or the only one, of which `warn` is told.
MapsOfTopic::value_type chosenMaps(const BagReader& bag, const std::string& file,
                                   const std::string& topic, const Warn& warn) {
  const MapsOfTopic maps = mapsOfTopics(bag);
  const std::string wanted = topic.empty() ? kUsualTopic : withoutSlash(topic);
  if (const auto found = maps.find(wanted); found != maps.end()) return *found;
  if (topic.empty() && maps.size() == 1) {
    if (warn)
      warn(file + ": the map of its topic '" + maps.begin()->first + "' is taken, the only one");
    return *maps.begin();
  }
  if (maps.empty())
    throw InputError(file,
                     "has no nav_msgs/OccupancyGrid on '" + wanted + "' nor on any other topic");
  throw InputError(
      file, "has no nav_msgs/OccupancyGrid on '" + wanted + "', but on " + listOf(maps) +
                (topic.empty() ? ": name one, with --topic, or bag_topic of map_publisher" : ""));
}

// By the beginning of a serialized map. Of one that ends too early nobody knows: it is refused when it is unpacked.
bool isEmpty(std::string_view bytes) {
  auto* const data = reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data()));
  ros::serialization::IStream stream(data, static_cast<std::uint32_t>(bytes.size()));
  nav_msgs::OccupancyGrid beginning;
  std::uint32_t cells = 1;
  try {
    stream.next(beginning.header);
    stream.next(beginning.info);
    stream.next(cells);
  } catch (const ros::serialization::StreamOverrunException&) {
    return false;
  }
  return cells == 0 && isEmptyMap(beginning);
}

// The first that has cells.
std::string firstMap(const BagReader& bag, const std::set<std::uint32_t>& connections,
                     const std::string& file, const std::string& topic) {
  std::optional<std::string> first;
  bool is_empty = false;  // the last one
  bag.visit(connections, [&](const BagMessage& message) {
    is_empty = isEmpty(message.bytes);
    if (is_empty) return true;
    first = std::string(message.bytes);
    return false;
  });
  if (first) return *std::move(first);
  throw InputError(file, is_empty ? "has no map with cells on '" + topic + "'"
                                  : "has no message on '" + topic + "'");
}

}  // namespace

OccupancyGrid readMapFromBag(const std::string& file, const std::string& topic,
                             const base::ReadLimits& limits, const Warn& warn) {
  return base::readWithin(file, limits, [&](base::ReadLimits& within) {
    const BagReader bag(file, within);
    const auto [name, connections] = chosenMaps(bag, file, topic, warn);
    const std::string bytes = firstMap(bag, connections, file, name);
    within.take(file, kCopiesOfMap * bytes.size());
    try {
      const auto message = messageFromBytes<nav_msgs::OccupancyGrid>(bytes);
      OccupancyGrid map = occupancyFromMessage(message);
      if (warn && hasNoOrientation(message.info)) warn(file + ": " + base::kYawAssumed);
      if (warn && grid::isInflated(map.values(), message.info.width))
        warn(file + ": " + grid::kInflated);
      return map;
    } catch (const InputError& error) {
      throw InputError(file, "the first map on '" + name + "': " + error.what());
    }
  });
}

OccupancyGrid readAnyMapFile(const std::string& file, const MapFileOptions& options) {
  const bool is_bag =
      extensionOf(file) == "bag" || beginningOf(file, kBeginningOfBags.size()) == kBeginningOfBags;
  if (!is_bag && !options.bag_topic.empty())
    throw InputError(file, "is no bag, and has no topic '" + options.bag_topic + "'");
  if (!is_bag) return readMapFile(file, options);
  OccupancyGrid map = readMapFromBag(file, options.bag_topic, options.limits, options.warn);
  const GridGeometry& own = map.geometry();
  const GridGeometry geometry =
      mapGeometry(file, own.width(), own.height(), own.resolution(), own.origin(), options);
  return OccupancyGrid(geometry, std::move(map.values()));
}

}  // namespace grid_path_planner::nodes
