#include "ros/localization/marker_publisher.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/image_encodings.h>
#include <visualization_msgs/MarkerArray.h>

#include <boost/make_shared.hpp>

#include "ros/guard/outgoing/latched_message.h"
#include "vision/marker_picture.h"

namespace grid_path_planner::nodes {

using geometry_msgs::PoseWithCovarianceStamped;
using localization::MountedPose;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

namespace {

constexpr double kThickness = 0.01;  // m, of a marker in rviz

geometry_msgs::Pose poseOf(const Eigen::Vector3d& position, const Eigen::Quaterniond& attitude) {
  const Eigen::Quaterniond unit = attitude.normalized();
  geometry_msgs::Pose pose;
  pose.position.x = position.x();
  pose.position.y = position.y();
  pose.position.z = position.z();
  pose.orientation.x = unit.x();
  pose.orientation.y = unit.y();
  pose.orientation.z = unit.z();
  pose.orientation.w = unit.w();
  return pose;
}

// With errors of the attitude about the map's axes, as geometry_msgs has them.
PoseWithCovarianceStamped messageOf(const MountedPose& pose, const std::string& frame,
                                    const ros::Time& stamp) {
  PoseWithCovarianceStamped message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.pose.pose = poseOf(pose.position, pose.attitude);
  const localization::PoseCovariance covariance = localization::worldCovariance(pose);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      message.pose.covariance[6 * row + column] =
          0.5 * (covariance(row, column) + covariance(column, row));
  return message;
}

Marker markerOf(int id, const Eigen::Isometry3d& map_from_tag, double size, bool seen) {
  Marker marker;
  marker.ns = "markers";
  marker.id = id;
  marker.type = Marker::CUBE;
  marker.pose = poseOf(map_from_tag.translation(), Eigen::Quaterniond(map_from_tag.linear()));
  marker.scale.x = marker.scale.y = size;
  marker.scale.z = kThickness;
  marker.color.g = seen ? 1.0f : 0.4f;
  marker.color.r = marker.color.b = seen ? 0.0f : 0.4f;
  marker.color.a = 1.0f;
  return marker;
}

bool wasSeen(int id, const vision::MarkerFix& fix) {
  for (const vision::MarkerView& view : fix.views)
    if (view.id == id) return true;
  return false;
}

}  // namespace

MarkerPublisher::MarkerPublisher(ros::NodeHandle& nh)
    : pose_(nh.advertise<PoseWithCovarianceStamped>("marker_pose", 10)),
      panel_(nh.advertise<PoseWithCovarianceStamped>("panel_pose", 1, true)),
      markers_(nh.advertise<MarkerArray>("panel_markers", 1)),
      picture_(nh.advertise<sensor_msgs::Image>("marker_image", 1)) {}

void MarkerPublisher::publishPanel(const vision::PanelPose& panel, const std::string& map_frame,
                                   const ros::Time& stamp) const {
  const MountedPose pose{panel.map_from_panel.translation(),
                         Eigen::Quaterniond(panel.map_from_panel.linear()), panel.covariance};
  publishLatched(panel_, messageOf(pose, map_frame, stamp));
}

void MarkerPublisher::publish(const MarkerImage& image, const MarkerAnswer& answer,
                              const vision::MarkerLayout& layout) const {
  if (answer.base)
    pose_.publish(messageOf(*answer.base, image.options.map_frame, image.message->header.stamp));
  if (markers_.getNumSubscribers() > 0 && image.panel) publishMarkers(image, answer, layout);
  if (picture_.getNumSubscribers() > 0) publishPicture(image, answer, layout);
}

void MarkerPublisher::publishMarkers(const MarkerImage& image, const MarkerAnswer& answer,
                                     const vision::MarkerLayout& layout) const {
  MarkerArray array;
  for (const auto& [id, panel_from_tag] : layout.panel_from_tag) {
    array.markers.push_back(markerOf(id, image.panel->map_from_panel * panel_from_tag,
                                     layout.tag_size, wasSeen(id, answer.fix)));
    array.markers.back().header.frame_id = image.options.map_frame;
    array.markers.back().header.stamp = image.message->header.stamp;
  }
  markers_.publish(array);
}

void MarkerPublisher::publishPicture(const MarkerImage& image, const MarkerAnswer& answer,
                                     const vision::MarkerLayout& layout) const {
  const auto picture = boost::make_shared<sensor_msgs::Image>();
  picture->header = image.message->header;
  picture->width = image.message->width;
  picture->height = image.message->height;
  picture->encoding = sensor_msgs::image_encodings::RGB8;
  picture->step = 3 * picture->width;
  picture->data = markerPicture(greyImageOf(image, answer), answer.markers, layout, answer.fix);
  picture_.publish(picture);
}

}  // namespace grid_path_planner::nodes
