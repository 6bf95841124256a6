// The messages of a topic as they come, for rostests.
#pragma once

#include <ros/ros.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ros/support/wait.h"

namespace grid_path_planner::test {

template <class Message>
class Latest {
 public:
  Latest(ros::NodeHandle nh, const std::string& topic)
      : subscriber_(nh.subscribe(topic, kQueue, &Latest::onMessage, this)) {}

  std::size_t count() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return messages_.size();
  }
  std::vector<Message> all() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }
  bool connected() const { return publishers() > 0; }
  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }

  // The newest message once more than `seen` came and `accept` takes it; none at the deadline.
  template <class Accept>
  std::optional<Message> waitFor(std::size_t seen, Accept accept) const {
    std::optional<Message> found;
    test::waitFor([&] {
      std::lock_guard<std::mutex> lock(mutex_);
      for (std::size_t i = messages_.size(); i-- > seen && !found;)
        if (accept(messages_[i])) found = messages_[i];
      return found.has_value();
    });
    return found;
  }
  std::optional<Message> waitForMoreThan(std::size_t seen) const {
    return waitFor(seen, [](const Message&) { return true; });
  }

 private:
  static constexpr int kQueue = 10000;  // none is lost where the test waits for the processor

  void onMessage(const typename Message::ConstPtr& message) {
    std::lock_guard<std::mutex> lock(mutex_);
    messages_.push_back(*message);
  }

  mutable std::mutex mutex_;
  std::vector<Message> messages_;
  ros::Subscriber subscriber_;
};

}  // namespace grid_path_planner::test
