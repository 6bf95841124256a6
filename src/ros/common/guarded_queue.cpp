#include "ros/common/guarded_queue.h"

#include <ros/console.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "base/current_error.h"

namespace grid_path_planner::nodes {

using base::currentErrorText;

namespace {

class GuardedCallback : public ros::CallbackInterface {
 public:
  explicit GuardedCallback(ros::CallbackInterfacePtr callback) : callback_(std::move(callback)) {}

  CallResult call() override {
    try {
      return callback_->call();
    } catch (...) {
      tellGivenUp("A callback", currentErrorText());
      return Success;
    }
  }
  bool ready() override { return callback_->ready(); }

 private:
  const ros::CallbackInterfacePtr callback_;
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

}  // namespace

void GuardedQueue::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  queue_.addCallback(boost::make_shared<GuardedCallback>(callback), owner);
}

void tellGivenUp(const std::string& what, const std::string& error) {
  ROS_ERROR_STREAM_THROTTLE(1.0, what << " was given up, the node goes on: " << error);
}

ros::CallbackInterfacePtr callbackOf(std::function<void()> work) {
  return boost::make_shared<Work>(std::move(work));
}

}  // namespace grid_path_planner::nodes
