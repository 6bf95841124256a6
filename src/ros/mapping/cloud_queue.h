// Clouds between their arrival and their turn: each waits for its own transform, none for another.
//
//   CloudQueue queue(transforms);
//   queue.setOptions(options);
//   queue.add(cloud);                       // in the subscriber's thread
//   queue.sortOut();                        // there too, every few milliseconds
//   while (auto ready = queue.take()) use(*ready);  // in the thread that maps
//
// Guaranteed: the order of stamps does not matter; a cloud whose frame tf does not know waits for
// tf_timeout (steady clock) and holds up no other; no more than queue_size wait for tf, and no more
// than queue_size for their turn. What is too much goes: of those that wait for tf the oldest of
// the frame that has the most, of those that wait for their turn the oldest. Each loss is counted
// with its reason and said in the log, at most once in five seconds. Thread-safe.
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "grid_path_planner/mapping/cloud_filter.h"
#include "ros/common/frame_transforms.h"

namespace grid_path_planner::nodes {

struct CloudQueueOptions {
  std::string frame = "map";
  std::string base_frame;   // "": not needed
  double tf_timeout = 1.0;  // s
  int queue_size = 10;
};

struct CloudCounts {
  std::uint64_t received = 0;
  std::uint64_t inserted = 0;
  std::size_t waiting = 0;                       // for tf or for their turn
  std::map<std::string, std::uint64_t> dropped;  // by reason
};

class CloudQueue {
 public:
  struct Ready {
    sensor_msgs::PointCloud2::ConstPtr cloud;
    mapping::CloudFrames frames;
  };

  // `transforms` outlives this.
  explicit CloudQueue(const FrameTransforms& transforms) : transforms_(transforms) {}

  void setOptions(const CloudQueueOptions& options);

  void add(const sensor_msgs::PointCloud2::ConstPtr& cloud);
  // Looks for transforms, and drops what waited too long. Whether any cloud is ready.
  bool sortOut();
  // The ready cloud that came first.
  std::optional<Ready> take();
  // ROS time jumped back.
  void clear();

  // How a cloud that was taken ended; `reason` in a few words, for the counts.
  void countInserted();
  void countDropped(const std::string& reason, const std::string& sentence);
  CloudCounts counts() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    sensor_msgs::PointCloud2::ConstPtr cloud;
    Clock::time_point since;
  };

  std::optional<mapping::CloudFrames> framesOf(const sensor_msgs::PointCloud2& cloud,
                                               std::string& problem) const;
  void dropTooMany();
  void dropWaiting();
  void drop(const std::string& reason, const std::string& sentence);

  const FrameTransforms& transforms_;
  mutable std::mutex mutex_;
  CloudQueueOptions options_;
  std::deque<Waiting> waiting_;
  std::deque<Ready> ready_;
  CloudCounts counts_;
  std::map<std::string, Clock::time_point> said_;  // by reason
  bool taken_ = false;                             // one is being inserted
};

}  // namespace grid_path_planner::nodes
