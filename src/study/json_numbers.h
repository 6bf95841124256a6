// Whole numbers of lines that a study finds in its folder.
//
//   run.seed = wholeNumberOf<int>(object.at("seed"));
//
// nlohmann's get() takes 1e300 and -1 for any kind of number: what it makes of them for an int or an index is undefined
// or another one.
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::study {

// Throws InputError for what is no whole number that a Number can hold.
template <class Number>
Number wholeNumberOf(const nlohmann::json& value) {
  using Limits = std::numeric_limits<Number>;
  bool fits = false;
  if (value.is_number_unsigned()) {
    fits = value.get<std::uint64_t>() <= static_cast<std::uint64_t>(Limits::max());
  } else if (value.is_number_integer()) {
    const auto number = value.get<std::int64_t>();
    fits = Limits::is_signed && number >= static_cast<std::int64_t>(Limits::min()) &&
           number <= static_cast<std::int64_t>(Limits::max());
  }
  if (!fits) throw base::InputError("a whole number must stand where " + value.dump() + " does");
  return value.get<Number>();
}

}  // namespace grid_path_planner::study
