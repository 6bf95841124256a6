#include "ros/mapping/octree_publisher.h"

#include "ros/mapping/octree_messages.h"

namespace grid_path_planner::nodes {

using mapping::MapModel;
using mapping::ProjectedMapOptions;

namespace {

constexpr int kRestAfterPublication = 4;  // times what a publication took

visualization_msgs::MarkerArray stamped(visualization_msgs::MarkerArray array,
                                        const std::string& frame, const ros::Time& stamp) {
  for (visualization_msgs::Marker& marker : array.markers) {
    marker.header.frame_id = frame;
    marker.header.stamp = stamp;
  }
  return array;
}

}  // namespace

OctreePublisher::OctreePublisher(ros::NodeHandle nh, ros::NodeHandle service_nh, bool latch,
                                 MappingThread& thread,
                                 const std::function<void()>& on_subscriber) {
  const auto connected = [on_subscriber](const ros::SingleSubscriberPublisher&) {
    on_subscriber();
  };
  using visualization_msgs::MarkerArray;
  const auto markers = [&](const std::string& topic) {
    return nh.advertise<MarkerArray>(topic, 1, connected, {}, {}, latch);
  };
  occupied_.publisher = markers("occupied_cells_vis_array");
  free_.publisher = markers("free_cells_vis_array");
  centres_.publisher = nh.advertise<sensor_msgs::PointCloud2>("octomap_point_cloud_centers", 1,
                                                              connected, {}, {}, latch);
  messages_ = std::make_unique<OctomapMessages>(nh, service_nh, latch, thread, on_subscriber);
}

bool OctreePublisher::isFreeDue(const MapModel& map) const {
  return map.options().publish_free_space && free_.isDue(map);
}

bool OctreePublisher::isDue(const MapModel& map) const {
  return occupied_.isDue(map) || isFreeDue(map) || centres_.isDue(map) || messages_->isDue(map);
}

void OctreePublisher::publish(const MapModel& map, const ros::Time& stamp) {
  const auto start = Clock::now();
  if (start < not_before_ || !isDue(map)) return;
  ++builds_;
  send(map, stamp);
  const auto end = Clock::now();
  not_before_ = end + kRestAfterPublication * (end - start);
}

void OctreePublisher::send(const MapModel& map, const ros::Time& stamp) {
  sendMarkers(map, stamp);
  if (centres_.isDue(map)) {
    const ProjectedMapOptions& options = map.options();
    sensor_msgs::PointCloud2 cloud =
        occupiedCentres(map.map().tree(), {options.occupancy_min_z, options.occupancy_max_z});
    cloud.header.frame_id = options.frame_id;
    cloud.header.stamp = stamp;
    centres_.publish(cloud, map);
  }
  messages_->publish(map, stamp);
}

void OctreePublisher::sendMarkers(const MapModel& map, const ros::Time& stamp) {
  const ProjectedMapOptions& options = map.options();
  const octomap::OcTree& tree = map.map().tree();
  const HeightRange heights{options.occupancy_min_z, options.occupancy_max_z};
  if (occupied_.isDue(map))
    occupied_.publish(
        stamped(occupiedMarkers(tree, heights, options.colors), options.frame_id, stamp), map);
  if (isFreeDue(map))
    free_.publish(stamped(freeMarkers(tree, heights, options.colors), options.frame_id, stamp),
                  map);
}

}  // namespace grid_path_planner::nodes
