// What contradicts a pose, whatever its own covariance says of it.
//
//   if (const auto doubt = doubtOf(snapshot, now, options)) say(sentenceOf(*doubt));
#pragma once

#include <optional>
#include <string>

#include "localization/filter_step.h"
#include "localization/localizer_options.h"

namespace grid_path_planner::localization {

struct PoseDoubt {
  Source source;  // that contradicts it
  bool lasts;     // for good: by odds (contradiction.h)
  double metres = 0.0,
         degrees = 0.0;  // by how far the last one was off; 0: it does not measure that
};

// By a fix, a depth or a heading: from two that agree with each other on. A source that contradicts it for good is told
// first; fixes of another kind that confirm the pose overrule one, a marker all.
std::optional<PoseDoubt> doubtOf(const FilterSnapshot& snapshot, Stamp now,
                                 const LocalizerOptions& options);

std::string sentenceOf(const PoseDoubt& doubt);

}  // namespace grid_path_planner::localization
