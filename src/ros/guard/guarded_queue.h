// A callback queue whose callbacks may throw.
//
//   GuardedQueue queue(*nh.getCallbackQueue());
//   nh.setCallbackQueue(&queue);   // subscriptions, timers, services and actions of `nh` from now on
//
// Guaranteed: an exception ends its callback, never the thread that serves the queue, also where there is no memory to
// tell it; the log says which, at most once a second. roscpp by itself lets it end the process, a nodelet manager with all
// that it holds. Where ROS time went back, the listeners of time() have returned before a callback begins. Between hold()
// and release() nothing is called: a node's constructor is not met by its own callbacks in another thread. Once
// removeByID() has returned no callback of that owner runs or begins, unless it was called by one: roscpp's queue may
// still begin one that another thread had just taken out of it. Where a callback has removed its own owner, a second call
// does not wait for it. The queue behind does the work and outlives this; callbacks that wait in it may outlive this too.
// Thread-safe.
#pragma once

#include <ros/callback_queue.h>
#include <ros/callback_queue_interface.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "ros/guard/node_time.h"

namespace grid_path_planner::nodes {

class CallbackOwner;

class GuardedQueue : public ros::CallbackQueueInterface {
 public:
  explicit GuardedQueue(ros::CallbackQueueInterface& queue) : queue_(queue) {}

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner = 0) override;
  void removeByID(std::uint64_t owner) override;

  void hold();
  // What came since hold() is called, in its order.
  void release();

  NodeTime& time() { return *time_; }

 private:
  ros::CallbackQueueInterface& queue_;
  const std::shared_ptr<NodeTime> time_ = std::make_shared<NodeTime>();
  std::mutex mutex_;
  bool holds_ = false;
  std::vector<std::pair<ros::CallbackInterfacePtr, std::uint64_t>> held_;  // with their owners
  std::map<std::uint64_t, std::shared_ptr<CallbackOwner>> owners_;
};

// Into the log, at most once a second: an exception ended `what`, and nothing else. In a catch block std::bad_alloc is counted.
void tellGivenUp(const std::string& what, const std::string& error);
// The exception that is being handled. Where there is no memory to tell it, nothing is told; std::bad_alloc is counted
// (process/memory_failures.h). Precondition: called in a catch block.
void tellGivenUp(const char* what) noexcept;
// Calls `work`; an exception of it ends it, is told as one of `what`, and goes no further. Returns whether there was none.
template <class Work>
bool guarded(const char* what, const Work& work) noexcept {
  try {
    work();
    return true;
  } catch (...) {
    tellGivenUp(what);
    return false;
  }
}

// Calls what waits in a queue. For the loop of a thread that serves one: roscpp's queue itself wants memory, too.
void callWaiting(ros::CallbackQueue& queue, ros::WallDuration timeout) noexcept;

// Work for the thread that serves a queue.
ros::CallbackInterfacePtr callbackOf(std::function<void()> work);

// Whether the thread that serves `queue` did `work` within `limit` seconds; it is not done later. For other threads
// than that.
bool doneWithin(double limit, ros::CallbackQueueInterface& queue, std::function<void()> work);

}  // namespace grid_path_planner::nodes
