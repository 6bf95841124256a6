#include "ros/mapping/projected_map_publisher.h"

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <algorithm>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using grid::CellRect;
using grid::OccupancyGrid;
using mapping::MapModel;
using mapping::ProjectedMapOptions;
using mapping::ProjectionChange;

namespace {

map_msgs::OccupancyGridUpdate updateMessage(const OccupancyGrid& grid, const CellRect& cells) {
  map_msgs::OccupancyGridUpdate message;
  message.x = cells.column;
  message.y = cells.row;
  message.width = static_cast<std::uint32_t>(cells.width);
  message.height = static_cast<std::uint32_t>(cells.height);
  message.data.reserve(static_cast<std::size_t>(cells.width) * cells.height);
  for (int row = cells.row; row < cells.row + cells.height; ++row) {
    const std::int8_t* first = grid.row(row) + cells.column;
    message.data.insert(message.data.end(), first, first + cells.width);
  }
  return message;
}

}  // namespace

ProjectedMapPublisher::ProjectedMapPublisher(ros::NodeHandle nh, bool latch,
                                             std::function<void()> on_subscriber) {
  const auto connected =
      [this, on_subscriber = std::move(on_subscriber)](const ros::SingleSubscriberPublisher&) {
        new_subscriber_ = true;
        on_subscriber();
      };
  map_publisher_ =
      nh.advertise<nav_msgs::OccupancyGrid>("projected_map", 5, connected, {}, {}, latch);
  update_publisher_ =
      nh.advertise<map_msgs::OccupancyGridUpdate>("projected_map_updates", 100, connected);
}

bool ProjectedMapPublisher::hasSubscribers() const {
  return map_publisher_.getNumSubscribers() > 0 || update_publisher_.getNumSubscribers() > 0;
}

void ProjectedMapPublisher::publish(MapModel& map, const ros::Time& stamp) {
  if (!hasSubscribers()) return;
  send(map, stamp);
  newest_published_cloud_ = newest_cloud_;
}

void ProjectedMapPublisher::send(MapModel& map, const ros::Time& stamp) {
  const OccupancyGrid& grid = map.grid();
  const ProjectionChange change = map.takeChange();
  const ProjectedMapOptions& options = map.options();
  const bool for_new_subscriber =
      new_subscriber_.exchange(false) && (options.latch || !options.always_send_full_map);
  const bool changed = change.geometry || !change.cells.empty();
  if (for_new_subscriber || change.geometry || wholeMapIsDue(options) ||
      (changed && (options.always_send_full_map || !sent_))) {
    map_publisher_.publish(occupancyToMessage(grid, options.frame_id, stamp));
    sent_ = true;
    updated_ = false;
    sent_at_ = std::chrono::steady_clock::now();
  } else if (changed) {
    map_msgs::OccupancyGridUpdate update = updateMessage(grid, change.cells);
    update.header.frame_id = options.frame_id;
    update.header.stamp = stamp;
    update_publisher_.publish(update);
    updated_ = true;
  }
}

bool ProjectedMapPublisher::wholeMapIsDue(const ProjectedMapOptions& options) const {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - sent_at_;
  return updated_ && passed.count() >= options.full_map_period;
}

void ProjectedMapPublisher::countCloud(const ros::Time& stamp, const ros::Time& now) {
  if (stamp > newest_cloud_ || newest_cloud_ > now) newest_cloud_ = std::min(stamp, now);
}

void ProjectedMapPublisher::publishHeartbeat(const std::string& frame_id) {
  map_msgs::OccupancyGridUpdate heartbeat;
  heartbeat.header.frame_id = frame_id;
  heartbeat.header.stamp = newest_published_cloud_;
  update_publisher_.publish(heartbeat);
}

}  // namespace grid_path_planner::nodes
