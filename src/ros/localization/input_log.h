// What came on each topic, and why what was refused was.
//
//   InputLog log;
//   log.refuse(Source::DVL, error.what());
#pragma once

#include <ros/time.h>

#include <array>
#include <cstdint>
#include <string>

#include "localization/measurement.h"

namespace grid_path_planner::nodes {

class InputLog {
 public:
  struct Input {
    std::uint64_t received = 0, refused = 0;
    std::string reason;  // of the newest refusal
  };

  void receive(localization::Source source) { ++of(source).received; }
  // Into the log too: the first of a source at once, then at most one line of each source in 5 s.
  void refuse(localization::Source source, const std::string& reason);

  const Input& operator[](localization::Source source) const {
    return inputs_[static_cast<std::size_t>(source)];
  }

 private:
  Input& of(localization::Source source) { return inputs_[static_cast<std::size_t>(source)]; }

  std::array<Input, localization::kSources> inputs_;
  std::array<ros::SteadyTime, localization::kSources> logged_;
};

}  // namespace grid_path_planner::nodes
