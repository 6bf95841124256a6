// What a pilot was given and answered, in a file from which the flight is repeated to the bit.
//
//   FlightLog log(file, options, limit);           // writes; throws InputError
//   log.route(waypoints);
//   log.update(input, answer);
//
//   const ReplayResult result = replayFlight(file);   // reads, flies again and compares
//
// A file is the line "grid_path_planner flight 2", the options as YAML up to a line "...", then records:
// a letter, a length of 8 bytes and that many bytes, all numbers little-endian. A record that is cut off
// at the end of a file (a node that was killed) ends it. Guaranteed: the pilot that repeats a log gives
// the same answers, bit for bit, on the same build.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::avoidance {

class FlightLog {
 public:
  // Throws InputError where `file` cannot be written. After `limit` bytes, or where the disk is full,
  // nothing more is written.
  FlightLog(const base::OutputFile& file, const PilotOptions& options, std::uint64_t limit);

  void options(const PilotOptions& options);
  void route(const std::vector<Eigen::Vector3d>& waypoints);
  void path(const std::vector<Eigen::Vector3d>& path);
  void mapPlan(const std::vector<Eigen::Vector3d>& plan);  // what the callback answered
  void cancel(const std::string& reason);
  void forget();
  void see(const Frame& frame);
  void update(const PilotInput& input, const PilotAnswer& answer);

  bool full() const { return !problem_.empty(); }
  // Why nothing more is written; empty: it still is.
  const std::string& problem() const { return problem_; }

 private:
  void write(char kind, const std::vector<char>& bytes);

  base::StreamedFile out_;
  std::uint64_t left_;
  std::string problem_;
};

struct ReplayResult {
  std::uint64_t updates = 0;
  std::uint64_t differing = 0;        // updates whose answer was another
  std::string first_difference = {};  // a sentence; empty where there is none
};

// Flies a log again; `each`, if any, gets every input and its new answer. Throws InputError naming the
// file for one that is no log, damaged, or no regular file.
ReplayResult replayFlight(
    const std::string& file,
    const std::function<void(const PilotInput&, const PilotAnswer&)>& each = {});

}  // namespace grid_path_planner::avoidance
