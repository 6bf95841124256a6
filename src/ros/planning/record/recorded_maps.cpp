#include "ros/planning/record/recorded_maps.h"

#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/input/map_receiver.h"

namespace grid_path_planner::nodes {

using base::InputError;
using grid::CellRect;
using grid::OccupancyGrid;

void RecordedMaps::take(const nav_msgs::OccupancyGrid& message) {
  if (isEmptyMap(message)) return;
  if (!accepted([&] { replaceMap(message); })) return;
  on_map_(checksum_->value(), *map_);
  while (!recent_.empty() && recent_.front().header.stamp <= stamp_) recent_.pop_front();
  for (const map_msgs::OccupancyGridUpdate& update : recent_) apply(update);
}

void RecordedMaps::take(const map_msgs::OccupancyGridUpdate& message) {
  if (message.data.empty()) return;  // a heartbeat
  recent_.push_back(message);
  if (recent_.size() > kMostRecent) recent_.pop_front();
  if (map_ && message.header.stamp >= stamp_) apply(message);
}

void RecordedMaps::refuse(const std::string& reason) {
  if (refused_++ == 0) first_refusal_ = reason;
}

template <class Change>
bool RecordedMaps::accepted(const Change& change) {
  try {
    change();
    return true;
  } catch (const InputError& error) {
    refuse(error.what());
    return false;
  }
}

void RecordedMaps::replaceMap(const nav_msgs::OccupancyGrid& message) {
  std::string frame_id = frameName(message.header.frame_id);
  OccupancyGrid map = occupancyFromMessage(message);
  if (map_ && map_->geometry() != map.geometry()) recent_.clear();  // of another map
  map_ = std::move(map);
  checksum_.emplace(*map_);
  frame_id_ = std::move(frame_id);
  stamp_ = message.header.stamp;
}

void RecordedMaps::apply(const map_msgs::OccupancyGridUpdate& message) {
  const auto change = [&] {
    const std::string frame_id = frameName(message.header.frame_id);
    if (!frame_id.empty() && frame_id != frame_id_)
      throw InputError("an update in frame " + frame_id + " for a map in frame " + frame_id_);
    const CellRect rect = checkedRect(*map_, message);
    checksum_->change(*map_, rect, [&] { applyUpdate(message, rect, *map_); });
    stamp_ = message.header.stamp;
  };
  if (accepted(change)) on_map_(checksum_->value(), *map_);
}

}  // namespace grid_path_planner::nodes
