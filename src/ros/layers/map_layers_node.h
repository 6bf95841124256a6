// The node `map_layers`: several maps, zones and a laser's obstacles as one map, as planner and driver take it.
//
//   subscribes  static_map, static_map_updates   gives the grid
//               live_map, live_map_updates       with use_live_map: that of projected_map, with its heartbeat
//               scan                             sensor_msgs/LaserScan, with use_scan
//               clear_scan                       std_msgs/Empty, with use_scan: the laser's obstacles are forgotten
//               keep_out_mask, speed_mask        nav_msgs/OccupancyGrid, with use_keep_out_mask, use_speed_mask
//               tf                               where the laser is in map_frame
//   publishes   projected_map, projected_map_updates, speed_limit      layered_map_publisher.h
//               /diagnostics
//
// Guaranteed: while a source that is used has not come, cannot be used, or is silent, there is
// no map and no heartbeat, so that vehicles stand; log and diagnostics say which. So it is while a map lacks updates that
// were lost, for longer than kLostTimeout. A map or update that is none is refused, and the one before counts, with a
// warning in diagnostics. With stale_source drop a laser or live
// map that has said nothing for source_timeout, since the start or clear_scan too, is done without. What cannot be used
// changes nothing. Which scans are used: input_rules.cpp.
// Maps, updates and heartbeats are stamped with what the map holds of all sensors: the oldest of what the live map, the laser and a
// static map that has heartbeats delivered last, so that who drives by it holds when any of them has ceased. ROS time that goes
// back forgets scans and tf, not the maps.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <memory>
#include <string>

#include "layers/layered_map.h"
#include "ros/guard/node_files.h"
#include "ros/layers/layer_inputs.h"
#include "ros/layers/layered_map_publisher.h"

namespace grid_path_planner {
class MapLayersConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class MapLayersNode {
 public:
  // A file of zones that no argument names lies below the folder to load from. Throws InputError for parameters and
  // a file that cannot be used. All callbacks are served by the queue of `nh`, which must be one thread's.
  MapLayersNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const NodeFiles& files = {});
  ~MapLayersNode();

 private:
  layers::Zones loadZones(const layers::MapLayersOptions& options) const;
  void startPublishing();
  void use(layers::MapLayersOptions options);
  void publish();
  void publishHeartbeat();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle nh_;
  NodeFiles files_;
  layers::MapLayersOptions options_;
  layers::Zones zones_;
  layers::LayeredMap map_;
  LayerInputs inputs_;
  std::string held_ = "the node has just started";  // why there is no map
  LayeredMapPublisher publisher_;
  diagnostic_updater::Updater diagnostics_;
  // What calls is destroyed before what it calls.
  ros::SteadyTimer publish_timer_, heartbeat_timer_, diagnostics_timer_;
  std::unique_ptr<Reconfigurable<MapLayersConfig, layers::MapLayersOptions>> reconfigurable_;
};

}  // namespace grid_path_planner::nodes
