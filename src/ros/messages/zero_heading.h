// What an orientation of zeros in a goal or a path means: rospy's clients leave it so.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::nodes {

enum class ZeroHeading { REFUSED, ANY };

inline const std::vector<std::pair<const char*, ZeroHeading>>& choicesOf(ZeroHeading) {
  static const std::vector<std::pair<const char*, ZeroHeading>> choices = {
      {"refused", ZeroHeading::REFUSED}, {"any", ZeroHeading::ANY}};
  return choices;
}

// The option of the nodes that are given goals and paths.
template <class Visitor>
void visitZeroHeading(ZeroHeading& zero_heading, Visitor&& visit) {
  visit("zero_heading", zero_heading,
        base::OptionInfo{"What an orientation of zeros asks for, as clients send that set none: "
                         "refused: no heading was "
                         "given, INVALID_REQUEST; any: the vehicle may look as it arrives",
                         ""});
}

}  // namespace grid_path_planner::nodes
