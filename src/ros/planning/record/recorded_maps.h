// The maps that a bag holds: whole ones on one topic, and what its updates make of them.
//
//   RecordedMaps maps([](std::uint64_t checksum, const OccupancyGrid& map) { keep(checksum, map); });
//   maps.take(message);  // a whole map, or an update; calls back for each map that there is then
//
// It follows map_receiver.h: what is no map of ours or does not lie in it is refused and changes nothing,
// and an update older than the map is part of it. A map and its updates come on two topics, and the
// recorder may have had them in another order than path_planner: after a map that is older than the
// updates before it these are applied again.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "grid_path_planner/grid/occupancy.h"
#include "ros/planning/record/map_checksum.h"

namespace grid_path_planner::nodes {

class RecordedMaps {
 public:
  // Each map that there is after a message, with its checksum.
  using OnMap = std::function<void(std::uint64_t checksum, const grid::OccupancyGrid& map)>;

  explicit RecordedMaps(OnMap on_map) : on_map_(std::move(on_map)) {}

  void take(const nav_msgs::OccupancyGrid& message);
  void take(const map_msgs::OccupancyGridUpdate& message);
  // A message that is none of these.
  void refuse(const std::string& reason);

  std::size_t refused() const { return refused_; }
  const std::string& firstRefusal() const { return first_refusal_; }

 private:
  static constexpr std::size_t kMostRecent = 8;  // of as many cells as the map, each

  // Whether `change` throws no InputError, which would be a refusal.
  template <class Change>
  bool accepted(const Change& change);
  void replaceMap(const nav_msgs::OccupancyGrid& message);
  void apply(const map_msgs::OccupancyGridUpdate& message);

  OnMap on_map_;
  std::optional<grid::OccupancyGrid> map_;
  std::optional<MapChecksum> checksum_;
  std::string frame_id_;
  ros::Time stamp_;  // of the newest message in the map
  std::deque<map_msgs::OccupancyGridUpdate> recent_;
  std::size_t refused_ = 0;
  std::string first_refusal_;
};

}  // namespace grid_path_planner::nodes
