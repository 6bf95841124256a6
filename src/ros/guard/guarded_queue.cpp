#include "ros/guard/guarded_queue.h"

#include <ros/console.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "base/current_error.h"
#include "ros/guard/process/memory_failures.h"
#include "ros/guard/scheduling/log_throttle.h"

namespace grid_path_planner::nodes {

using base::currentErrorText;

// Whose callbacks are called, each while it holds the lock together with others; whoever removes them has it alone.
class CallbackOwner {
 public:
  // Invalid where they were removed.
  ros::CallbackInterface::CallResult call(ros::CallbackInterface& callback) {
    const std::shared_lock<std::shared_mutex> lock(mutex_);
    if (removed_) return ros::CallbackInterface::Invalid;
    const Calling calling{std::exchange(calling_, this)};
    return callback.call();
  }

  // Waits for those that run in other threads.
  void remove() {
    const bool by_its_own = calling_ == this;
    if (by_its_own) mutex_.unlock_shared();
    {
      const std::unique_lock<std::shared_mutex> lock(mutex_);
      removed_ = true;
    }
    if (by_its_own) mutex_.lock_shared();
  }

 private:
  struct Calling {
    const CallbackOwner* const outer;
    ~Calling() { calling_ = outer; }
  };

  static thread_local const CallbackOwner* calling_;

  std::shared_mutex mutex_;
  bool removed_ = false;
};

thread_local const CallbackOwner* CallbackOwner::calling_ = nullptr;

namespace {

class GuardedCallback : public ros::CallbackInterface {
 public:
  GuardedCallback(ros::CallbackInterfacePtr callback, std::shared_ptr<CallbackOwner> owner,
                  std::shared_ptr<NodeTime> time)
      : callback_(std::move(callback)), owner_(std::move(owner)), time_(std::move(time)) {}

  // Not under the owner's lock: a listener may remove an owner.
  CallResult call() override {
    CallResult result = Success;
    guarded("A callback", [&] {
      time_->tellJumps();
      result = owner_->call(*callback_);
    });
    return result;
  }
  bool ready() override { return callback_->ready(); }

 private:
  const ros::CallbackInterfacePtr callback_;
  const std::shared_ptr<CallbackOwner> owner_;
  const std::shared_ptr<NodeTime> time_;
};

class Work : public ros::CallbackInterface {
 public:
  explicit Work(std::function<void()> work) : work_(std::move(work)) {}
  CallResult call() override {
    work_();
    return Success;
  }

 private:
  const std::function<void()> work_;
};

void logGivenUp(const std::string& what, const std::string& error) {
  static LogThrottle seldom(1.0);
  ROS_ERROR_STREAM_COND(seldom.isDue(), what << " was given up, the node goes on: " << error);
}

}  // namespace

void GuardedQueue::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  ros::CallbackInterfacePtr guarded;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::shared_ptr<CallbackOwner>& known = owners_[owner];
    if (!known) known = std::make_shared<CallbackOwner>();
    guarded = boost::make_shared<GuardedCallback>(callback, known, time_);
    if (holds_) {
      held_.emplace_back(guarded, owner);
      return;
    }
  }
  queue_.addCallback(guarded, owner);
}

// Not under the lock: a callback that is waited for may add another. roscpp's own queue waits no longer
// since 2021 (ros_comm, pull request 2121, for those who stop a timer while they hold a lock that its
// callback takes), so that callbacks outlive what they refer to (its issue 2283). Here it does, so whoever
// shuts something down holds no such lock, nor may roscpp (service_caller.cpp).
void GuardedQueue::removeByID(std::uint64_t owner) {
  std::shared_ptr<CallbackOwner> removed;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = owners_.find(owner);
    if (known != owners_.end()) {
      removed = std::move(known->second);
      owners_.erase(known);
    }
    held_.erase(std::remove_if(held_.begin(), held_.end(),
                               [&](const auto& held) { return held.second == owner; }),
                held_.end());
  }
  queue_.removeByID(owner);
  if (removed) removed->remove();
}

void GuardedQueue::hold() {
  const std::lock_guard<std::mutex> lock(mutex_);
  holds_ = true;
}

void GuardedQueue::release() {
  const std::lock_guard<std::mutex> lock(mutex_);
  holds_ = false;
  for (const auto& [callback, owner] : held_) queue_.addCallback(callback, owner);
  held_.clear();
}

void tellGivenUp(const std::string& what, const std::string& error) {
  if (std::current_exception()) noteCurrentError();
  logGivenUp(what, error);
}

void tellGivenUp(const char* what) noexcept {
  noteCurrentError();
  try {
    logGivenUp(what, currentErrorText());
  } catch (...) {
    return;
  }
}

void callWaiting(ros::CallbackQueue& queue, ros::WallDuration timeout) noexcept {
  guarded("A round of callbacks", [&] { queue.callAvailable(timeout); });
}

ros::CallbackInterfacePtr callbackOf(std::function<void()> work) {
  return boost::make_shared<Work>(std::move(work));
}

bool doneWithin(double limit, ros::CallbackQueueInterface& queue, std::function<void()> work) {
  const auto done = std::make_shared<std::promise<void>>();
  const auto owner = reinterpret_cast<std::uint64_t>(done.get());
  queue.addCallback(callbackOf([done, work = std::move(work)] {
                      work();
                      done->set_value();
                    }),
                    owner);
  const auto result = done->get_future();
  const bool is =
      result.wait_for(std::chrono::duration<double>(limit)) == std::future_status::ready;
  queue.removeByID(owner);  // waits where it is being done just now
  return is;
}

}  // namespace grid_path_planner::nodes
