#include "ros/mapping/projected_map_publisher.h"

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/mapping/floor_warning.h"

namespace grid_path_planner::nodes {

using grid::OccupancyGrid;
using mapping::MapModel;
using mapping::ProjectedMapOptions;
using mapping::ProjectionChange;

ProjectedMapPublisher::ProjectedMapPublisher(ros::NodeHandle nh, bool latch,
                                             std::function<void()> on_subscriber)
    : topic_(std::move(nh), "projected_map", latch, std::move(on_subscriber)) {}

void ProjectedMapPublisher::publish(MapModel& map, const ros::Time& now) {
  if (!topic_.hasSubscribers()) return;
  newest_cloud_ = std::min(newest_cloud_, now);  // ROS time went back
  const bool torn = std::exchange(torn_, true);  // an error ended the last
  send(map, now, owes_map_ || torn);
  owes_map_ = torn_ = false;
  newest_published_cloud_ = newest_cloud_;
}

void ProjectedMapPublisher::owe() {
  if (topic_.hasSubscribers()) owes_map_ = true;
}

bool ProjectedMapPublisher::wholeMapIsWanted(const ProjectionChange& change,
                                             const ProjectedMapOptions& options) {
  const bool for_new_subscriber =
      topic_.takeNewSubscriber() && (options.latch || !options.always_send_full_map);
  if (for_new_subscriber || change.geometry || topic_.wholeMapIsDue(options.full_map_period))
    return true;
  return !change.cells.empty() &&
         (options.always_send_full_map || topic_.needsWholeMaps() || !sent_);
}

void ProjectedMapPublisher::send(MapModel& map, const ros::Time& now, bool whole) {
  const OccupancyGrid& grid = map.grid();
  const ProjectionChange change = map.takeChange();
  const std::string& frame_id = map.options().frame_id;
  if (wholeMapIsWanted(change, map.options()) || whole) {
    topic_.send(occupancyToMessage(grid, frame_id, topic_.stampFor(newest_cloud_, now)));
    sent_ = true;
    warnOfFloor(grid, map.options());
  } else if (!change.cells.empty()) {
    topic_.send(updateOf(grid, change.cells, frame_id, topic_.stampFor(newest_cloud_, now)));
  }
}

void ProjectedMapPublisher::warnOfFloor(const OccupancyGrid& grid,
                                        const ProjectedMapOptions& options) {
  if (warned_of_floor_) return;
  const std::string warning = floorWarning(grid, options);
  warned_of_floor_ = !warning.empty();
  if (warned_of_floor_) ROS_WARN_STREAM(warning);
}

void ProjectedMapPublisher::countCloud(const ros::Time& stamp, const ros::Time& now) {
  newest_cloud_ = std::min(std::max(stamp, newest_cloud_), now);
}

void ProjectedMapPublisher::publishHeartbeat(const std::string& frame_id) {
  if (!owes_map_ && !torn_) topic_.sendHeartbeat(updateOf({}, frame_id, newest_published_cloud_));
}

}  // namespace grid_path_planner::nodes
