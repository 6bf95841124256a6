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
  const std::function<void()> noticed = [this, on_subscriber] {
    new_subscriber_ = true;
    on_subscriber();
  };
  const auto connected = [noticed](const ros::SingleSubscriberPublisher&) { noticed(); };
  using visualization_msgs::MarkerArray;
  occupied_ = nh.advertise<MarkerArray>("occupied_cells_vis_array", 1, connected, {}, {}, latch);
  free_ = nh.advertise<MarkerArray>("free_cells_vis_array", 1, connected, {}, {}, latch);
  centres_ = nh.advertise<sensor_msgs::PointCloud2>("octomap_point_cloud_centers", 1, connected, {},
                                                    {}, latch);
  messages_ = std::make_unique<OctomapMessages>(nh, service_nh, latch, thread, noticed);
}

bool OctreePublisher::hasSubscribers() const {
  return occupied_.getNumSubscribers() > 0 || free_.getNumSubscribers() > 0 ||
         centres_.getNumSubscribers() > 0 || messages_->hasSubscribers();
}

void OctreePublisher::publish(const MapModel& map, const ros::Time& stamp) {
  const auto start = Clock::now();
  if (!hasSubscribers() || start < not_before_) return;
  const bool for_new_subscriber = new_subscriber_.exchange(false) && map.options().latch;
  if (!for_new_subscriber && map.revision() == sent_revision_) return;
  send(map, stamp);
  sent_revision_ = map.revision();
  const auto end = Clock::now();
  not_before_ = end + kRestAfterPublication * (end - start);
}

void OctreePublisher::send(const MapModel& map, const ros::Time& stamp) {
  ++builds_;
  sendMarkers(map, stamp);
  if (centres_.getNumSubscribers() > 0) {
    const ProjectedMapOptions& options = map.options();
    sensor_msgs::PointCloud2 cloud =
        occupiedCentres(map.map().tree(), {options.occupancy_min_z, options.occupancy_max_z});
    cloud.header.frame_id = options.frame_id;
    cloud.header.stamp = stamp;
    centres_.publish(cloud);
  }
  messages_->publish(map, stamp);
}

void OctreePublisher::sendMarkers(const MapModel& map, const ros::Time& stamp) {
  const ProjectedMapOptions& options = map.options();
  const octomap::OcTree& tree = map.map().tree();
  const HeightRange heights{options.occupancy_min_z, options.occupancy_max_z};
  if (occupied_.getNumSubscribers() > 0)
    occupied_.publish(
        stamped(occupiedMarkers(tree, heights, options.colors), options.frame_id, stamp));
  if (options.publish_free_space && free_.getNumSubscribers() > 0)
    free_.publish(stamped(freeMarkers(tree, heights, options.colors), options.frame_id, stamp));
}

}  // namespace grid_path_planner::nodes
