// What marker_localizer finds, as topics.
//
//   marker_pose    geometry_msgs/PoseWithCovarianceStamped: base_frame in map_frame, with the image's stamp
//   panel_pose     geometry_msgs/PoseWithCovarianceStamped in map_frame, latched
//   panel_markers  visualization_msgs/MarkerArray in map_frame: the layout; green is what was seen
//   marker_image   sensor_msgs/Image: the image with what was found in it
//
// The last two are made only while somebody listens. Any thread may publish.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "ros/localization/marker_poses.h"

namespace grid_path_planner::nodes {

class MarkerPublisher {
 public:
  explicit MarkerPublisher(ros::NodeHandle& nh);

  void publishPanel(const vision::PanelPose& panel, const std::string& map_frame,
                    const ros::Time& stamp) const;
  // Its pose, where there is one, and views.
  void publish(const MarkerImage& image, const MarkerAnswer& answer,
               const vision::MarkerLayout& layout) const;

 private:
  void publishMarkers(const MarkerImage& image, const MarkerAnswer& answer,
                      const vision::MarkerLayout& layout) const;
  void publishPicture(const MarkerImage& image, const MarkerAnswer& answer,
                      const vision::MarkerLayout& layout) const;

  ros::Publisher pose_, panel_, markers_, picture_;
};

}  // namespace grid_path_planner::nodes
