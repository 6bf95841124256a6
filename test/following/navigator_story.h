// A navigator to which events are told in words, and its orders as words.
#pragma once

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "following/go_to/navigator.h"

namespace grid_path_planner::test {

using following::Navigator;
using following::NavigatorDrive;
using following::NavigatorOptions;
using following::NavigatorOrder;

inline path::Path straight(double length) {
  path::Path path;
  path.poses = {{{0.0, 0.0, 0.0}, 0.0}, {{length, 0.0, 0.0}, 0.0}};
  return path;
}

inline std::string nameOf(const NavigatorOrder& order) {
  std::ostringstream name;
  switch (order.kind) {
    case NavigatorOrder::Kind::PLAN:
      name << "PLAN";
      if (order.tolerance > 0.0) name << "~" << order.tolerance;
      break;
    case NavigatorOrder::Kind::DRIVE:
      name << "DRIVE(" << order.path.poses.back().position.x() << ","
           << std::round(10.0 * order.path.poses.back().yaw) / 10.0 << ")";
      break;
    case NavigatorOrder::Kind::FORGET_PLAN:
      return "FORGET";
    case NavigatorOrder::Kind::STOP:
      return "STOP";
    case NavigatorOrder::Kind::CLEAR_SCAN:
      return "CLEAR_SCAN";
    case NavigatorOrder::Kind::SUCCEED:
      return "SUCCEED";
    case NavigatorOrder::Kind::ABORT:
      return "ABORT";
    case NavigatorOrder::Kind::PREEMPT:
      return "PREEMPT";
    case NavigatorOrder::Kind::TELL:
    case NavigatorOrder::Kind::WARN:
      return "";
  }
  return name.str();
}

// A navigator and its time, to which one event after the other is told in words.
class Story {
 public:
  explicit Story(const NavigatorOptions& options = {}) : navigator(options) {}

  // The orders that follow, without what is only told.
  std::string after(const std::string& event) {
    std::istringstream words(event);
    std::string word, number;
    words >> word >> number;
    happen(word, std::strtod(number.c_str(), nullptr));  // 0 without one
    return orders();
  }

  Navigator navigator;
  double now = 100.0;
  std::vector<std::string> told;
  std::string last_sentence;

 private:
  void happen(const std::string& word, double number) {
    if (word == "start")
      navigator.start(now);
    else if (word == "cancel")
      navigator.cancel("cancelled by whoever has sent the goal", now);
    else if (word == "abort")
      navigator.abort("the clock jumped", now);
    else if (word == "drop")
      navigator.drop();
    else if (word == "FOUND")
      navigator.planned({base::Status::FOUND, "a path", straight(number)}, now);
    else if (word == "at")
      navigator.moved({{number, 0.0, 0.0}, 0.0});
    else if (word == "drives")
      navigator.drove({NavigatorDrive::State::DRIVING, number}, now);
    else if (word == "paused")
      navigator.drove({NavigatorDrive::State::PAUSED, number}, now);
    else if (word == "held")
      navigator.drove({NavigatorDrive::State::HELD, number, "stopped by the topic stop"}, now);
    else if (word == "obstructed")
      navigator.drove({NavigatorDrive::State::OBSTRUCTED, number, "occupied ahead"}, now);
    else if (word == "seconds")
      for (const double end = now + number; now < end - 1e-9;) navigator.tick(now += 0.05);
    else if (word.rfind("end:", 0) == 0)
      navigator.driveEnded(following::driveStatusFromName(word.substr(4)), "so it ended", now);
    else
      navigator.planned({base::statusFromName(word), "so it was answered"}, now);
  }

  std::string orders() {
    std::string names;
    for (const NavigatorOrder& order : navigator.takeOrders()) {
      const std::string name = nameOf(order);
      if (name.empty()) told.push_back(order.sentence);
      if (!name.empty()) last_sentence = order.sentence;
      names += (names.empty() || name.empty() ? "" : " ") + name;
    }
    return names;
  }
};

inline NavigatorOptions withSteps(const std::string& steps) {
  NavigatorOptions options;
  options.recovery_steps = steps;
  return options;
}

}  // namespace grid_path_planner::test
