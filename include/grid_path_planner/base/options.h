// The one description of every option, from which YAML, ROS parameters, dynamic_reconfigure, the
// command line and the tables of the documentation are all filled.
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
// Numbers outside [minimum, maximum] and unknown choices are refused, never clamped.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::base {

struct OptionInfo {
  // What it is, and what follows from another value: "Side of a block; higher: faster, coarser".
  const char* description;
  const char* unit;  // "" where there is none
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  const char* heading = "";  // of the group of options that begins here
  // The values of a std::string that has a fixed list of them.
  const std::vector<std::string>& (*names)() = nullptr;

  // The same for the first option of a group.
  constexpr OptionInfo under(const char* group) const {
    return {description, unit, minimum, maximum, group, names};
  }
  constexpr OptionInfo oneOf(const std::vector<std::string>& (*known)()) const {
    return {description, unit, minimum, maximum, heading, known};
  }
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
void checkLimits(const std::string& name, double value, const OptionInfo& info);

// Throws InputError naming the first option outside its limits.
template <class Options>
void checkOptionLimits(Options options) {
  visitOptions(options, [](const char* name, auto& value, const OptionInfo& info) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>)
      checkLimits(name, static_cast<double>(value), info);
  });
}

// The names of the options whose values differ, in their order.
template <class Options>
std::vector<std::string> differingOptions(Options a, Options b) {
  std::vector<const void*> values;  // of a; b is visited in the same order
  visitOptions(a, [&](const char*, auto& value, const OptionInfo&) { values.push_back(&value); });
  std::vector<std::string> names;
  std::size_t i = 0;
  visitOptions(b, [&](const char* name, auto& value, const OptionInfo&) {
    using Value = std::decay_t<decltype(value)>;
    if (*static_cast<const Value*>(values[i++]) != value) names.emplace_back(name);
  });
  return names;
}

template <class Options>
bool sameOptions(const Options& a, const Options& b) {
  return differingOptions(a, b).empty();
}

}  // namespace grid_path_planner::base
