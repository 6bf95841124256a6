#include "ros/layers/scan_queue.h"

#include <algorithm>

#include "base/seconds_since.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/clock.h"
#include "ros/layers/scan_messages.h"

namespace grid_path_planner::nodes {

using base::InputError;
using sensor_msgs::LaserScan;

namespace {
constexpr char kNotNewer[] = "it is not newer than the one before";
constexpr std::size_t kMostWaiting = 20;
constexpr double kOldest = 10.0;  // s: as long as tf is kept
}  // namespace

void ScanQueue::check(const LaserScan& scan) const {
  checkScan(scan);
  if (frameName(scan.header.frame_id).empty()) throw InputError("it names no frame");
  if (scan.header.stamp.isZero()) throw InputError("it has no stamp");
  if (scan.header.stamp <= newest_) throw InputError(kNotNewer);
  const double age = secondsBetween(scan.header.stamp, ros::Time::now());
  if (age > kOldest) throw InputError("it is " + std::to_string(age) + " s old");
  if (age < -kOldest) throw InputError("it is stamped " + std::to_string(-age) + " s ahead");
}

void ScanQueue::add(const LaserScan::ConstPtr& scan) {
  record_.receive();
  try {
    check(*scan);
  } catch (const InputError& error) {
    record_.refuse(error.what());
    return;
  }
  if (waiting_.size() >= kMostWaiting) {
    record_.refuse("more than 20 wait for their transforms");
    waiting_.pop_front();
  }
  const auto later = std::upper_bound(waiting_.begin(), waiting_.end(), scan->header.stamp,
                                      [](const ros::Time& stamp, const Waiting& other) {
                                        return stamp < other.scan->header.stamp;
                                      });
  waiting_.insert(later, {scan, Clock::now()});
}

bool ScanQueue::isOver(const Waiting& waiting, double timeout) const {
  return base::secondsSince(waiting.since) > timeout;
}

std::optional<ScanQueue::Ready> ScanQueue::take(const std::string& frame, double timeout) {
  while (!waiting_.empty()) {
    const Waiting first = waiting_.front();
    const ros::Time stamp = first.scan->header.stamp;
    if (stamp <= newest_) {
      waiting_.pop_front();
      record_.refuse(kNotNewer);
      continue;
    }
    try {
      if (stamp > ros::Time::now()) throw TransformError("it is stamped ahead of ROS time");
      const auto transform =
          transforms_.transform(frame, frameName(first.scan->header.frame_id), stamp);
      waiting_.pop_front();
      checkScanPose(transform);
      newest_ = stamp;
      return Ready{first.scan, transform};
    } catch (const InputError& error) {
      record_.refuse(error.what());
    } catch (const TransformError& error) {
      if (!isOver(first, timeout)) return std::nullopt;
      waiting_.pop_front();
      record_.refuse(error.what());
    }
  }
  return std::nullopt;
}

void ScanQueue::clear() {
  waiting_.clear();
  newest_ = {};
}

}  // namespace grid_path_planner::nodes
