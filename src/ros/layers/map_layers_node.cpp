#include "ros/layers/map_layers_node.h"

#include <ros/console.h>

#include <utility>

#include "grid_path_planner/MapLayersConfig.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/ending/shutdown_flag.h"
#include "ros/guard/outgoing/diagnostics_timer.h"
#include "ros/guard/parameters.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/guard/scheduling/log_throttle.h"
#include "ros/messages/file_kinds.h"

namespace grid_path_planner::nodes {

using base::InputError;
using diagnostic_msgs::DiagnosticStatus;
using layers::MapLayersOptions;
using layers::Zones;

namespace {

constexpr double kHeartbeatPeriod = 1.0;  // s, wall time
constexpr double kBetweenLines = 5.0;     // s, of one reason with other details

void checkMapLayersOptions(MapLayersOptions& options) {
  base::checkOptionLimits(options);
  options.map_frame = frameName(options.map_frame);
  if (options.map_frame.empty()) throw InputError("map_frame must name a frame, got ''");
}

MapLayersOptions loadMapLayersOptions(const ros::NodeHandle& private_nh, const NodeFiles& files) {
  MapLayersOptions options;
  loadParameters(private_nh, options);
  options.zones_file = files.named("zones_file", options.zones_file);
  checkMapLayersOptions(options);
  warnUnknownParameters(private_nh, optionNames<MapLayersOptions>());
  return options;
}

void checkUnchanged(const MapLayersOptions& a, const MapLayersOptions& b) {
  if (a.map_frame != b.map_frame || a.use_live_map != b.use_live_map || a.use_scan != b.use_scan ||
      a.use_keep_out_mask != b.use_keep_out_mask || a.use_speed_mask != b.use_speed_mask)
    throw InputError(
        "map_frame and the sources that are used cannot be changed while the node runs");
}

// Without what differs from scan to scan.
std::string stemOf(const std::string& sentence) {
  return sentence.substr(0, sentence.find(": "));
}

}  // namespace

MapLayersNode::MapLayersNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                             const NodeFiles& files)
    : nh_(nh),
      files_(files),
      options_(loadMapLayersOptions(private_nh, files)),
      zones_(loadZones(options_)),
      inputs_(nh, options_, map_),
      publisher_(nh),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  map_.configure(options_, zones_);
  reconfigurable_ = std::make_unique<Reconfigurable<MapLayersConfig, MapLayersOptions>>(
      private_nh, options_, [this](const MapLayersOptions& options) { use(options); });
  diagnostics_.add("layers", this, &MapLayersNode::diagnose);
  diagnostics_timer_ = diagnosticsTimer(nh_, diagnostics_);
  inputs_.listen(nh);
  heartbeat_timer_ = guardedTimer(nh_, kHeartbeatPeriod, [this] { publishHeartbeat(); });
  startPublishing();
}

MapLayersNode::~MapLayersNode() = default;

Zones MapLayersNode::loadZones(const MapLayersOptions& options) const {
  if (options.zones_file.empty()) return {};
  const ShutdownFlag end;
  Zones zones =
      files_.read("zones_file", options.zones_file, zoneFiles(), [&](const std::string& file) {
        return layers::readZones(file, {options.reading, end.token()});
      });
  if (frameInMap(zones.frame_id, options.map_frame) != options.map_frame)
    throw InputError("the zones are in frame '" + zones.frame_id + "', map_frame is '" +
                     options.map_frame + "'");
  return zones;
}

void MapLayersNode::startPublishing() {
  publish_timer_ = guardedTimer(nh_, 1.0 / options_.publish_rate, [this] { publish(); });
}

void MapLayersNode::use(MapLayersOptions options) {
  checkMapLayersOptions(options);
  checkUnchanged(options, options_);
  Zones zones = options.zones_file == options_.zones_file ? zones_ : loadZones(options);
  map_.configure(options, zones);
  zones_ = std::move(zones);
  options_ = std::move(options);
  inputs_.update();
  startPublishing();
}

void MapLayersNode::publish() {
  if (!NodeTime::isThere()) return;
  inputs_.expireScans();
  const std::string why = inputs_.whyHeld();
  const std::string before = std::exchange(held_, why);
  if (!why.empty()) {
    static LogThrottle seldom(kBetweenLines);
    if (stemOf(why) != stemOf(before) || (why != before && seldom.isDue()))
      ROS_WARN_STREAM("There is no map, vehicles stand: " << why);
    publisher_.withdraw();
    return;
  }
  if (!before.empty()) ROS_INFO("All sources are there: the map is published");
  publisher_.publish(map_, options_.map_frame, inputs_.newestOfAll(), options_.full_map_period);
  if (!before.empty()) publishHeartbeat();
}

void MapLayersNode::publishHeartbeat() {
  if (held_.empty()) publisher_.publishHeartbeat(options_.map_frame, inputs_.newestOfAll());
}

void MapLayersNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (!held_.empty())
    status.summary(DiagnosticStatus::ERROR, "there is no map: " + held_);
  else if (const std::string dropped = inputs_.dropped(); !dropped.empty())
    status.summary(DiagnosticStatus::WARN, "the map goes on without " + dropped);
  else
    status.summary(DiagnosticStatus::OK, "a map of all sources");
  status.add("zones", zones_.zones.size());
  status.add("zones outside of the map", map_.zonesOutside().size());
  inputs_.diagnose(status);
}

}  // namespace grid_path_planner::nodes
