// The one description of every option, from which YAML, ROS parameters, dynamic_reconfigure and the
// command line are all filled.
//
// An options struct `O` comes with a function template in its own header
//
//   template <class Visitor> void visitOptions(O& options, Visitor&& visit) {
//     visit("radius", options.radius, OptionInfo{"Vehicle radius", "m", 0.0, 1000.0});
//     visit("kernel_rule", options.kernel_rule, OptionInfo{"How a block is judged", ""});
//   }
//
// and a visitor is an object with `operator()(const char* name, T& value, const OptionInfo&)` for
// T in bool, int, double, std::string and enums. An enum E takes part by a function found by ADL
//
//   const std::vector<std::pair<const char*, E>>& choicesOf(E);
//
// and, where names were choices once, by another that says what to take instead of them:
//
//   std::string adviceFor(E, const std::string& name);  // "" for any other name
//
// Numbers outside [minimum, maximum] and unknown choices are refused by assignOption, never
// clamped.
#pragma once

#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner {

struct OptionInfo {
  const char* description;
  const char* unit;  // "" where there is none
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
};

// The name of an enum's value, and back. `name` in the message is the option's.
template <class E>
const char* choiceName(E value) {
  for (const auto& choice : choicesOf(E{}))
    if (choice.second == value) return choice.first;
  return "?";
}

template <class E>
std::string adviceFor(E, const std::string&) {
  return "";
}

template <class E>
E choiceFromName(const std::string& name, const std::string& text) {
  std::string known;
  for (const auto& choice : choicesOf(E{})) {
    if (text == choice.first) return choice.second;
    known += (known.empty() ? "" : ", ") + std::string(choice.first);
  }
  const std::string advice = adviceFor(E{}, text);
  if (!advice.empty()) throw InputError(name + " '" + text + "' " + advice);
  throw InputError(name + " must be one of " + known + ", got '" + text + "'");
}

// Throws InputError naming the option where `value` is not a number inside its limits.
inline void checkLimits(const std::string& name, double value, const OptionInfo& info) {
  if (value >= info.minimum && value <= info.maximum) return;  // NaN fails both
  const auto number = [](double x) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(12);
    text << x;
    return text.str();
  };
  throw InputError(name + " must be a number from " + number(info.minimum) + " to " +
                   number(info.maximum) + (*info.unit ? std::string(" ") + info.unit : "") +
                   ", got " + number(value));
}

}  // namespace grid_path_planner
