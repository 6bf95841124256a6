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

constexpr double kMasterSilence =
    2.0;  // s, after which it counts as gone: roscpp waits for it without end
constexpr std::chrono::seconds kAnswer(2);  // to wait for a whole map that was asked for
constexpr std::chrono::seconds kLongestAnswer(
    64);  // where none comes, or none that has what was lost
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
  master_ = MasterWatch::shared();
  name_ = topic;
  on_change_ = std::move(on_change);
  on_heartbeat_ = std::move(on_heartbeat);
  nh_ = nh;
  subscribeToMaps();
  updates_ = subscribeBounded<map_msgs::OccupancyGridUpdate, const UpdateEvent&>(
      nh, name_ + "_updates", {kAnyNumber, kMostWaitingBytes},
      [this](const UpdateEvent& event) { onUpdate(event); });
  retry_timer_ = guardedTimer(nh, kRetryPeriod, [this] { retry(); });
  std::lock_guard<std::mutex> lock(mutex_);
  topic_ = map_subscriber_.getTopic();
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
  map_subscriber_.shutdown();
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

void MapReceiver::subscribeToMaps() {
  map_subscriber_ = subscribeChecked<nav_msgs::OccupancyGrid, const MapEvent&>(
      nh_, name_, 1, [this](const MapEvent& event) { onMap(event); });
}

void MapReceiver::onMap(const MapEvent& event) {
  if (isNotYet(event)) return;
  const ros::Time newest = latest().stamp;
  const bool lacks = (isOlder(event) || isAwaited(event.getPublisherName())) &&
                     !recent_.complete(event.getConstMessage()->header.stamp);
  // A latched map of before, where a new one was asked for and follows.
  if (lacks && Clock::now() - asked_at_ < kAnswer) return;
  MapChange change;
  try {
    change = use(event);
  } catch (const InputError& error) {
    refuse(map_subscriber_.getTopic(), error.what());
    return;
  } catch (...) {
    lost_one_ = owes_map_ = true;  // the grid may have it, and nobody was told
    throw;
  }
  tellTraits(event);
  if (lacks) noteLoss("A map came that is older than its updates", newest);
  tell(std::move(change));
}

// Whether its publisher sent an update stamped later, unless ROS time jumped back.
bool MapReceiver::isOlder(const MapEvent& event) const {
  const ros::Time stamp = event.getConstMessage()->header.stamp;
  const ReceivedMap before = latest();
  return before.grid && before.publisher == event.getPublisherName() && !stamp.isZero() &&
         stamp < before.stamp && before.stamp <= ros::Time::now();
}

MapChange MapReceiver::use(const MapEvent& event) {
  const nav_msgs::OccupancyGrid& message = *event.getConstMessage();
  const std::string frame_id = frameName(message.header.frame_id);
  const std::string sender = event.getPublisherName();
  const ros::Time &sent = message.header.stamp, now = ros::Time::now();
  const bool has_lost =
      sender == latest().publisher && !sent.isZero() && sent <= lost_at_ && lost_at_ <= now;
  // Of those that were sent after a map that was announced, the places are others in one from before.
  const bool is_before =
      isAwaited(sender) && sent < announced_->stamp && asked_at_ < announced_->came;
  const auto newer =
      recent_.since(sender, sent, now, is_before ? announced_->stamp : ros::TIME_MAX);
  auto changed =
      newer.empty() ? takeGrid(message, frame_id) : takeGrid(withUpdates(message, newer), frame_id);
  const ros::Time stamp = newer.empty() ? sent : newer.back()->header.stamp;
  MapChange change = store({nullptr, frame_id, stamp, sender, sender}, std::move(changed));
  recent_.forgetBefore(sender, sent, now);
  whole_of_ = sender;
  whole_stamp_ = sent;
  whole_heard_ = now;
  whole_came_last_ = true;
  // What another node announced says nothing of this one's maps.
  if (announced_ && (announced_->publisher != sender || (isAwaited(sender) && !is_before)))
    announced_.reset();
  if (has_lost) return change;
  until_asked_again_ = kAnswer;
  std::lock_guard<std::mutex> lock(mutex_);
  lost_.clear();
  return change;
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

void MapReceiver::noteLoss(const std::string& what, const ros::Time& at) {
  lost_at_ = std::min(at, ros::Time::now());  // /clock may be late
  const std::string sentence = what + ": a whole map is asked for";
  static LogThrottle seldom(5.0);
  ROS_WARN_STREAM_COND(seldom.isDue(), sentence);
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (lost_.empty()) lost_since_ = Clock::now();
    lost_ = sentence;
  }
  askForAWholeMap();
}

void MapReceiver::retry() {
  if (std::exchange(lost_one_, false))
    noteLoss("A change of the map could not be taken", latest().stamp);
  else if (!lost().empty())
    askForAWholeMap();
  else if (announced_ && isAwaited(announced_->publisher) &&
           Clock::now() - announced_->came > kAnswer)
    noteLoss("A map of another place or size was announced and has not come", latest().stamp);
  if (!map_subscriber_ && master_->silence() < kMasterSilence) subscribeToMaps();
  if (owes_map_ && latest().grid) tell({latest(), std::nullopt});
}

// A listener that failed to take a change takes the whole map with the next, or by retry().
void MapReceiver::tell(MapChange change) {
  if (std::exchange(owes_map_, true)) change.changed.reset();
  on_change_(change);
  owes_map_ = false;
}

void MapReceiver::askForAWholeMap() {
  const auto now = Clock::now();
  if (now - asked_at_ < until_asked_again_ || master_->silence() > kMasterSilence) return;
  asked_at_ = now;
  until_asked_again_ = std::clamp<Clock::duration>(2 * until_asked_again_, kAnswer, kLongestAnswer);
  map_subscriber_.shutdown();  // a second subscription of a node would share the link of the first
  subscribeToMaps();
}

void MapReceiver::onUpdate(const UpdateEvent& event) {
  const map_msgs::OccupancyGridUpdate& message = *event.getConstMessage();
  const std::string publisher = event.getPublisherName();
  const auto [missed, began_again] = sequence_.note(publisher, message.header.seq);
  if (missed > 0 && latest().grid)
    noteLoss(std::to_string(missed) + " updates of the map were lost",
             std::max(latest().stamp, message.header.stamp));
  else if (!lost().empty())
    askForAWholeMap();
  if (publisher == latest().publisher) {
    if (began_again && !whole_came_last_) awaitMapOfRestarted(publisher);
    whole_came_last_ = false;
  }
  if (isAnnouncement(message)) return noteAnnouncement(event);
  if (!hasNoCells(message)) return noteUpdate(event);
  {
    std::lock_guard<std::mutex> lock(mutex_);
    heartbeat_ = {message.header.stamp, Clock::now(), publisher};
    if (publisher == map_.publisher) map_.data.noteHeartbeat(message.header.stamp, Instant::now());
  }
  on_heartbeat_();
}

// Unless the map came before it; but where ROS time went back, that was another one. What another node than the map's
// announces says nothing of the map.
void MapReceiver::noteAnnouncement(const UpdateEvent& event) {
  const ros::Time stamp = event.getConstMessage()->header.stamp, now = ros::Time::now();
  const std::string publisher = event.getPublisherName();
  if (latest().grid && latest().publisher != publisher) return;
  const bool came = publisher == whole_of_ && stamp <= whole_stamp_ && whole_heard_ <= now;
  if (!came && !stamp.isZero()) announced_ = {publisher, stamp, now, Clock::now()};
}

// It may lie elsewhere than the one of before, and comes over a connection of its own: as if announced, but later than that
// one, since its stamp is not known.
void MapReceiver::awaitMapOfRestarted(const std::string& publisher) {
  ros::Time later = whole_stamp_;
  ++later.nsec;
  announced_ = {publisher, later, ros::Time::now(), Clock::now()};
}

// But not where ROS time went back meanwhile.
bool MapReceiver::isAwaited(const std::string& publisher) const {
  return announced_ && announced_->publisher == publisher && announced_->heard <= ros::Time::now();
}

void MapReceiver::noteUpdate(const UpdateEvent& event) {
  const map_msgs::OccupancyGridUpdate& message = *event.getConstMessage();
  const ReceivedMap before = latest();
  if (!before.grid || isAwaited(event.getPublisherName())) {
    recent_.keep(event.getPublisherName(), event.getConstMessage(), ros::Time::now());
    static LogThrottle seldom(5.0);
    ROS_WARN_COND(seldom.isDue(), "An update of the map waits: the map has not come yet");
    return;
  }
  // A map from the future is from before the time jumped back, as when a bag loops.
  const bool newer_map = !message.header.stamp.isZero() && message.header.stamp < before.stamp &&
                         before.stamp <= ros::Time::now();
  if (newer_map) {
    static LogThrottle seldom(5.0);
    ROS_WARN_STREAM_COND(seldom.isDue(), "An update of the map stamped "
                                             << message.header.stamp
                                             << " was dropped: the map is newer, " << before.stamp);
    return;
  }
  MapChange change;
  try {
    change = apply(event);
    recent_.keep(event.getPublisherName(), event.getConstMessage(), ros::Time::now());
  } catch (const InputError& error) {
    refuse(updates_.getTopic(), error.what());
    // Of a map that has grown, and comes after it.
    recent_.keep(event.getPublisherName(), event.getConstMessage(), ros::Time::now());
    return;
  } catch (...) {
    lost_one_ = owes_map_ = true;  // the grid may have it, and nobody was told
    throw;
  }
  tell(std::move(change));
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
