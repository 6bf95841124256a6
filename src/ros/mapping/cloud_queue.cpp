#include "ros/mapping/cloud_queue.h"

#include <ros/console.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using base::InputError;
using mapping::CloudFrames;

namespace {

constexpr std::chrono::seconds kSilence(5);  // between two warnings for the same reason
constexpr char kNoTransform[] = "no transform";
constexpr char kTooMany[] = "too many waiting for tf";
constexpr char kTooSlow[] = "faster than they are mapped";
constexpr char kTooLarge[] = "too many bytes waiting";

std::string describe(const sensor_msgs::PointCloud2& cloud) {
  std::ostringstream text;
  text << "a cloud in frame '" << cloud.header.frame_id << "' stamped " << cloud.header.stamp;
  return text.str();
}

}  // namespace

void CloudQueue::setOptions(const CloudQueueOptions& options) {
  std::lock_guard<std::mutex> lock(mutex_);
  options_ = options;
}

void CloudQueue::add(const sensor_msgs::PointCloud2::ConstPtr& cloud) {
  std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.received;
  try {
    if (frameName(cloud->header.frame_id).empty()) throw InputError("it names no frame");
  } catch (const InputError& error) {
    drop("no frame", std::string("a cloud without a frame that can be used: ") + error.what());
    return;
  }
  if (cloud->header.stamp.isZero())  // tf would lay it by the newest pose, whenever it was measured
    return drop("no stamp", "a cloud without a stamp, in frame '" + cloud->header.frame_id + "'");
  waiting_.push_back({cloud, Clock::now()});
}

// Each is taken out before it is looked at: what throws loses that one, and leaves no hole.
bool CloudQueue::resolveTransforms() {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto now = Clock::now();
  const std::chrono::duration<double> limit(options_.tf_timeout);
  for (std::size_t left = waiting_.size(); left > 0; --left) {
    const Waiting waiting = std::move(waiting_.front());
    waiting_.pop_front();
    std::string problem;
    if (const auto frames = framesOf(*waiting.cloud, problem))
      ready_.push_back({waiting.cloud, *frames});
    else if (now - waiting.since > limit)
      drop(kNoTransform, describe(*waiting.cloud) + ": " + problem);
    else
      waiting_.push_back(waiting);
  }
  dropTooMany();
  dropTooLarge();
  return !ready_.empty();
}

void CloudQueue::dropTooMany() {
  const auto most = static_cast<std::size_t>(options_.queue_size);
  while (waiting_.size() > most) dropWaiting(kTooMany, "more clouds than queue_size wait for tf");
  while (ready_.size() > most) dropReady(kTooSlow, "clouds come faster than they are mapped");
}

void CloudQueue::dropTooLarge() {
  const std::string why =
      "the clouds that wait hold more than " + std::to_string(kMostCloudBytes >> 20) + " MiB";
  while (waiting_.size() + ready_.size() > 1 && bytes() > kMostCloudBytes) {
    if (waiting_.empty())
      dropReady(kTooLarge, why);
    else
      dropWaiting(kTooLarge, why);
  }
}

std::size_t CloudQueue::bytes() const {
  std::size_t sum = 0;
  for (const Waiting& waiting : waiting_) sum += waiting.cloud->data.size();
  for (const Ready& ready : ready_) sum += ready.cloud->data.size();
  return sum;
}

void CloudQueue::dropReady(const std::string& reason, const std::string& why) {
  drop(reason, describe(*ready_.front().cloud) + ": " + why);
  ready_.pop_front();
}

// The oldest of the frame that has the most, so that no frame crowds out another.
void CloudQueue::dropWaiting(const std::string& reason, const std::string& why) {
  std::map<std::string, int> numbers;
  for (const Waiting& waiting : waiting_) ++numbers[waiting.cloud->header.frame_id];
  const auto most = std::max_element(numbers.begin(), numbers.end(),
                                     [](auto& a, auto& b) { return a.second < b.second; });
  const auto oldest = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return waiting.cloud->header.frame_id == most->first;
  });
  drop(reason, describe(*oldest->cloud) + ": " + why);
  waiting_.erase(oldest);
}

std::optional<CloudFrames> CloudQueue::framesOf(const sensor_msgs::PointCloud2& cloud,
                                                std::string& problem) const {
  const ros::Time stamp = cloud.header.stamp;
  const std::string source = frameName(cloud.header.frame_id);
  CloudFrames frames;
  try {
    frames.map_from_sensor =
        isometryOf(transforms_.transform(options_.frame, source, stamp).transform);
    if (!options_.base_frame.empty())
      frames.base_from_map =
          isometryOf(transforms_.transform(options_.base_frame, options_.frame, stamp).transform);
  } catch (const std::exception& error) {  // tf2 throws many kinds for stamps at the end of time
    problem = error.what();
    return std::nullopt;
  }
  return frames;
}

std::optional<CloudQueue::Ready> CloudQueue::pop() {
  std::lock_guard<std::mutex> lock(mutex_);
  if (ready_.empty()) return std::nullopt;
  Ready ready = std::move(ready_.front());
  ready_.pop_front();
  taken_ = true;
  return ready;
}

void CloudQueue::clear(const std::string& reason) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (const std::size_t waiting = waiting_.size() + ready_.size(); waiting > 0)
    counts_.dropped[reason] += waiting;
  waiting_.clear();
  ready_.clear();
}

void CloudQueue::countInserted() {
  std::lock_guard<std::mutex> lock(mutex_);
  taken_ = false;
  ++counts_.inserted;
}

void CloudQueue::countDropped(const std::string& reason, const std::string& sentence) {
  std::lock_guard<std::mutex> lock(mutex_);
  taken_ = false;
  drop(reason, sentence);
}

CloudCounts CloudQueue::counts() const {
  std::lock_guard<std::mutex> lock(mutex_);
  CloudCounts counts = counts_;
  counts.waiting = waiting_.size() + ready_.size() + (taken_ ? 1 : 0);
  return counts;
}

void CloudQueue::drop(const std::string& reason, const std::string& sentence) {
  const std::uint64_t count = ++counts_.dropped[reason];
  const auto now = Clock::now();
  const auto last_warning = last_warnings_.find(reason);
  if (last_warning != last_warnings_.end() && now - last_warning->second < kSilence) return;
  last_warnings_[reason] = now;
  ROS_WARN_STREAM("Dropped " << sentence << "; dropped for this reason so far: " << count);
}

}  // namespace grid_path_planner::nodes
