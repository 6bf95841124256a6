// Whether a node's options struct, its .cfg and its config/<node>.yaml state the same defaults.
//
// The YAML is loaded by roslaunch into the namespace /<node>, as users load it.
#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <limits>
#include <set>
#include <string>

#include "ros/guard/parameters.h"

namespace grid_path_planner::test {

// One line a parameter: name, type and value.
inline std::set<std::string> linesOf(const dynamic_reconfigure::Config& message) {
  std::set<std::string> lines;
  for (const auto& p : message.bools) lines.insert(p.name + " bool " + std::to_string(p.value));
  for (const auto& p : message.ints) lines.insert(p.name + " int " + std::to_string(p.value));
  for (const auto& p : message.doubles) lines.insert(p.name + " double " + std::to_string(p.value));
  for (const auto& p : message.strs) lines.insert(p.name + " string " + p.value);
  return lines;
}

template <class Config>
void expectSameChoices(const std::string& option, const std::set<std::string>& choices) {
  for (const auto& description : Config::__getParamDescriptions__()) {
    if (description->name != option) continue;
    std::set<std::string> offered;
    const std::string key = "'value': '";
    const std::string& text = description->edit_method;
    for (auto at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
      offered.insert(
          text.substr(at + key.size(), text.find('\'', at + key.size()) - at - key.size()));
    EXPECT_EQ(offered, choices) << "of " << option;
  }
}

// dynamic_reconfigure clamps to the limits of a .cfg without a word, so it must not have any.
template <class Config>
void expectNoLimits() {
  dynamic_reconfigure::Config least, largest;
  Config::__getMin__().__toMessage__(least);
  Config::__getMax__().__toMessage__(largest);
  for (const auto& p : least.ints) EXPECT_EQ(p.value, std::numeric_limits<int>::min()) << p.name;
  for (const auto& p : largest.ints) EXPECT_EQ(p.value, std::numeric_limits<int>::max()) << p.name;
  for (const auto& p : least.doubles) EXPECT_LT(p.value, -1e300) << p.name;
  for (const auto& p : largest.doubles) EXPECT_GT(p.value, 1e300) << p.name;
}

template <class Config, class Options>
void expectSameDefaults(const std::string& node) {
  const auto expected = linesOf(nodes::configMessage(Options()));
  dynamic_reconfigure::Config from_cfg;
  Config::__getDefault__().__toMessage__(from_cfg);
  EXPECT_EQ(linesOf(from_cfg), expected) << "cfg of " << node;

  const ros::NodeHandle nh("/" + node);
  const auto names = nodes::optionNames<Options>();
  EXPECT_EQ(nodes::unknownParameters(nh, names), std::vector<std::string>{})
      << "config of " << node;
  for (const std::string& name : names)
    EXPECT_TRUE(nh.hasParam(name)) << "config/" << node << ".yaml lacks " << name;
  Options from_yaml;
  nodes::loadParameters(nh, from_yaml);
  EXPECT_EQ(linesOf(nodes::configMessage(from_yaml)), expected) << "config of " << node;

  Options options;
  visitOptions(options, [](const char* name, auto& value, const base::OptionInfo&) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_enum_v<Value>) {
      std::set<std::string> choices;
      for (const auto& choice : choicesOf(Value{})) choices.insert(choice.first);
      expectSameChoices<Config>(name, choices);
    }
  });
  expectNoLimits<Config>();
}

}  // namespace grid_path_planner::test
