// Options as text: their values read from it and written to it, and all that visitOptions says of
// them, for command lines, files and logs.
//
//   parseOption("--radius", "0.4", info, options.costmap.radius);
//   for (const OptionDescription& option : describeOptions(PlannerOptions()))
//     std::cout << option.name << ": " << option.value << '\n';
//
// Nothing is guessed: a number must be all of the text, finite and inside the option's limits.
#pragma once

#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::base {

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

// The option `name` of a struct from a text, as parseOption reads it; false where there is no such option.
template <class Options>
bool setOption(Options& options, const std::string& name, const std::string& text) {
  bool known = false;
  visitOptions(options, [&](const char* each, auto& value, const OptionInfo& info) {
    if (name != each) return;
    known = true;
    parseOption(name, text, info, value);
  });
  return known;
}

// The text that parseOption reads back as the same value.
template <class Value>
std::string valueText(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return choiceName(value);
  else if constexpr (std::is_same_v<Value, bool>)
    return value ? "true" : "false";
  else if constexpr (std::is_same_v<Value, std::string>)
    return value;
  else if constexpr (std::is_same_v<Value, int>)
    return std::to_string(value);
  else
    return decimalText(value);
}

enum class OptionType { TRUTH, WHOLE_NUMBER, NUMBER, TEXT };

struct OptionDescription {
  std::string name;
  OptionType type;
  std::string value;
  std::string description, unit;
  double minimum, maximum;
  std::string heading;               // "" but for the first option of a group
  std::vector<std::string> choices;  // empty: any text
};

// The option `name` whose value is now `value`.
template <class Value>
OptionDescription describeOption(const char* name, const Value& value, const OptionInfo& info) {
  const OptionType type = std::is_same_v<Value, bool>     ? OptionType::TRUTH
                          : std::is_same_v<Value, int>    ? OptionType::WHOLE_NUMBER
                          : std::is_same_v<Value, double> ? OptionType::NUMBER
                                                          : OptionType::TEXT;
  std::vector<std::string> choices;
  if (info.names) choices = info.names();
  if constexpr (std::is_enum_v<Value>)
    for (const auto& choice : choicesOf(Value{})) choices.emplace_back(choice.first);
  return {name,         type,         valueText(value), info.description, info.unit,
          info.minimum, info.maximum, info.heading,     choices};
}

// All options with their values in `options`, in their order.
template <class Options>
std::vector<OptionDescription> describeOptions(Options options) {
  std::vector<OptionDescription> all;
  visitOptions(options, [&](const char* name, auto& value, const OptionInfo& info) {
    all.push_back(describeOption(name, value, info));
  });
  return all;
}

// A line "name: value" for every option.
template <class Options>
std::string optionText(const Options& options) {
  std::string text;
  for (const OptionDescription& option : describeOptions(options))
    text += option.name + ": " + option.value + '\n';
  return text;
}

// The name of `known` that was probably meant by `name`, which is none of them; "" where none is
// like it.
std::string closestName(const std::string& name, const std::vector<std::string>& known);

// The name of an option where names are those of C++, as in dynamic_reconfigure:
// sensor_model/hit is sensor_model_hit.
std::string configName(std::string name);

}  // namespace grid_path_planner::base
