#include "ros/layers/layer_inputs.h"

#include <ros/console.h>
#include <std_msgs/Empty.h>

#include <algorithm>
#include <utility>

#include "grid/level_grid.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/incoming/bounded_subscription.h"
#include "ros/guard/scheduling/log_throttle.h"
#include "ros/input/foreign_rules.h"
#include "ros/layers/scan_messages.h"

namespace grid_path_planner::nodes {

using base::InputError;
using diagnostic_msgs::DiagnosticStatus;
using grid::OccupancyGrid;
using layers::Layer;
using layers::LayeredMap;
using layers::MapLayersOptions;
using layers::StaleSource;

namespace {

constexpr double kExpiryPeriod = 0.5;  // s of ROS time

void checkFrame(const std::string& named, const MapLayersOptions& options) {
  const std::string frame_id = frameInMap(named, options.map_frame);
  if (frame_id != options.map_frame)
    throw InputError("it is in frame '" + frame_id + "', map_frame is '" + options.map_frame + "'");
}

InputRules scanRules(const MapLayersOptions& options) {
  InputRules rules = rulesOf("map_layers", "scan");
  rules.frames = {options.map_frame};
  rules.tf_wait = options.tf_timeout;
  rules.silent_after = options.source_timeout;
  return rules;
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

LayerInputs::LayerInputs(ros::NodeHandle& nh, const MapLayersOptions& options, LayeredMap& map)
    : options_(options),
      map_(map),
      transforms_(nh),
      static_source_(nh.resolveName("static_map"), true, false),
      live_source_(nh.resolveName("live_map"), options.use_live_map, true),
      keep_out_source_(nh.resolveName("keep_out_mask"), options.use_keep_out_mask, false),
      speed_source_(nh.resolveName("speed_mask"), options.use_speed_mask, false) {
  on_jump_back_ = NodeTime::of(nh).onJumpBack([this](double seconds) { timeWentBack(seconds); });
}

void LayerInputs::listen(ros::NodeHandle& nh) {
  static_maps_.start(
      nh, [this](const MapChange& change) { onStaticMap(change); }, [] {}, "static_map");
  if (options_.use_live_map)
    live_maps_.start(
        nh, [this](const MapChange& change) { onLiveMap(change); }, [this] { onLiveHeartbeat(); },
        "live_map");
  if (options_.use_scan) {
    scans_ = std::make_unique<Scans>(nh, "scan", scanRules(options_), transforms_,
                                     [this](const Scans::Arrival& scan) { onScan(scan); });
    subscribers_.push_back(subscribeChecked<std_msgs::Empty>(
        nh, "clear_scan", 1, [this](const std_msgs::Empty&) { onClearScan(); }));
  }
  if (options_.use_keep_out_mask)
    listenToMask(nh, keep_out_source_, "keep_out_mask",
                 [this](LayeredMap::Map mask) { map_.setKeepOutMask(std::move(mask)); });
  if (options_.use_speed_mask)
    listenToMask(nh, speed_source_, "speed_mask",
                 [this](LayeredMap::Map mask) { map_.setSpeedMask(std::move(mask)); });
}

void LayerInputs::listenToMask(ros::NodeHandle& nh, LayerSource& source, const std::string& topic,
                               std::function<void(LayeredMap::Map)> use) {
  subscribers_.push_back(subscribeChecked<nav_msgs::OccupancyGrid, const MapEvent&>(
      nh, topic, 1, [this, &source, use](const MapEvent& event) {
        if (isNotYet(event)) return;
        const nav_msgs::OccupancyGrid& message = *event.getConstMessage();
        take(source, message.header.stamp, [&] {
          checkFrame(message.header.frame_id, options_);
          use(std::make_shared<OccupancyGrid>(occupancyFromMessage(message)));
          tellTraits(event);
        });
      }));
}

void LayerInputs::update() {
  if (scans_) scans_->setRules(scanRules(options_));
  warnOfZonesOutside();
}

void LayerInputs::take(LayerSource& source, const ros::Time& stamp,
                       const std::function<void()>& work) {
  source.refuse("it could not be laid");  // whatever ends it, until it is
  try {
    work();
    source.accept(stamp);
  } catch (const InputError& error) {
    source.refuse(error.what());
  }
}

void LayerInputs::onStaticMap(const MapChange& change) {
  take(static_source_, change.map.stamp, [&] {
    checkFrame(change.map.frame_id, options_);
    if (map_.setBase(change.map.grid, change.changed) && !scan_dropped_)
      beginScansAnew("came before the static map");
  });
  if (change.changed) return;
  warnOfZonesOutside();
  tellOfYaw(static_source_, *change.map.grid);
}

void LayerInputs::onLiveMap(const MapChange& change) {
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
void LayerInputs::onLiveHeartbeat() {
  const auto heartbeat = live_maps_.heartbeat();
  if (live_source_.there() && heartbeat->publisher == live_maps_.latest().publisher)
    live_source_.beat(heartbeat->stamp);
}

void LayerInputs::onScan(const Scans::Arrival& scan) {
  checkScan(*scan.message);
  checkScanPose(scan.poses[0]);
  map_.insert(scanInMap(*scan.message, scan.poses[0], options_.scan.inf_clears));
}

void LayerInputs::beginScansAnew(const std::string& why) {
  if (scans_) scans_->beginAnew(why);
}

// What waits for its transform was seen before, too. Without a scan since then nobody knows what is there: there is
// no map until the next.
void LayerInputs::onClearScan() {
  beginScansAnew("came before clear_scan");
  map_.forgetScans();
  static LogThrottle seldom(1.0);
  ROS_INFO_STREAM_COND(seldom.isDue(), "The obstacles of " << scans_->topic()
                                                           << " are forgotten, as clear_scan asks");
}

void LayerInputs::timeWentBack(double seconds) {
  ROS_WARN_STREAM("ROS time went back by " << seconds << " s: scans and tf are forgotten");
  map_.forgetScans();
  expired_ = {};
}

void LayerInputs::expireScans() {
  const ros::Time now = ros::Time::now();
  if (secondsBetween(expired_, now) < kExpiryPeriod) return;
  map_.expireScans(now.toSec());
  expired_ = now;
}

std::string LayerInputs::unlessDropped(const std::string& why, bool is_silent, Layer layer) {
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

std::string LayerInputs::whyHeld() {
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

ros::Time LayerInputs::newestOfAll() const {
  ros::Time oldest;
  const auto count = [&](const ros::Time& newest) {
    if (!newest.isZero()) oldest = oldest.isZero() ? newest : std::min(oldest, newest);
  };
  if (const MapData base = static_maps_.latest().data; base.beats()) count(base.newest());
  if (live_source_.used() && !live_dropped_) count(live_source_.stamp());
  if (scans_ && !scan_dropped_) count(scans_->newest());
  return oldest;
}

void LayerInputs::warnOfZonesOutside() const {
  for (const std::string& name : map_.zonesOutside())
    ROS_WARN_STREAM("Zone '" << name << "' lies outside of the map");
}

std::string LayerInputs::dropped() const {
  if (live_dropped_) return live_source_.topic();
  return scan_dropped_ ? scans_->topic() : "";
}

void LayerInputs::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  for (const LayerSource* source :
       {&static_source_, &live_source_, &keep_out_source_, &speed_source_})
    addTo(status, *source, options_.source_timeout);
  if (scans_) addTo(status, *scans_);
  for (const MapReceiver* maps : {&static_maps_, &live_maps_})
    if (const std::string refusal = maps->refusal(); !refusal.empty()) {
      status.add("refused on " + maps->topic(), refusal);
      status.mergeSummary(DiagnosticStatus::WARN, "the last message on " + maps->topic() +
                                                      " was refused, the map before it counts");
    }
}

}  // namespace grid_path_planner::nodes
