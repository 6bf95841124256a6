// Options as text: for logs, and to see whether two structs say the same.
#pragma once

#include <sstream>
#include <string>
#include <type_traits>

#include "grid_path_planner/base/option_visitor.h"

namespace grid_path_planner {

// A line "name: value" for every option, numbers with all their digits.
template <class Options>
std::string optionText(Options options) {
  std::ostringstream out;
  out.precision(17);
  out << std::boolalpha;
  visitOptions(options, [&out](const char* name, auto& value, const OptionInfo&) {
    out << name << ": ";
    if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
      out << choiceName(value);
    else
      out << value;
    out << '\n';
  });
  return out.str();
}

template <class Options>
bool sameOptions(const Options& a, const Options& b) {
  return optionText(a) == optionText(b);
}

}  // namespace grid_path_planner
