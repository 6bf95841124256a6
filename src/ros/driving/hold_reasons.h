// Everything for which a vehicle must stand that its path knows nothing of: asked in one order, told in one sentence.
//
//   reasons.tick(ros::Time::now());
//   if (const auto why = reasons.problem(options, stop_topic)) hold(*why);
//
// Belongs to one thread.
#pragma once

#include <ros/time.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "ros/driving/localization_gate.h"
#include "ros/driving/map_liveness.h"
#include "ros/driving/navigate_path_options.h"
#include "ros/driving/speed_limit_receiver.h"
#include "ros/guard/master/master_watch.h"

namespace grid_path_planner::nodes {

class HoldReasons {
 public:
  MapLiveness map;
  SpeedLimits limits;
  LocalizationGate localization;
  bool stopped = false;  // by the topic

  // Keeps for how long was driven by a map in which nothing has changed.
  void setMap(const MapLiveness& life);
  void tick(const ros::Time& now);
  const ros::Time& now() const { return now_; }

  // The first reason. `stop_topic`: resolved.
  std::optional<std::string> problem(const NavigatePathOptions& options,
                                     const std::string& stop_topic) const;

 private:
  const std::shared_ptr<MasterWatch> master_ = MasterWatch::shared();
  ros::Time now_;
  std::chrono::steady_clock::time_point moved_;  // when ROS time did last
};

}  // namespace grid_path_planner::nodes
