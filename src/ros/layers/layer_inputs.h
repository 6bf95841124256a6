// What map_layers hears: each map, mask and scan is laid as it comes. Whether all that is needed is there, and how new it is.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <sensor_msgs/LaserScan.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "layers/layered_map.h"
#include "ros/input/frame_lookup.h"
#include "ros/input/input.h"
#include "ros/input/map_receiver.h"
#include "ros/layers/layer_source.h"

namespace grid_path_planner::nodes {

class LayerInputs {
 public:
  // For the queue of `nh`, which must be one thread's. `options`, as they are at any time, and `map` outlive this.
  LayerInputs(ros::NodeHandle& nh, const layers::MapLayersOptions& options,
              layers::LayeredMap& map);

  // Subscribes.
  void listen(ros::NodeHandle& nh);
  // The options, or the zones in the map, have changed.
  void update();
  // What no scan has hit for its time is forgotten. Looks through them twice a second of ROS time.
  void expireScans();
  // Why there is no map now, in a sentence; empty where there is.
  std::string whyHeld();
  // Up to when the map holds what all sensors saw that are used; 0 without one.
  ros::Time newestOfAll() const;
  // The topic that the map goes on without; empty where there is none.
  std::string dropped() const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  using Scans = Input<sensor_msgs::LaserScan>;

  void listenToMask(ros::NodeHandle& nh, LayerSource& source, const std::string& topic,
                    std::function<void(layers::LayeredMap::Map)> use);
  // Carries out what may refuse a message of `source`.
  void take(LayerSource& source, const ros::Time& stamp, const std::function<void()>& work);
  void onStaticMap(const MapChange& change);
  void onLiveMap(const MapChange& change);
  void onLiveHeartbeat();
  void onScan(const Scans::Arrival& scan);
  void onClearScan();
  void timeWentBack(double seconds);
  void beginScansAnew(const std::string& why);
  // `why` a source cannot be used; empty where it is dropped for it, as stale sources are that are silent.
  std::string unlessDropped(const std::string& why, bool is_silent, layers::Layer layer);
  void warnOfZonesOutside() const;

  const layers::MapLayersOptions& options_;
  layers::LayeredMap& map_;
  FrameTransforms transforms_;
  LayerSource static_source_, live_source_, keep_out_source_, speed_source_;
  bool live_dropped_ = false, scan_dropped_ = false;
  ros::Time expired_;  // when scans were last looked through
  // What calls is destroyed before what it calls.
  std::unique_ptr<Scans> scans_;  // with use_scan
  MapReceiver static_maps_, live_maps_;
  std::vector<ros::Subscriber> subscribers_;
  std::shared_ptr<void> on_jump_back_;
};

}  // namespace grid_path_planner::nodes
