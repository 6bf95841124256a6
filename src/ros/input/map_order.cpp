#include "ros/input/map_order.h"

#include <algorithm>

#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {
namespace {

// As far as it is of this time: what is stamped hours ahead would be newer than
// all to come.
ros::Time believed(const ros::Time& stamp) {
  return secondsBetween(ros::Time::now(), stamp) > kMostAhead ? ros::Time() : stamp;
}

}  // namespace

void MapOrder::timeWentBack() {
  recent_ = {};
  announced_.reset();
  whole_stamp_ = newest_ = lost_at_ = {};
}

std::uint32_t MapOrder::note(const std::string& publisher, std::uint32_t number) {
  const auto [missed, began_again] = sequence_.note(publisher, number);
  if (publisher != publisher_) return missed;
  // The map of a publisher that was restarted may lie elsewhere than the one of
  // before, and comes over a connection of its own: as if announced, but later
  // than that one, since its stamp is not known.
  if (began_again && !whole_came_last_) {
    ros::Time later = whole_stamp_;
    ++later.nsec;
    announced_ = {publisher, normalized(later), Clock::now()};
  }
  whole_came_last_ = false;
  return missed;
}

// Unless the map came before it. What another node than the map's announces
// says nothing of the map.
void MapOrder::noteAnnouncement(const std::string& publisher, const ros::Time& stamp) {
  if (!publisher_.empty() && publisher_ != publisher) return;
  const bool came = publisher == publisher_ && stamp <= whole_stamp_;
  if (!came && !stamp.isZero()) announced_ = {publisher, stamp, Clock::now()};
}

void MapOrder::noteLoss(const ros::Time& stamp) {
  lost_at_ = std::min(std::max(newest_, stamp),
                      ros::Time::now());  // /clock may be late
}

bool MapOrder::isAwaited(const std::string& publisher) const {
  return announced_ && announced_->publisher == publisher;
}

std::optional<MapOrder::Clock::time_point> MapOrder::awaitedSince() const {
  return announced_ ? std::optional(announced_->came) : std::nullopt;
}

bool MapOrder::isOld(const map_msgs::OccupancyGridUpdate& update) const {
  return !update.header.stamp.isZero() && update.header.stamp < newest_;
}

void MapOrder::keep(const std::string& publisher, const RecentUpdates::Update& update) {
  recent_.keep(publisher, update, ros::Time::now());
}

void MapOrder::tookUpdate(const map_msgs::OccupancyGridUpdate& update) {
  if (!update.header.stamp.isZero()) newest_ = believed(update.header.stamp);
}

MapOrder::Whole MapOrder::judge(const std::string& publisher, const ros::Time& stamp,
                                Clock::time_point asked_at) const {
  Whole whole{publisher, stamp};
  const bool same = publisher == publisher_ && !stamp.isZero();
  const bool awaited = isAwaited(publisher);
  whole.lacks = (awaited || (same && stamp < newest_)) && !recent_.complete(stamp);
  whole.has_lost = same && stamp <= lost_at_;
  // Of the updates that were sent after a map that was announced, the places
  // are others in one from before.
  whole.is_before = awaited && stamp < announced_->stamp && asked_at < announced_->came;
  whole.newer =
      recent_.since(publisher, stamp, whole.is_before ? announced_->stamp : ros::TIME_MAX);
  return whole;
}

void MapOrder::tookWhole(const Whole& whole) {
  recent_.forgetBefore(whole.publisher, whole.stamp, ros::Time::now());
  // What another node announced says nothing of this one's maps.
  if (announced_ && (announced_->publisher != whole.publisher || !whole.is_before))
    announced_.reset();
  publisher_ = whole.publisher;
  whole_stamp_ = whole.stamp;
  whole_came_last_ = true;
  newest_ = believed(whole.newer.empty() ? whole.stamp : whole.newer.back()->header.stamp);
}

}  // namespace grid_path_planner::nodes
