// Whether every number of an options struct lies inside the limits that its visitOptions states.
#pragma once

#include <type_traits>

#include "grid_path_planner/base/option_visitor.h"

namespace grid_path_planner {

// Throws InputError naming the first option outside its limits.
template <class Options>
void checkOptionLimits(Options options) {
  visitOptions(options, [](const char* name, auto& value, const OptionInfo& info) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>)
      checkLimits(name, static_cast<double>(value), info);
  });
}

}  // namespace grid_path_planner
