// A map that map_layers lays: whether it is there, and how old what it said is. Its scans are judged by Input.
#pragma once

#include <ros/time.h>

#include <chrono>
#include <string>
#include <utility>

#include "base/seconds_since.h"
#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::nodes {

class LayerSource {
 public:
  // `topic`: resolved. `expires`: whether it must go on saying something.
  LayerSource(std::string topic, bool used, bool expires)
      : topic_(std::move(topic)), used_(used), expires_(expires) {}

  // It said something that could be used, stamped so (0: of no time).
  void accept(const ros::Time& stamp) {
    there_ = true;
    problem_.clear();
    beat(stamp);
  }
  // What it said before still holds, and is of this time.
  void beat(const ros::Time& stamp) {
    stamp_ = stamp;
    heard_ = std::chrono::steady_clock::now();
  }
  // It said something that cannot be used: it counts as not there until it says something else.
  void refuse(std::string problem) { problem_ = std::move(problem); }

  // Why the map cannot be made with it now, in a sentence; empty where it can, or it is not used.
  std::string whyNot(double timeout) const {
    if (!used_) return "";
    if (!problem_.empty()) return topic_ + " cannot be used: " + problem_;
    if (!there_) return "nothing has come on " + topic_ + " yet";
    if (!expires_ || silence() <= timeout) return "";
    return topic_ + " has been silent for longer than source_timeout, " +
           base::decimalText(timeout) + " s";
  }
  // Whether whyNot() is that it says nothing, for `timeout` or, before the first, for that long since it was made.
  bool silentFor(double timeout) const {
    return problem_.empty() && expires_ && base::secondsSince(heard_) > timeout;
  }
  // s of the wall clock; 0 before the first.
  double silence() const { return there_ ? base::secondsSince(heard_) : 0.0; }

  const std::string& topic() const { return topic_; }
  bool used() const { return used_; }
  bool expires() const { return expires_; }
  bool there() const { return there_; }
  const ros::Time& stamp() const { return stamp_; }

 private:
  const std::string topic_;
  const bool used_;
  const bool expires_;
  bool there_ = false;
  std::string problem_;
  ros::Time stamp_;
  std::chrono::steady_clock::time_point heard_ = std::chrono::steady_clock::now();
};

}  // namespace grid_path_planner::nodes
