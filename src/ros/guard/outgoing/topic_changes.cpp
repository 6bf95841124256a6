#include "ros/guard/outgoing/topic_changes.h"

#include <chrono>
#include <thread>

namespace grid_path_planner::nodes {
namespace {

constexpr std::chrono::milliseconds kLongestWait(500);

std::recursive_mutex& topicMutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

TopicLock lockTopics() {
  return TopicLock(topicMutex());
}

TopicLock lockTopicsOfRunningNode() {
  TopicLock lock(topicMutex(), std::try_to_lock);
  const auto end = std::chrono::steady_clock::now() + kLongestWait;
  while (!lock && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lock.try_lock();
  }
  return lock;
}

}  // namespace grid_path_planner::nodes
