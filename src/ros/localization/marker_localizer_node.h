// The node `marker_localizer`: where the vehicle is, by a camera's images of a panel with markers.
//
//   subscribes  camera/image_raw    sensor_msgs/Image
//               camera/camera_info  sensor_msgs/CameraInfo
//               tf                  where the camera is on the vehicle; map_frame -> base_frame as prediction
//   publishes   marker_pose, panel_pose, panel_markers, marker_image     marker_publisher.h
//               /diagnostics
//   services    ~learn_panel        std_srvs/Trigger: the panel stays where the last images had it
//
// Guaranteed: images are looked at one at a time in a thread of its own, always the newest that waits, in rising
// order. What cannot be used changes nothing, and its reason is in the log and in the
// diagnostics. A panel whose pose is known or was learnt stays where it is. ROS time that goes back forgets
// images, tf and stamps, not the panel.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "grid_path_planner/base/task_queue.h"
#include "ros/guard/node_files.h"
#include "ros/guard/node_time.h"
#include "ros/input/input.h"
#include "ros/localization/marker_localizer_options.h"
#include "ros/localization/marker_poses.h"
#include "ros/localization/marker_publisher.h"

namespace grid_path_planner {
class MarkerLocalizerConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class MarkerLocalizerNode {
 public:
  // A layout that no argument names lies below the folder to load from. Throws InputError for parameters and a
  // layout that cannot be used. All callbacks are served by the queue of `nh`, which must be one thread's.
  MarkerLocalizerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                      const NodeFiles& files = {});
  ~MarkerLocalizerNode();

 private:
  void listen(ros::NodeHandle& nh, ros::NodeHandle& private_nh);
  InputRules imageRules() const;
  void use(MarkerLocalizerOptions options);
  void usePanel(const std::optional<vision::PanelPose>& panel);
  void timeWentBack(double seconds);
  void onInfo(const sensor_msgs::CameraInfo& message);
  void lookAtNext();
  void lookAt(const MarkerImage& image, const base::StopToken& stop);
  void learnPanel(std_srvs::Trigger::Response& response);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  // As its camera_info has it.
  struct Camera {
    vision::CameraCalibration calibration;
    std::string frame;  // may be empty
  };
  // Of the images so far.
  struct Tally {
    std::uint64_t poses = 0;
    std::uint64_t diagnosed = 0;         // those that were used when the diagnostics were last made
    std::optional<MarkerAnswer> newest;  // without pixels
    ros::Time newest_stamp;
  };

  MarkerLocalizerOptions options_;
  const vision::MarkerLayout layout_;
  FrameTransforms transforms_;
  MarkerPublisher publisher_;
  std::optional<Camera> camera_;
  std::optional<vision::PanelPose> panel_;

  std::mutex mutex_;  // of the next two
  Tally tally_;
  vision::PanelSightings sightings_;

  std::unique_ptr<Input<sensor_msgs::CameraInfo>> infos_;
  std::unique_ptr<Input<sensor_msgs::Image>> images_;
  ros::ServiceServer learn_panel_;
  diagnostic_updater::Updater diagnostics_;
  ros::SteadyTimer diagnostics_timer_;
  std::unique_ptr<Reconfigurable<MarkerLocalizerConfig, MarkerLocalizerOptions>> reconfigurable_;
  std::shared_ptr<void> on_jump_back_;
  base::TaskQueue looker_;  // ends first
};

}  // namespace grid_path_planner::nodes
