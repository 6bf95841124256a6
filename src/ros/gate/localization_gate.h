// Whether a vehicle may be driven by what its localiser says of itself: OK drives, DEGRADED slowly and for a while, LOST not.
//
//   LocalizationGate gate;
//   gate.hear("DEGRADED: fixes contradict the pose", now);   // std_msgs/String on localization_status
//   if (const auto why = gate.problem(now, options)) hold(*why);
//
// A localiser that never spoke is no reason to hold, one that fell silent is. Belongs to one thread.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace grid_path_planner::nodes {

struct DegradedDriving {
  double speed = 0.5;  // share of max_speed
  double time = 30.0;  // s; 0: not at all
};

class LocalizationGate {
 public:
  static constexpr double kSilent = 5.0;  // s of the wall clock; the localiser speaks every second

  // Times in seconds, of ROS. False for a text that begins with no status, which changes nothing.
  bool hear(const std::string& text, double now);
  // Drives on by a degraded pose for another while; false where nothing has run out.
  bool grant(double now, const DegradedDriving& degraded);
  // Of before a jump of time.
  void timeWentBack() { degraded_since_.reset(); }

  std::optional<std::string> problem(double now, const DegradedDriving& degraded) const;
  // 1 unless the pose is degraded.
  double speedShare(const DegradedDriving& degraded) const;

 private:
  enum class Status { OK, DEGRADED, LOST };

  std::optional<Status> status_;  // none: it never spoke
  std::string text_;
  std::optional<double> degraded_since_;  // s
  std::chrono::steady_clock::time_point last_heard_;
};

}  // namespace grid_path_planner::nodes
