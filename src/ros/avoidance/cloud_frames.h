// Clouds that wait for the pose of their sensor, as frames for the pilot. Several sensors may send them.
//
//   CloudFrames frames({"front/points", "rear/points"});
//   frames.add(0, cloud);                                    // in the callback
//   for (const Frame& frame : frames.take(transforms, "map", now, options)) use(frame);
//   if (!frames.silence(now, 0.4).empty()) stand();
//
// Of each topic only the newest cloud waits, and while tf lags behind it the newest after that. One that
// waits in vain for longer than a second is dropped. problems() says why clouds could not be used.
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/frame.h"
#include "grid_path_planner/avoidance/pilot_options.h"
#include "ros/input/frame_lookup.h"

namespace grid_path_planner::nodes {

class CloudFrames {
 public:
  // The names are for sentences only.
  explicit CloudFrames(const std::vector<std::string>& topics);

  void add(std::size_t topic, const sensor_msgs::PointCloud2::ConstPtr& cloud);
  void setCamera(std::size_t topic, const sensor_msgs::CameraInfo& camera);
  void clear();

  // The clouds that waited and of which tf knows where their sensor was, the oldest first. One by which nothing is known is
  // none (avoidance::isBlind): a covered lens is not made good by another sensor that sees.
  std::vector<avoidance::Frame> take(const FrameLookup& transforms, const std::string& map_frame,
                                     const ros::Time& now, const avoidance::PilotOptions& options);

  // Of a topic of which no cloud could be used for longer than `timeout` (s), in a sentence; empty: none.
  std::string silence(const ros::Time& now, double timeout) const;
  // Since the stamp of the newest cloud that was used, of the topic where that is longest (s); infinite where
  // none was.
  double age(const ros::Time& now) const;
  // Why the newest clouds could not be used; empty: they could.
  std::string problems() const;

 private:
  struct Sensor {
    std::string topic;
    sensor_msgs::PointCloud2::ConstPtr waiting = {};
    sensor_msgs::PointCloud2::ConstPtr next = {};  // the newest that came meanwhile
    std::optional<sensor_msgs::CameraInfo> camera = {};
    std::optional<ros::Time> newest = {};  // stamp of the newest that was used, at most now
    std::string problem = {};
  };

  static std::optional<avoidance::Frame> next(Sensor& sensor, const FrameLookup& transforms,
                                              const std::string& map_frame, const ros::Time& now,
                                              const avoidance::PilotOptions& options);
  static avoidance::Frame read(const Sensor& sensor, const sensor_msgs::PointCloud2& cloud,
                               const FrameLookup& transforms, const std::string& map_frame,
                               const ros::Time& now);

  std::vector<Sensor> sensors_;
};

}  // namespace grid_path_planner::nodes
