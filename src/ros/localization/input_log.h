// What came on each topic, and why what was refused was.
//
//   InputLog log;
//   log[Source::DVL].refuse(error.what());
#pragma once

#include <vector>

#include "localization/measurement.h"
#include "ros/input/input_record.h"

namespace grid_path_planner::nodes {

class InputLog {
 public:
  InputLog() {
    for (int source = 0; source < localization::kSources; ++source)
      inputs_.emplace_back(nameOf(static_cast<localization::Source>(source)));
  }

  InputRecord& operator[](localization::Source source) {
    return inputs_[static_cast<std::size_t>(source)];
  }

 private:
  std::vector<InputRecord> inputs_;
};

}  // namespace grid_path_planner::nodes
