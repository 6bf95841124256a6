// What navigate_path says in /diagnostics.
#include "ros/driving/navigate_path_node.h"
#include "ros/guard/master/master_diagnostics.h"

namespace grid_path_planner::nodes {

using diagnostic_msgs::DiagnosticStatus;
using following::FollowState;

void NavigatePathNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const DriveStanding standing = loop_->standing();
  const bool warn = standing.state == FollowState::BLOCKED || standing.state == FollowState::FAILED;
  status.summary(standing.holding_ended ? DiagnosticStatus::ERROR
                 : warn                 ? DiagnosticStatus::WARN
                                        : DiagnosticStatus::OK,
                 std::string(toString(standing.state)) + ": " + standing.message);
  status.add("waypoint", standing.waypoint + 1);
  status.add("waypoints", standing.waypoints);
  status.add("distance remaining (m)", standing.distance_remaining);
  status.add("time remaining (s)", standing.time_remaining);
  status.add("missed waypoints", standing.missed.size());
  status.add("scheduling of commands", loop_->gate().scheduling());
}

void NavigatePathNode::diagnoseMap(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const MapLiveness life = map_->life();
  const std::string why = whyNoMap(life, {options_.map_timeout, options_.map_data_timeout});
  const std::string misfit =
      options_.check_map ? map_->misfit(options_.limits.thresholds) : std::string();
  if (!options_.check_map)
    status.summary(DiagnosticStatus::OK, "not watched: check_map is false");
  else if (!why.empty())
    status.summary(DiagnosticStatus::WARN, why);
  else if (!misfit.empty())
    status.summary(DiagnosticStatus::WARN, misfit);
  else
    status.summary(DiagnosticStatus::OK, "the map on " + life.topic + " is kept up");
  status.add("speed limits", limits_->state());
  status.add("topic", life.topic);
  if (!life.map.grid) return;
  status.add("publisher", life.map.publisher);
  status.add("heartbeat", life.map.data.beats());
  if (!life.map.data.newest().isZero()) status.add("age (s)", life.map.data.age(Instant::now()));
  status.add("last sign of life (s ago)", life.silence());
}

void NavigatePathNode::diagnoseVehicle(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const bool kept_off = options_.limits.radius > 0.0 || !options_.check_footprint.empty();
  if (options_.vehicle && options_.check_map)
    status.summary(DiagnosticStatus::OK, "every motion is checked with its outline");
  else if (options_.vehicle)
    status.summary(DiagnosticStatus::WARN, "no motion is checked: check_map is false");
  else
    status.summary(kept_off ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   "not described: it is driven as a point that goes sideways, and no motion is "
                   "checked (parameter vehicle, doc/vehicle.md)");
  if (options_.vehicle) status.add("drive", base::choiceName(options_.vehicle->drive));
}

void NavigatePathNode::diagnoseOthers(diagnostic_updater::DiagnosticStatusWrapper& status) {
  others_.report(status);
  diagnoseMaster(loop_->gate().masterSilence(), options_.master_timeout, status);
}

}  // namespace grid_path_planner::nodes
