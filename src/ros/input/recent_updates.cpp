#include "ros/input/recent_updates.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/clock.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {
namespace {

constexpr std::size_t kMostBytes = 16'000'000, kMostUpdates = 1000;

bool isValid(const map_msgs::OccupancyGridUpdate& update) {
  return printable(update.header.frame_id) == update.header.frame_id &&
         update.data.size() == std::size_t{update.width} * update.height &&
         std::all_of(update.data.begin(), update.data.end(),
                     [](std::int8_t value) { return value >= -1 && value <= 100; });
}

bool liesIn(const nav_msgs::OccupancyGrid& map, const map_msgs::OccupancyGridUpdate& update) {
  return update.x >= 0 && update.y >= 0 &&
         std::int64_t{update.x} + update.width <= map.info.width &&
         std::int64_t{update.y} + update.height <= map.info.height;
}

void apply(const map_msgs::OccupancyGridUpdate& update, nav_msgs::OccupancyGrid& map) {
  for (std::size_t row = 0; row < update.height; ++row)
    std::copy_n(update.data.begin() + static_cast<std::ptrdiff_t>(row * update.width), update.width,
                map.data.begin() +
                    static_cast<std::ptrdiff_t>((update.y + row) * map.info.width + update.x));
}

}  // namespace

void RecentUpdates::keep(const std::string& publisher, const Update& update, const ros::Time& now) {
  const ros::Time& stamp = update->header.stamp;
  if (stamp.isZero() || secondsBetween(now, stamp) > kMostAhead || !isValid(*update)) return;
  forgetLaterThan(publisher, stamp);
  kept_.push_back({publisher, update});
  bytes_ += update->data.size();
  while (bytes_ > kMostBytes || kept_.size() > kMostUpdates) forgetTheOldest();
}

// Its clock was set back: those would be laid upon maps that were sent after them.
void RecentUpdates::forgetLaterThan(const std::string& publisher, const ros::Time& stamp) {
  kept_.erase(
      std::remove_if(kept_.begin(), kept_.end(),
                     [&](const Kept& kept) {
                       if (kept.publisher != publisher || kept.update->header.stamp <= stamp)
                         return false;
                       noteForgotten(kept.update);
                       bytes_ -= kept.update->data.size();
                       return true;
                     }),
      kept_.end());
}

void RecentUpdates::forgetTheOldest() {
  const Kept& oldest = kept_.front();
  noteForgotten(oldest.update);
  bytes_ -= oldest.update->data.size();
  kept_.pop_front();
}

void RecentUpdates::noteForgotten(const Update& update) {
  forgotten_ = std::max(forgotten_, update->header.stamp);
}

bool RecentUpdates::isSince(const Kept& kept, const std::string& publisher,
                            const ros::Time& stamp) {
  return !stamp.isZero() && kept.publisher == publisher && kept.update->header.stamp > stamp;
}

std::vector<RecentUpdates::Update> RecentUpdates::since(const std::string& publisher,
                                                        const ros::Time& stamp,
                                                        const ros::Time& until) const {
  std::vector<Update> newer;
  for (const Kept& kept : kept_)
    if (isSince(kept, publisher, stamp) && kept.update->header.stamp <= until)
      newer.push_back(kept.update);
  return newer;
}

void RecentUpdates::forgetBefore(const std::string& publisher, const ros::Time& stamp,
                                 const ros::Time& now) {
  forgotten_ = std::max(forgotten_, std::min(stamp, now));
  kept_.erase(std::remove_if(kept_.begin(), kept_.end(),
                             [&](const Kept& kept) { return !isSince(kept, publisher, stamp); }),
              kept_.end());
  bytes_ = 0;
  for (const Kept& kept : kept_) bytes_ += kept.update->data.size();
}

nav_msgs::OccupancyGrid withUpdates(nav_msgs::OccupancyGrid map,
                                    const std::vector<RecentUpdates::Update>& updates) {
  if (map.data.size() != std::size_t{map.info.width} * map.info.height) return map;  // is refused
  const std::string frame_id = frameName(map.header.frame_id);
  for (const RecentUpdates::Update& update : updates) {
    const std::string of_update = frameName(update->header.frame_id);
    if ((of_update.empty() || of_update == frame_id) && liesIn(map, *update)) apply(*update, map);
  }
  return map;
}

}  // namespace grid_path_planner::nodes
