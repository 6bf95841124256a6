#include "ros/input/map_receiver.h"

#include <ros/console.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "base/seconds_since.h"
#include "grid/map_differences.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/guard/scheduling/log_throttle.h"
#include "ros/input/foreign_rules.h"
#include "ros/messages/map_announcement.h"

namespace grid_path_planner::nodes {

using base::InputError;
using grid::CellRect;
using grid::checkOccupancyValues;
using grid::differences;
using grid::OccupancyGrid;

namespace {

constexpr double kRetryPeriod =
    1.0;  // s, after which what failed for want of memory is tried again

CellRect rectOf(const OccupancyGrid& map, const map_msgs::OccupancyGridUpdate& update) {
  const auto end = [](std::int64_t from, std::uint32_t length) { return from + length; };
  if (update.x < 0 || update.y < 0 || end(update.x, update.width) > map.width() ||
      end(update.y, update.height) > map.height()) {
    std::ostringstream text;
    text << "an update of " << update.width << "x" << update.height << " cells at column "
         << update.x << ", row " << update.y << " does not lie in the map of " << map.width() << "x"
         << map.height();
    throw InputError(text.str());
  }
  return {update.x, update.y, static_cast<int>(update.width), static_cast<int>(update.height)};
}

// Copies the cells of `rects` and checks them.
void copyChecked(const std::vector<std::int8_t>& values, const std::vector<CellRect>& rects,
                 OccupancyGrid& map) {
  for (const CellRect& rect : rects) {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      std::copy_n(values.data() + static_cast<std::size_t>(row) * map.width() + rect.column,
                  rect.width, map.row(row) + rect.column);
    checkOccupancyValues(map, rect);
  }
}

}  // namespace

CellRect checkedRect(const OccupancyGrid& map, const map_msgs::OccupancyGridUpdate& update) {
  const CellRect rect = rectOf(map, update);
  const std::size_t expected = static_cast<std::size_t>(rect.width) * rect.height;
  if (update.data.size() != expected)
    throw InputError("an update of " + std::to_string(rect.width) + "x" +
                     std::to_string(rect.height) + " cells needs " + std::to_string(expected) +
                     " values, got " + std::to_string(update.data.size()));
  for (const std::int8_t value : update.data)
    if (value < -1 || value > 100)
      throw InputError("occupancy must be -1 to 100, got " + std::to_string(value) +
                       " in an update");
  return rect;
}

void applyUpdate(const map_msgs::OccupancyGridUpdate& update, const CellRect& rect,
                 OccupancyGrid& map) {
  for (int row = 0; row < rect.height; ++row)
    std::copy_n(update.data.begin() + static_cast<std::ptrdiff_t>(row) * rect.width, rect.width,
                map.row(rect.row + row) + rect.column);
}

void MapReceiver::start(ros::NodeHandle nh, OnChange on_change, std::function<void()> on_heartbeat,
                        const std::string& topic) {
  on_change_ = std::move(on_change);
  on_heartbeat_ = std::move(on_heartbeat);
  on_jump_back_ = NodeTime::of(nh).onJumpBack([this](double) { order_.timeWentBack(); });
  maps_.start(nh, topic, [this](const MapEvent& event) { onMap(event); });
  updates_ = subscribeBounded<map_msgs::OccupancyGridUpdate, const UpdateEvent&>(
      nh, topic + "_updates", {kAnyNumber, kMostWaitingBytes},
      [this](const UpdateEvent& event) { onUpdate(event); });
  retry_timer_ = guardedTimer(nh, kRetryPeriod, [this] { retry(); });
  std::lock_guard<std::mutex> lock(mutex_);
  topic_ = maps_.topic();
}

std::string MapReceiver::topic() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return topic_;
}

ReceivedMap MapReceiver::latest() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return map_;
}

std::string MapReceiver::refusal() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return refusal_;
}

std::optional<MapHeartbeat> MapReceiver::heartbeat() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return heartbeat_;
}

void MapReceiver::shutdown() {
  retry_timer_.stop();
  on_jump_back_.reset();
  maps_.shutdown();
  updates_.shutdown();
}

std::string MapReceiver::lost() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return lost_;
}

std::optional<std::chrono::steady_clock::time_point> MapReceiver::lostSince() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return lost_.empty() ? std::nullopt : std::optional(lost_since_);
}

std::string MapReceiver::whyIncomplete() const {
  const auto since = lostSince();
  if (!since || base::secondsSince(*since) <= kLostTimeout) return "";
  return topic() + " lacks changes: " + lost();
}

void MapReceiver::onMap(const MapEvent& event) {
  if (isNotYet(event)) return;
  const MapOrder::Whole whole = order_.judge(
      event.getPublisherName(), event.getConstMessage()->header.stamp, maps_.askedAt());
  // A latched map of before, where a new one was asked for and follows.
  if (whole.lacks && maps_.isAsked()) return;
  const bool was_torn = std::exchange(torn_, true);
  MapChange change;
  try {
    change = use(event, whole);
  } catch (const InputError& error) {
    torn_ = was_torn;
    return refuse(maps_.topic(), error.what());
  }
  tellTraits(event);
  if (whole.lacks) order_.noteLoss();
  order_.tookWhole(whole);
  if (!whole.has_lost) noteComplete();
  if (whole.lacks) noteLoss("A map came that is older than its updates");
  tell(std::move(change), was_torn);
}

void MapReceiver::tell(MapChange change, bool whole) {
  if (whole) change.changed.reset();
  on_change_(change);
  torn_ = false;
}

MapChange MapReceiver::use(const MapEvent& event, const MapOrder::Whole& whole) {
  const nav_msgs::OccupancyGrid& message = *event.getConstMessage();
  const std::string frame_id = frameName(message.header.frame_id);
  const auto& newer = whole.newer;
  auto changed =
      newer.empty() ? takeGrid(message, frame_id) : takeGrid(withUpdates(message, newer), frame_id);
  const ros::Time& stamp = newer.empty() ? whole.stamp : newer.back()->header.stamp;
  return store({nullptr, frame_id, stamp, whole.publisher, whole.publisher}, std::move(changed));
}

std::optional<std::vector<CellRect>> MapReceiver::takeGrid(const nav_msgs::OccupancyGrid& message,
                                                           const std::string& frame_id) {
  const ReceivedMap before = latest();
  if (!before.grid || before.frame_id != frame_id ||
      before.grid->geometry() != geometryFromMessage(message.info) ||
      before.grid->values().size() != message.data.size()) {
    grids_.reset(std::make_unique<OccupancyGrid>(occupancyFromMessage(message)));
    return std::nullopt;
  }
  std::vector<CellRect> changed = differences(*before.grid, message.data);
  if (!changed.empty())
    grids_.advance(changed, [&](OccupancyGrid& next) { copyChecked(message.data, changed, next); });
  return changed;
}

void MapReceiver::noteLoss(const std::string& what) {
  const std::string sentence = what + ": a whole map is asked for";
  static LogThrottle seldom(5.0);
  ROS_WARN_STREAM_COND(seldom.isDue(), sentence);
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (lost_.empty()) lost_since_ = Clock::now();
    lost_ = sentence;
  }
  maps_.ask();
}

void MapReceiver::noteComplete() {
  maps_.isAnswered();
  std::lock_guard<std::mutex> lock(mutex_);
  lost_.clear();
}

void MapReceiver::retry() {
  const auto since = order_.awaitedSince();
  if (torn_) {
    order_.noteLoss();
    noteLoss("A change of the map could not be taken");
  } else if (!lost().empty()) {
    maps_.ask();
  } else if (since && Clock::now() - *since > WholeMapSubscription::kAnswer) {
    order_.noteLoss();
    noteLoss("A map of another place or size was announced and has not come");
  }
  maps_.retry();
}

void MapReceiver::onUpdate(const UpdateEvent& event) {
  const map_msgs::OccupancyGridUpdate& message = *event.getConstMessage();
  const std::string publisher = event.getPublisherName();
  const std::uint32_t missed = order_.note(publisher, message.header.seq);
  if (missed > 0 && latest().grid) {
    order_.noteLoss(message.header.stamp);
    noteLoss(std::to_string(missed) + " updates of the map were lost");
  } else if (!lost().empty()) {
    maps_.ask();
  }
  if (isAnnouncement(message)) return order_.noteAnnouncement(publisher, message.header.stamp);
  if (hasNoCells(message)) return onHeartbeat(event);
  noteUpdate(event);
}

void MapReceiver::onHeartbeat(const UpdateEvent& event) {
  const ros::Time& stamp = event.getConstMessage()->header.stamp;
  const std::string publisher = event.getPublisherName();
  {
    std::lock_guard<std::mutex> lock(mutex_);
    heartbeat_ = {stamp, Clock::now(), publisher};
    if (publisher == map_.publisher) map_.data.noteHeartbeat(stamp, Instant::now());
  }
  on_heartbeat_();
}

void MapReceiver::noteUpdate(const UpdateEvent& event) {
  const auto& message = event.getConstMessage();
  const std::string publisher = event.getPublisherName();
  static LogThrottle seldom(5.0);
  if (!latest().grid || order_.isAwaited(publisher)) {
    order_.keep(publisher, message);
    ROS_WARN_COND(seldom.isDue(), "An update of the map waits: the map has not come yet");
    return;
  }
  if (order_.isOld(*message)) {
    ROS_WARN_STREAM_COND(seldom.isDue(), "An update of the map stamped "
                                             << message->header.stamp
                                             << " was dropped: the map is newer, "
                                             << latest().stamp);
    return;
  }
  const bool was_torn = std::exchange(torn_, true);
  MapChange change;
  try {
    change = apply(event);
  } catch (const InputError& error) {
    torn_ = was_torn;
    refuse(updates_.getTopic(), error.what());
    order_.keep(publisher,
                message);  // of a map that has grown, and comes after it
    return;
  }
  order_.tookUpdate(*message);
  order_.keep(publisher, message);
  tell(std::move(change), was_torn);
}

MapChange MapReceiver::apply(const UpdateEvent& event) {
  const map_msgs::OccupancyGridUpdate& message = *event.getConstMessage();
  const ReceivedMap before = latest();
  const std::string frame_id = frameName(message.header.frame_id);
  if (!frame_id.empty() && frame_id != before.frame_id)
    throw InputError("an update in frame " + frame_id + " for a map in frame " + before.frame_id);
  const CellRect changed = checkedRect(*before.grid, message);
  const ros::Time& stamp = message.header.stamp.isZero() ? before.stamp : message.header.stamp;
  grids_.advance({changed}, [&](OccupancyGrid& next) { applyUpdate(message, changed, next); });
  return store({nullptr, before.frame_id, stamp, before.publisher, event.getPublisherName()},
               std::vector<CellRect>{changed});
}

MapChange MapReceiver::store(ReceivedMap map, std::optional<std::vector<CellRect>> changed) {
  const Instant now = Instant::now();
  map.grid = grids_.current();
  map.received = now.wall;
  std::lock_guard<std::mutex> lock(mutex_);
  if (map.publisher == map_.publisher)
    map.data = map_.data;
  else if (heartbeat_ && heartbeat_->publisher == map.publisher)
    map.data.noteHeartbeat(heartbeat_->stamp, now);
  if (map.sender == map.publisher) map.data.noteMap(map.stamp, now);
  map_ = std::move(map);
  refusal_.clear();
  return {map_, std::move(changed)};
}

void MapReceiver::refuse(const std::string& topic, const std::string& reason) {
  ROS_ERROR_STREAM("A message on " << topic << " was refused, the map stays as it was: " << reason);
  std::lock_guard<std::mutex> lock(mutex_);
  refusal_ = reason;
}

}  // namespace grid_path_planner::nodes
