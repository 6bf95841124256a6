// Clouds of several sensors, as frames for the pilot.
//
//   CloudFrames clouds(nh, options, transforms);
//   for (const Frame& frame : clouds.take(options.pilot)) use(frame);      // with each plan
//   if (const auto why = clouds.problem()) stand(*why);
//
// Which clouds are used the rules of `points` say (input_rules.cpp), for each topic by itself. A cloud by which nothing is
// known is refused (avoidance::isBlind): a covered lens is not made good by another sensor that sees.
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/frame.h"
#include "grid_path_planner/avoidance/pilot_options.h"
#include "ros/avoidance/local_planner_options.h"
#include "ros/input/input.h"

namespace grid_path_planner::nodes {

// A cloud of a sensor that is at `map_from_sensor`; `camera` counts where it is of the same frame and size. Throws InputError for
// one that has no point within range_min and range_max where those are what is known, or too many.
avoidance::Frame frameOf(const sensor_msgs::PointCloud2& cloud,
                         const Eigen::Isometry3d& map_from_sensor,
                         const std::optional<sensor_msgs::CameraInfo>& camera,
                         const avoidance::PilotOptions& options);

// Of one thread, that of the queue.
class CloudFrames {
 public:
  // Subscribes to the topics of the options, and to camera_info beside each. `transforms` outlives this.
  CloudFrames(const ros::NodeHandle& nh, const LocalPlannerOptions& options,
              const FrameLookup& transforms);
  CloudFrames(const CloudFrames&) = delete;
  CloudFrames& operator=(const CloudFrames&) = delete;

  void setOptions(const LocalPlannerOptions& options);

  // Those that came since the last call and can be used, the newest of each sensor; the oldest first.
  std::vector<avoidance::Frame> take(const avoidance::PilotOptions& options);

  // Of the first topic on which none of use came for cloud_timeout, as Input has it.
  std::optional<std::string> problem() const;
  // Since the stamp of the newest cloud that was used, of the topic where that is longest (s); infinite where
  // none was.
  double age(const ros::Time& now) const;
  void addTo(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  using Clouds = Input<sensor_msgs::PointCloud2>;
  struct Sensor {
    std::optional<sensor_msgs::CameraInfo> camera;
    std::unique_ptr<Clouds> clouds;
    ros::Subscriber camera_subscriber;
  };

  std::vector<Sensor> sensors_;  // as many as there are topics, from the start
};

}  // namespace grid_path_planner::nodes
