// One option's value from its text, for command lines and files.
//
//   parseOption("--radius", "0.4", info, options.terrain.radius);
//
// Nothing is guessed: a number must be all of the text, finite and inside the option's limits.
#pragma once

#include <cmath>
#include <string>
#include <type_traits>

#include "grid_path_planner/base/option_visitor.h"

namespace grid_path_planner {

// Throws InputError naming `name` for anything but one finite number.
double numberFromText(const std::string& name, const std::string& text);

// true, 1, yes; false, 0, no. Throws InputError naming `name` for anything else.
bool truthFromText(const std::string& name, const std::string& text);

// Throws InputError naming `name` for a text that is no such value; `value` is as it was then.
template <class Value>
void parseOption(const std::string& name, const std::string& text, const OptionInfo& info,
                 Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    value = choiceFromName<Value>(name, text);
  } else if constexpr (std::is_same_v<Value, bool>) {
    value = truthFromText(name, text);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    value = text;
  } else {
    const double number = numberFromText(name, text);
    checkLimits(name, number, info);
    if (std::is_same_v<Value, int> && number != std::floor(number))
      throw InputError(name + " needs a whole number, got '" + text + "'");
    value = static_cast<Value>(number);
  }
}

}  // namespace grid_path_planner
