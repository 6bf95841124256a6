// Point clouds between arrival and insertion: each waits for its own transform, none for another.
//
//   CloudQueue queue(transforms);
//   queue.setOptions(options);
//   queue.add(cloud);                       // in the subscriber's thread
//   queue.resolveTransforms();              // there too, every few milliseconds
//   while (auto ready = queue.pop()) use(*ready);  // in the mapping thread
//
// Guaranteed: the order of stamps does not matter; a cloud whose frame tf does not know waits for
// tf_timeout (steady clock) and delays no other; at most queue_size clouds wait for tf, at most
// queue_size for insertion, and all of them hold at most kMostCloudBytes, or are one. More are
// dropped: of those that wait for tf, which are dropped first for their bytes, the oldest of the frame
// that has the most, of those that wait for insertion the oldest. Each loss is counted with its reason
// and logged, at most once in five seconds. Thread-safe.
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
#include "ros/input/frame_lookup.h"

namespace grid_path_planner::nodes {

constexpr std::size_t kMostCloudBytes = std::size_t{256} << 20;

struct CloudQueueOptions {
  std::string frame = "map";
  std::string base_frame;   // "": not needed
  double tf_timeout = 1.0;  // s
  int queue_size = 10;
};

struct CloudCounts {
  std::uint64_t received = 0;
  std::uint64_t inserted = 0;
  std::size_t waiting = 0;                       // for tf or for insertion
  std::map<std::string, std::uint64_t> dropped;  // by reason
};

class CloudQueue {
 public:
  struct Ready {
    sensor_msgs::PointCloud2::ConstPtr cloud;
    mapping::CloudFrames frames;
  };

  // `transforms` outlives this.
  explicit CloudQueue(const FrameLookup& transforms) : transforms_(transforms) {}

  void setOptions(const CloudQueueOptions& options);

  void add(const sensor_msgs::PointCloud2::ConstPtr& cloud);
  // Looks up transforms and drops clouds that waited too long. Returns whether any cloud is ready.
  bool resolveTransforms();
  // The ready cloud that came first.
  std::optional<Ready> pop();
  // All that wait are dropped; `reason` in a few words, for the counts.
  void clear(const std::string& reason);

  // What became of a popped cloud; `reason` in a few words, for the counts.
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
  void dropTooLarge();
  void dropWaiting(const std::string& reason, const std::string& why);
  void dropReady(const std::string& reason, const std::string& why);
  std::size_t bytes() const;
  void drop(const std::string& reason, const std::string& sentence);

  const FrameLookup& transforms_;
  mutable std::mutex mutex_;
  CloudQueueOptions options_;
  std::deque<Waiting> waiting_;
  std::deque<Ready> ready_;
  CloudCounts counts_;
  std::map<std::string, Clock::time_point> last_warnings_;  // by reason
  bool taken_ = false;                                      // one is being inserted
};

}  // namespace grid_path_planner::nodes
