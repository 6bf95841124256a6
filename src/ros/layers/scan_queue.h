// Scans that wait for their transforms.
//
//   queue.add(message);
//   while (const auto ready = queue.take("map", timeout)) use(*ready);
//
// Guaranteed: scans are taken in the order of their stamps, each at most once; what cannot be used is refused with
// its reason in log and diagnostics, and holds up no other.
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <chrono>
#include <deque>
#include <optional>
#include <string>

#include "ros/input/frame_lookup.h"
#include "ros/input/input_record.h"

namespace grid_path_planner::nodes {

class ScanQueue {
 public:
  // `transforms` must outlive this.
  explicit ScanQueue(const FrameLookup& transforms) : transforms_(transforms) {}

  void add(const sensor_msgs::LaserScan::ConstPtr& scan);

  struct Ready {
    sensor_msgs::LaserScan::ConstPtr scan;
    geometry_msgs::TransformStamped map_from_scan;
  };
  // The oldest that waits, once tf knows where it was in `frame`. One that has waited for `timeout` seconds of the
  // wall clock is refused.
  std::optional<Ready> take(const std::string& frame, double timeout);

  // Forgets those that wait, and their stamps.
  void clear();
  const InputRecord& record() const { return record_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    sensor_msgs::LaserScan::ConstPtr scan;
    Clock::time_point since;
  };

  void check(const sensor_msgs::LaserScan& scan) const;
  bool isOver(const Waiting& waiting, double timeout) const;

  const FrameLookup& transforms_;
  std::deque<Waiting> waiting_;
  ros::Time newest_;  // stamp of the last that was taken
  InputRecord record_{"A scan"};
};

}  // namespace grid_path_planner::nodes
