// The subscription of whole maps, which is made anew where one is wanted:
// projected_map sends one to each new subscriber, and whoever latches it.
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "ros/guard/master/master_watch.h"
#include "ros/input/foreign_rules.h"

namespace grid_path_planner::nodes {

class WholeMapSubscription {
 public:
  using Clock = std::chrono::steady_clock;

  // Subscribes; `on_map` is called in the thread of `nh`.
  void start(ros::NodeHandle nh, std::string topic, std::function<void(const MapEvent&)> on_map);
  void shutdown() { subscriber_.shutdown(); }
  // Resolved.
  std::string topic() const { return subscriber_.getTopic(); }

  // For a whole map, unless one was asked for 2 s ago, or then 4, 8, up to a
  // minute; nothing while the master does not answer, whom roscpp waits for
  // without end.
  void ask();
  // It came, and has all that was missing.
  void isAnswered() { until_asked_again_ = kAnswer; }
  Clock::time_point askedAt() const { return asked_at_; }
  // Whether what was asked for may still come.
  bool isAsked() const { return Clock::now() - asked_at_ < kAnswer; }
  // Subscribes where there was no memory for it.
  void retry();

  static constexpr std::chrono::seconds kAnswer{2};  // to wait for what was asked for

 private:
  void subscribe();

  ros::NodeHandle nh_;
  std::string name_;
  std::function<void(const MapEvent&)> on_map_;
  std::shared_ptr<MasterWatch> master_;
  ros::Subscriber subscriber_;
  Clock::time_point asked_at_{};
  Clock::duration until_asked_again_{};  // from then
};

}  // namespace grid_path_planner::nodes
