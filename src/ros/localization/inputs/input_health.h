// What the diagnostics say of an input of vehicle_localizer.
#pragma once

#include <optional>
#include <string>

#include "localization/input_statistics.h"
#include "ros/input/input_judge.h"
#include "ros/localization/vehicle_localizer_options.h"

namespace grid_path_planner::nodes {

struct InputExpectation {
  double silent_after;  // s, infinite: it comes when somebody wants
  bool is_missed;       // when it is silent
  bool is_spare;        // used only where another input is lost
};

InputExpectation expectationOf(localization::Source source, const VehicleLocalizerOptions& options);

struct InputHealth {
  bool is_good;
  std::string sentence;
};

// The age in `statistics` is that of the newest measurement, or where the history has none of the newest that was used.
// `problem` is that of the input (input.h).
InputHealth healthOf(const localization::InputStatistics& statistics, const InputCounts& counts,
                     const std::optional<std::string>& problem,
                     const InputExpectation& expectation);

}  // namespace grid_path_planner::nodes
