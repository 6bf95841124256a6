// How new what a map holds is, as its publisher says.
//
//   MapData data;  // of one publisher's map
//   data.noteMap(map.header.stamp, Instant::now());
//   data.noteHeartbeat(beat.header.stamp, Instant::now());
//   if (const auto problem = data.problem(Instant::now(), driven, 3.0)) hold(*problem);
//
// A publisher with heartbeats stamps them with the newest measurement in its map; 0: none has entered, as of a file, and no age
// is too old. The age is what it was when the last message came, and what passed since by ROS time or the wall clock, whichever
// is less: a simulation that is faster than real time has fewer messages in a second of its time.
//
// Of any other publisher it is only known when it sent another map. One map is a static one. From the second on the next is
// waited for, 3 times as long as the longest wait so far: in time that the vehicle was driven, since gmapping, karto and rtabmap
// make a map where the vehicle has moved, and one that is held for want of a map would stand for ever. Who has sent none for a
// minute, as after a map was edited, begins anew.
#pragma once

#include <ros/time.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace grid_path_planner::nodes {

// By both clocks.
struct Instant {
  ros::Time ros;
  std::chrono::steady_clock::time_point wall{};

  static Instant now() { return {ros::Time::now(), std::chrono::steady_clock::now()}; }
};

class MapData {
 public:
  // A whole map or an update of its publisher, stamped so (0: of no time), has come.
  void noteMap(const ros::Time& stamp, const Instant& now);
  void noteHeartbeat(const ros::Time& stamp, const Instant& now);

  // Whether the publisher sends heartbeats.
  bool beats() const { return beats_; }
  // Stamp of the newest measurement in the map; without heartbeats that of its newest message. 0: there is none.
  const ros::Time& newest() const { return newest_; }
  // How often a message with another one came.
  std::uint64_t changes() const { return changes_; }
  // s of ROS time. Precondition: newest() is not 0.
  double age(const Instant& now) const;

  // Why the map must not be driven by now, in a sentence without its topic; `driven`: for how many seconds the vehicle was
  // since changes() changed.
  std::optional<std::string> problem(const Instant& now, double driven, double timeout) const;

 private:
  bool beats_ = false;
  ros::Time newest_;
  Instant told_;  // when that was told last
  std::uint64_t changes_ = 0;
  double longest_wait_ = 0.0;  // s, between two changes
  bool waits_ = false;         // for the next change, without heartbeats
};

}  // namespace grid_path_planner::nodes
