#include "ros/layers/map_layers_node.h"

#include <ros/console.h>
#include <std_msgs/Empty.h>

#include <utility>

#include "base/current_error.h"
#include "grid/level_grid.h"
#include "grid_path_planner/MapLayersConfig.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/ending/end_of_node.h"
#include "ros/guard/incoming/bounded_subscription.h"
#include "ros/guard/outgoing/diagnostics_timer.h"
#include "ros/guard/parameters.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/guard/scheduling/log_throttle.h"
#include "ros/input/foreign_rules.h"
#include "ros/layers/scan_messages.h"
#include "ros/messages/file_kinds.h"

namespace grid_path_planner::nodes {

using base::InputError;
using diagnostic_msgs::DiagnosticStatus;
using grid::OccupancyGrid;
using layers::Layer;
using layers::LayeredMap;
using layers::MapLayersOptions;
using layers::StaleSource;
using layers::Zones;

namespace {

constexpr double kHeartbeatPeriod = 1.0;  // s, wall time
constexpr double kExpiryPeriod = 0.5;     // s of ROS time
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

void checkFrame(const std::string& named, const MapLayersOptions& options) {
  const std::string frame_id = frameInMap(named, options.map_frame);
  if (frame_id != options.map_frame)
    throw InputError("it is in frame '" + frame_id + "', map_frame is '" + options.map_frame + "'");
}

void checkUnchanged(const MapLayersOptions& a, const MapLayersOptions& b) {
  if (a.map_frame != b.map_frame || a.use_live_map != b.use_live_map || a.use_scan != b.use_scan ||
      a.use_keep_out_mask != b.use_keep_out_mask || a.use_speed_mask != b.use_speed_mask)
    throw InputError(
        "map_frame and the sources that are used cannot be changed while the node runs");
}

InputRules scanRules(const MapLayersOptions& options) {
  InputRules rules = rulesOf("map_layers", "scan");
  rules.frames = {options.map_frame};
  rules.tf_wait = options.tf_timeout;
  rules.silent_after = options.source_timeout;
  return rules;
}

// Without what differs from scan to scan.
std::string stemOf(const std::string& sentence) {
  return sentence.substr(0, sentence.find(": "));
}

void tellOfYaw(const LayerSource& source, const OccupancyGrid& map) {
  if (!source.there() || !grid::hasYaw(map.geometry())) return;
  static LogThrottle seldom(60.0);
  ROS_INFO_STREAM_COND(seldom.isDue(),
                       source.topic()
                           << " is turned by " << base::decimalText(map.geometry().origin().yaw)
                           << " rad: it is laid on a grid without a yaw, where obstacles grow by "
                              "a cell's diagonal at most");
}

void addTo(diagnostic_updater::DiagnosticStatusWrapper& status, const LayerSource& source,
           double timeout) {
  if (!source.used()) return;
  const std::string why = source.whyNot(timeout);
  status.add(source.topic(), why.empty() ? "taken" : why);
  if (!source.there()) return;
  status.add(source.topic() + " age (s)", secondsBetween(source.stamp(), ros::Time::now()));
  status.add(source.topic() + " silent (s)", source.silence());
}

void addTo(diagnostic_updater::DiagnosticStatusWrapper& status, const InputBase& scans) {
  status.add(scans.topic(), scans.problem().value_or("taken"));
  if (const ros::Time newest = scans.newest(); !newest.isZero())
    status.add(scans.topic() + " age (s)", secondsBetween(newest, ros::Time::now()));
  status.add(scans.topic() + " silent (s)", scans.silence());
  addTo(status, "scans", scans.counts());
}

}  // namespace

// Of a scan that was laid in part nobody knows what is in the map: scans begin anew with the static map that is laid again.
template <class Work>
void MapLayersNode::lay(Work work) {
  try {
    work();
  } catch (const InputError&) {
    throw;
  } catch (...) {
    lays_again_ = true;
    throw;
  }
}

MapLayersNode::MapLayersNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                             const NodeFiles& files)
    : nh_(nh),
      files_(files),
      options_(loadMapLayersOptions(private_nh, files)),
      zones_(loadZones(options_)),
      transforms_(nh),
      static_source_(nh.resolveName("static_map"), true, false),
      live_source_(nh.resolveName("live_map"), options_.use_live_map, true),
      keep_out_source_(nh.resolveName("keep_out_mask"), options_.use_keep_out_mask, false),
      speed_source_(nh.resolveName("speed_mask"), options_.use_speed_mask, false),
      publisher_(nh),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  map_.configure(options_, zones_);
  reconfigurable_ = std::make_unique<Reconfigurable<MapLayersConfig, MapLayersOptions>>(
      private_nh, options_, [this](const MapLayersOptions& options) { use(options); });
  diagnostics_.add("layers", this, &MapLayersNode::diagnose);
  diagnostics_timer_ = diagnosticsTimer(nh_, diagnostics_);
  on_jump_back_ = NodeTime::of(nh).onJumpBack([this](double seconds) { timeWentBack(seconds); });
  listen();
  startPublishing();
}

MapLayersNode::~MapLayersNode() {
  publish_timer_.stop();
  heartbeat_timer_.stop();
  diagnostics_timer_.stop();
  static_maps_.shutdown();
  live_maps_.shutdown();
  if (scans_) scans_->shutdown();
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
}

Zones MapLayersNode::loadZones(const MapLayersOptions& options) const {
  if (options.zones_file.empty()) return {};
  const EndOfNode end;
  Zones zones =
      files_.read("zones_file", options.zones_file, zoneFiles(), [&](const std::string& file) {
        return layers::readZones(file, {options.reading, end.token()});
      });
  if (frameInMap(zones.frame_id, options.map_frame) != options.map_frame)
    throw InputError("the zones are in frame '" + zones.frame_id + "', map_frame is '" +
                     options.map_frame + "'");
  return zones;
}

void MapLayersNode::listen() {
  static_maps_.start(
      nh_, [this](const MapChange& change) { onStaticMap(change); }, [] {}, "static_map");
  if (options_.use_live_map)
    live_maps_.start(
        nh_, [this](const MapChange& change) { onLiveMap(change); }, [this] { onLiveHeartbeat(); },
        "live_map");
  if (options_.use_scan) {
    scans_ = std::make_unique<Scans>(nh_, "scan", scanRules(options_), transforms_,
                                     [this](const Scans::Arrival& scan) { onScan(scan); });
    subscribers_.push_back(subscribeChecked<std_msgs::Empty>(
        nh_, "clear_scan", 1, [this](const std_msgs::Empty&) { onClearScan(); }));
  }
  if (options_.use_keep_out_mask)
    listenToMask(keep_out_source_, "keep_out_mask",
                 [this](LayeredMap::Map mask) { map_.setKeepOutMask(std::move(mask)); });
  if (options_.use_speed_mask)
    listenToMask(speed_source_, "speed_mask",
                 [this](LayeredMap::Map mask) { map_.setSpeedMask(std::move(mask)); });
}

void MapLayersNode::listenToMask(LayerSource& source, const std::string& topic,
                                 std::function<void(LayeredMap::Map)> use) {
  subscribers_.push_back(subscribeChecked<nav_msgs::OccupancyGrid, const MapEvent&>(
      nh_, topic, 1, [this, &source, use](const MapEvent& event) {
        if (isNotYet(event)) return;
        const nav_msgs::OccupancyGrid& message = *event.getConstMessage();
        take(source, message.header.stamp, [&] {
          checkFrame(message.header.frame_id, options_);
          use(std::make_shared<OccupancyGrid>(occupancyFromMessage(message)));
          tellTraits(event);
        });
      }));
}

void MapLayersNode::startPublishing() {
  publish_timer_ = guardedTimer(nh_, 1.0 / options_.publish_rate, [this] { publish(); });
  heartbeat_timer_ = guardedTimer(nh_, kHeartbeatPeriod, [this] { publishHeartbeat(); });
}

void MapLayersNode::use(MapLayersOptions options) {
  checkMapLayersOptions(options);
  checkUnchanged(options, options_);
  Zones zones = options.zones_file == options_.zones_file ? zones_ : loadZones(options);
  lay([&] { map_.configure(options, zones); });
  zones_ = std::move(zones);
  options_ = std::move(options);
  if (scans_) scans_->setRules(scanRules(options_));
  warnOfZonesOutside();
  startPublishing();
}

void MapLayersNode::take(LayerSource& source, const ros::Time& stamp,
                         const std::function<void()>& work) {
  try {
    work();
    source.accept(stamp);
  } catch (const InputError& error) {
    source.refuse(error.what());
  } catch (...) {
    lays_again_ = true;
    source.refuse(base::currentErrorText());
  }
}

void MapLayersNode::onStaticMap(const MapChange& change) {
  take(static_source_, change.map.stamp, [&] {
    checkFrame(change.map.frame_id, options_);
    if (map_.setBase(change.map.grid, change.changed) && !scan_dropped_)
      beginScansAnew("came before the static map");
  });
  if (change.changed) return;
  warnOfZonesOutside();
  tellOfYaw(static_source_, *change.map.grid);
}

void MapLayersNode::onLiveMap(const MapChange& change) {
  take(live_source_, change.map.data.newest(), [&] {
    checkFrame(change.map.frame_id, options_);
    map_.setLive(change.map.grid, change.changed);
  });
  if (change.changed) return;
  tellOfYaw(live_source_, *change.map.grid);
  static LogThrottle seldom(60.0);
  if (map_.liveIsCut())
    ROS_WARN_STREAM_COND(seldom.isDue(), live_source_.topic()
                                             << " reaches beyond " << static_source_.topic()
                                             << ": that part is left out");
}

// Another node's heartbeat says nothing about the map.
void MapLayersNode::onLiveHeartbeat() {
  const auto heartbeat = live_maps_.heartbeat();
  if (live_source_.there() && heartbeat->publisher == live_maps_.latest().publisher)
    live_source_.beat(heartbeat->stamp);
}

void MapLayersNode::onScan(const Scans::Arrival& scan) {
  checkScan(*scan.message);
  checkScanPose(scan.poses[0]);
  lay([&] { map_.insert(scanInMap(*scan.message, scan.poses[0], options_.scan.inf_clears)); });
}

void MapLayersNode::beginScansAnew(const std::string& why) {
  if (scans_) scans_->beginAnew(why);
}

// What waits for its transform was seen before, too. Without a scan since then nobody knows what is there: there is
// no map until the next.
void MapLayersNode::onClearScan() {
  beginScansAnew("came before clear_scan");
  lay([this] { map_.forgetScans(); });
  static LogThrottle seldom(1.0);
  ROS_INFO_STREAM_COND(seldom.isDue(), "The obstacles of " << scans_->topic()
                                                           << " are forgotten, as clear_scan asks");
}

void MapLayersNode::timeWentBack(double seconds) {
  ROS_WARN_STREAM("ROS time went back by " << seconds << " s: scans and tf are forgotten");
  lay([this] { map_.forgetScans(); });
  expired_ = {};
}

void MapLayersNode::expireScans() {
  const ros::Time now = ros::Time::now();
  if (secondsBetween(expired_, now) < kExpiryPeriod) return;
  map_.expireScans(now.toSec());
  expired_ = now;
}

std::string MapLayersNode::unlessDropped(const std::string& why, bool is_silent, Layer layer) {
  const bool is_scan = layer == Layer::SCAN;
  const bool drops = !why.empty() && is_silent && options_.stale_source == StaleSource::DROP;
  if (std::exchange(is_scan ? scan_dropped_ : live_dropped_, drops) != drops) {
    if (drops)
      ROS_WARN_STREAM("The map goes on without what is not there: " << why);
    else
      ROS_INFO_STREAM((is_scan ? scans_->topic() : live_source_.topic()) << " counts again");
    if (drops && is_scan) map_.forgetScans();
    map_.use(layer, !drops);
  }
  return drops ? "" : why;
}

std::string MapLayersNode::whyHeld() {
  const double timeout = options_.source_timeout;
  for (const LayerSource* source : {&static_source_, &keep_out_source_, &speed_source_})
    if (const std::string why = source->whyNot(timeout); !why.empty()) return why;
  std::string of_live =
      unlessDropped(live_source_.whyNot(timeout), live_source_.silentFor(timeout), Layer::LIVE);
  const std::string of_scan = scans_ ? unlessDropped(scans_->problem().value_or(""),
                                                     scans_->silence() > timeout, Layer::SCAN)
                                     : "";
  const std::string of_base = static_maps_.whyIncomplete();
  if (of_live.empty() && !live_dropped_) of_live = live_maps_.whyIncomplete();
  if (!of_base.empty()) return of_base;
  return of_live.empty() ? of_scan : of_live;
}

// All that is there, where memory failed while a part of it was laid.
void MapLayersNode::layAgain() {
  if (!std::exchange(lays_again_, false)) return;
  publisher_.withdraw();
  for (auto [maps, take] : {std::pair(&static_maps_, &MapLayersNode::onStaticMap),
                            std::pair(&live_maps_, &MapLayersNode::onLiveMap)})
    if (const ReceivedMap map = maps->latest(); map.grid) (this->*take)({map, std::nullopt});
}

void MapLayersNode::publish() {
  if (!NodeTime::isThere()) return;
  layAgain();
  lay([this] { layAndPublish(); });
}

void MapLayersNode::layAndPublish() {
  expireScans();
  const std::string why = whyHeld();
  const std::string before = std::exchange(held_, why);
  if (!why.empty()) {
    static LogThrottle seldom(kBetweenLines);
    if (stemOf(why) != stemOf(before) || (why != before && seldom.isDue()))
      ROS_WARN_STREAM("There is no map, vehicles stand: " << why);
    publisher_.withdraw();
    return;
  }
  if (!before.empty()) ROS_INFO("All sources are there: the map is published");
  publisher_.publish(map_, options_.map_frame, newestOfAll(), options_.full_map_period);
  if (!before.empty()) publishHeartbeat();
}

void MapLayersNode::publishHeartbeat() {
  if (held_.empty()) publisher_.publishHeartbeat(options_.map_frame, newestOfAll());
}

ros::Time MapLayersNode::newestOfAll() const {
  ros::Time oldest;
  const auto count = [&](const ros::Time& newest) {
    if (!newest.isZero()) oldest = oldest.isZero() ? newest : std::min(oldest, newest);
  };
  if (const MapData base = static_maps_.latest().data; base.beats()) count(base.newest());
  if (live_source_.used() && !live_dropped_) count(live_source_.stamp());
  if (scans_ && !scan_dropped_) count(scans_->newest());
  return oldest;
}

void MapLayersNode::warnOfZonesOutside() const {
  for (const std::string& name : map_.zonesOutside())
    ROS_WARN_STREAM("Zone '" << name << "' lies outside of the map");
}

void MapLayersNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (!held_.empty())
    status.summary(DiagnosticStatus::ERROR, "there is no map: " + held_);
  else if (live_dropped_ || scan_dropped_)
    status.summary(
        DiagnosticStatus::WARN,
        "the map goes on without " + (live_dropped_ ? live_source_.topic() : scans_->topic()));
  else
    status.summary(DiagnosticStatus::OK, "a map of all sources");
  for (const LayerSource* source :
       {&static_source_, &live_source_, &keep_out_source_, &speed_source_})
    addTo(status, *source, options_.source_timeout);
  if (scans_) addTo(status, *scans_);
  status.add("zones", zones_.zones.size());
  status.add("zones outside of the map", map_.zonesOutside().size());
  for (const MapReceiver* maps : {&static_maps_, &live_maps_})
    if (const std::string refusal = maps->refusal(); !refusal.empty()) {
      status.add("refused on " + maps->topic(), refusal);
      status.mergeSummary(DiagnosticStatus::WARN, "the last message on " + maps->topic() +
                                                      " was refused, the map before it counts");
    }
}

}  // namespace grid_path_planner::nodes
