// What became of one flight.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace grid_path_planner::flights {

enum class FlightEnd {
  HOME,     // by the truth, all waypoints passed
  CONTACT,  // with the world or a body
  FENCE,    // out of its heights
  STUCK,    // the pilot gave up, and says why
  TIMEOUT,
  LOST,    // the pilot believes that it has arrived
  FAILED,  // the pilot itself: an exception, a program that ended
};
const std::vector<std::pair<const char*, FlightEnd>>& choicesOf(FlightEnd);

// Of the CPU, ms. Not part of what repeats.
struct FlightCost {
  double pilot_mean = 0.0, pilot_p99 = 0.0, pilot_max = 0.0;  // of an update with a frame
  double camera_mean = 0.0;                                   // of rendering a frame
};

struct FlightRecord {
  std::size_t variant = 0;
  std::size_t world = 0;
  int seed = 0;

  FlightEnd end = FlightEnd::TIMEOUT;
  std::string sentence;                          // the pilot's last, or what was touched
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // m, where it ended
  double speed = 0.0;                            // m/s, before it ended
  double time_s = 0.0;
  double length_m = 0.0;       // along the true path
  double home_offset_m = 0.0;  // from the last waypoint at the end
  double clearance_m = 0.0;    // least, from the vehicle's middle to a surface; at most 3
  double max_speed = 0.0;      // m/s
  int waypoints = 0;           // passed
  int unseen = 0;              // commands at which the vehicle was in space never seen
  int updates = 0;
  std::uint64_t bits = 0;  // a hash of all commands and true states: equal flights, equal bits
  std::vector<Eigen::Vector3f> path;  // m, true, some 5 places a second
  FlightCost cost;

  bool success() const { return end == FlightEnd::HOME; }
};

// One line of JSON, and back. Throws InputError for a line of another form.
std::string lineOf(const FlightRecord& record);
FlightRecord recordFromLine(const std::string& line);

}  // namespace grid_path_planner::flights
