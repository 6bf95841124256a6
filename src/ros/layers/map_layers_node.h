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
#include <sensor_msgs/LaserScan.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "layers/layered_map.h"
#include "ros/guard/node_files.h"
#include "ros/guard/node_time.h"
#include "ros/input/frame_lookup.h"
#include "ros/input/input.h"
#include "ros/input/map_receiver.h"
#include "ros/layers/layer_source.h"
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
  using Scans = Input<sensor_msgs::LaserScan>;

  layers::Zones loadZones(const layers::MapLayersOptions& options) const;
  void listen();
  void listenToMask(LayerSource& source, const std::string& topic,
                    std::function<void(layers::LayeredMap::Map)> use);
  void startPublishing();
  void use(layers::MapLayersOptions options);
  // Carries out what may refuse a message of `source`.
  void take(LayerSource& source, const ros::Time& stamp, const std::function<void()>& work);
  void onStaticMap(const MapChange& change);
  void onLiveMap(const MapChange& change);
  void onLiveHeartbeat();
  void onScan(const Scans::Arrival& scan);
  void onClearScan();
  void timeWentBack(double seconds);
  void beginScansAnew(const std::string& why);
  void expireScans();
  // What changes the map: where it fails, for want of memory, all is laid again.
  template <class Work>
  void lay(Work work);
  void layAgain();
  void layAndPublish();
  void publish();
  void publishHeartbeat();
  // Why there is no map now, in a sentence; empty where there is.
  std::string whyHeld();
  // `why` a source cannot be used; empty where it is dropped for it, as stale sources are that are silent.
  std::string unlessDropped(const std::string& why, bool is_silent, layers::Layer layer);
  // Up to when the map holds what all sensors saw that are used; 0 without one.
  ros::Time newestOfAll() const;
  void warnOfZonesOutside() const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle nh_;
  NodeFiles files_;
  layers::MapLayersOptions options_;
  layers::Zones zones_;
  FrameTransforms transforms_;
  layers::LayeredMap map_;
  LayerSource static_source_, live_source_, keep_out_source_, speed_source_;
  bool live_dropped_ = false, scan_dropped_ = false;
  bool lays_again_ = false;                         // what was to be laid was not, or in part
  std::string held_ = "the node has just started";  // why there is no map
  std::unique_ptr<Scans> scans_;                    // with use_scan
  ros::Time expired_;                               // when scans were last looked through
  LayeredMapPublisher publisher_;

  MapReceiver static_maps_, live_maps_;
  std::vector<ros::Subscriber> subscribers_;
  diagnostic_updater::Updater diagnostics_;
  ros::SteadyTimer publish_timer_, heartbeat_timer_, diagnostics_timer_;
  std::unique_ptr<Reconfigurable<MapLayersConfig, layers::MapLayersOptions>> reconfigurable_;
  std::shared_ptr<void> on_jump_back_;
};

}  // namespace grid_path_planner::nodes
