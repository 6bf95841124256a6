#include "ros/messages/map_topic.h"

#include <ros/single_subscriber_publisher.h>

#include <algorithm>
#include <utility>

#include "grid/fewer_rects.h"
#include "ros/guard/clock.h"
#include "ros/guard/outgoing/latched_message.h"
#include "ros/messages/map_announcement.h"

namespace grid_path_planner::nodes {

using grid::CellRect;
using grid::OccupancyGrid;

namespace {

constexpr int kQueue = 100;  // updates that wait for a subscriber
constexpr std::size_t kMostAtOnce = kQueue / 2;
constexpr double kMostStampsAhead = 1e-3;  // s; a million stamps while /clock stands still

}  // namespace

std::vector<CellRect> updateRects(const std::vector<CellRect>& changed) {
  return grid::fewerRects(changed, kMostAtOnce);
}

map_msgs::OccupancyGridUpdate updateOf(const CellRect& cells, const std::string& frame_id,
                                       const ros::Time& stamp) {
  map_msgs::OccupancyGridUpdate message;
  message.header.frame_id = frame_id;
  message.header.stamp = stamp;
  message.x = cells.column;
  message.y = cells.row;
  message.width = static_cast<std::uint32_t>(cells.width);
  message.height = static_cast<std::uint32_t>(cells.height);
  message.data.reserve(static_cast<std::size_t>(cells.width) * cells.height);
  return message;
}

map_msgs::OccupancyGridUpdate updateOf(const OccupancyGrid& map, const CellRect& cells,
                                       const std::string& frame_id, const ros::Time& stamp) {
  map_msgs::OccupancyGridUpdate message = updateOf(cells, frame_id, stamp);
  for (int row = cells.row; row < cells.row + cells.height; ++row) {
    const std::int8_t* first = map.row(row) + cells.column;
    message.data.insert(message.data.end(), first, first + cells.width);
  }
  return message;
}

MapTopic::MapTopic(ros::NodeHandle nh, const std::string& topic, bool latch,
                   std::function<void()> on_subscriber)
    : on_subscriber_(std::move(on_subscriber)) {
  maps_ = nh.advertise<nav_msgs::OccupancyGrid>(topic, 5, adding(of_maps_), removing(of_maps_), {},
                                                latch);
  updates_ = nh.advertise<map_msgs::OccupancyGridUpdate>(
      topic + "_updates", kQueue, adding(of_updates_), removing(of_updates_));
}

ros::SubscriberStatusCallback MapTopic::adding(Subscribers& to) {
  return [this, &to](const ros::SingleSubscriberPublisher& subscriber) {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      to.insert(subscriber.getSubscriberName());
      new_subscriber_ = true;
    }
    on_subscriber_();
  };
}

ros::SubscriberStatusCallback MapTopic::removing(Subscribers& from) {
  return [this, &from](const ros::SingleSubscriberPublisher& subscriber) {
    std::lock_guard<std::mutex> lock(mutex_);
    const auto gone = from.find(subscriber.getSubscriberName());
    if (gone != from.end()) from.erase(gone);
  };
}

bool MapTopic::hasSubscribers() const {
  return maps_.getNumSubscribers() > 0 || updates_.getNumSubscribers() > 0;
}

bool MapTopic::takeNewSubscriber() {
  std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(new_subscriber_, false);
}

bool MapTopic::needsWholeMaps() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return std::any_of(of_maps_.begin(), of_maps_.end(),
                     [this](const std::string& name) { return of_updates_.count(name) == 0; });
}

bool MapTopic::wholeMapIsDue(double period) const {
  std::lock_guard<std::mutex> lock(mutex_);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - sent_at_;
  return updated_ && passed.count() >= period;
}

ros::Time MapTopic::stampFor(const ros::Time& newest, const ros::Time& now) {
  const ros::Time data = newest.isZero() ? now : std::min(newest, now);
  const bool went_back = secondsBetween(now, stamp_) > kMostStampsAhead;
  ++stamp_.nsec;
  return stamp_ = went_back ? data : std::max(data, normalized(stamp_));
}

nav_msgs::OccupancyGrid MapTopic::placeOf(const nav_msgs::OccupancyGrid& map) {
  nav_msgs::OccupancyGrid place;
  place.header.frame_id = map.header.frame_id;
  place.info = map.info;
  place.info.map_load_time = ros::Time();
  return place;
}

// One that could not be sent for want of memory, or its announcement, is announced again.
void MapTopic::send(const nav_msgs::OccupancyGrid& map) {
  nav_msgs::OccupancyGrid place = placeOf(map);
  const bool elsewhere = place_.info.width > 0 && place != place_;
  if (elsewhere && !map.header.stamp.isZero()) updates_.publish(announcementOf(map));
  publishLatched(maps_, map);
  place_ = std::move(place);
  std::lock_guard<std::mutex> lock(mutex_);
  updated_ = false;
  sent_at_ = std::chrono::steady_clock::now();
}

void MapTopic::send(const map_msgs::OccupancyGridUpdate& update) {
  updates_.publish(update);
  std::lock_guard<std::mutex> lock(mutex_);
  updated_ = true;
}

void MapTopic::forget() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    updated_ = false;
  }
  forgetLatched(maps_);
}

}  // namespace grid_path_planner::nodes
