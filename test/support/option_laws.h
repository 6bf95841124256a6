// What every options struct must hold to, whatever its options are.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <type_traits>

#include "grid_path_planner/base/option_text.h"
#include "support/error_text.h"

namespace grid_path_planner::test {

// A value outside the limits, one step above or below; the same where there is none.
inline double beyond(double limit, int direction) {
  return std::isinf(limit) ? limit : limit + direction * std::max(1.0, std::abs(limit));
}

// Whether an option of this type can be set to the number: no int lies above a limit that is the
// largest one.
template <class Value>
bool canHold(double number) {
  using Limits = std::numeric_limits<Value>;
  return number >= Limits::lowest() && number <= Limits::max();
}

// The name is under_scored, perhaps in a group ("sensor_model/hit"), and the description a sentence
// that stands on one line.
inline void expectDocumented(const std::string& name, const base::OptionInfo& info) {
  EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_/"), std::string::npos)
      << name;
  const std::string description = info.description;
  EXPECT_GE(description.size(), 10u) << name << " needs a description";
  EXPECT_EQ((description + info.heading).find_first_of("\n\"\\|"), std::string::npos) << name;
  EXPECT_LE(info.minimum, info.maximum) << name;
}

// "sensor_model" of "sensor_model/hit"; empty: in no group.
inline std::string groupOf(const std::string& name) {
  const std::size_t slash = name.find('/');
  return slash == std::string::npos ? "" : name.substr(0, slash);
}

// Defaults lie inside their limits, numbers just outside are refused by name, names differ, those
// of a group stand together, choices come back from their own names and other names are refused,
// and a default is among the names that it is one of.
template <class Options>
void expectOptionLaws() {
  EXPECT_EQ(errorText([] { base::checkOptionLimits(Options{}); }), "") << "of the defaults";
  std::set<std::string> names, groups;
  std::string group;
  Options options;
  visitOptions(options, [&](const char* name, auto& value, const base::OptionInfo& info) {
    using Value = std::decay_t<decltype(value)>;
    expectDocumented(name, info);
    EXPECT_TRUE(names.insert(name).second) << name << " is there twice";
    if (groupOf(name) != group) {
      group = groupOf(name);
      EXPECT_TRUE(group.empty() || groups.insert(group).second) << group << " is torn apart";
    }
    if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>) {
      const Value before = value;
      for (const double outside : {beyond(info.minimum, -1), beyond(info.maximum, +1)}) {
        if (!canHold<Value>(outside)) continue;
        value = static_cast<Value>(outside);
        EXPECT_EQ(
            errorText([&] { base::checkOptionLimits(options); }).find(std::string(name) + " must"),
            0u)
            << name << " = " << outside;
      }
      value = before;
    }
    if (info.names) {
      const auto& known = info.names();
      EXPECT_EQ(std::count(known.begin(), known.end(), base::valueText(value)), 1) << name;
    }
    if constexpr (std::is_enum_v<Value>) {
      for (const auto& choice : choicesOf(Value{})) {
        EXPECT_EQ(base::choiceFromName<Value>(name, choice.first), choice.second);
        EXPECT_STREQ(base::choiceName(choice.second), choice.first);
      }
      EXPECT_STRNE(base::choiceName(value), "?") << "the default of " << name;
      EXPECT_EQ(errorText([&] {
                  base::choiceFromName<Value>(name, "no such");
                }).find(std::string(name) + " must be one of"),
                0u);
    }
  });
  EXPECT_FALSE(names.empty());
}

}  // namespace grid_path_planner::test
