// Why a vehicle must stand that its path knows nothing of, besides what command_gate.h holds it for: its map, limits and
// pose, asked in one order, told in one sentence.
//
//   reasons.tick(ros::Time::now());
//   if (const auto why = reasons.problem(options)) hold(*why);
//
// Belongs to one thread.
#pragma once

#include <ros/time.h>

#include <optional>
#include <string>

#include "ros/driving/map_liveness.h"
#include "ros/driving/navigate_path_options.h"
#include "ros/driving/speed_limit_receiver.h"
#include "ros/gate/localization_gate.h"

namespace grid_path_planner::nodes {

class HoldReasons {
 public:
  MapLiveness map;
  SpeedLimits limits;
  LocalizationGate localization;

  // Keeps for how long was driven by a map in which nothing has changed.
  void setMap(const MapLiveness& life);
  void tick(const ros::Time& now) { now_ = now; }
  const ros::Time& now() const { return now_; }

  // The first reason.
  std::optional<std::string> problem(const NavigatePathOptions& options) const;

 private:
  ros::Time now_;
};

}  // namespace grid_path_planner::nodes
