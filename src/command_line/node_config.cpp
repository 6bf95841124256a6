#include "command_line/node_config.h"

#include <algorithm>
#include <iostream>
#include <type_traits>
#include <vector>

#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/yaml_file.h"
#include "ros/guard/parameters.h"
#include "ros/planning/path_planner_options.h"

namespace grid_path_planner::command_line {

using base::InputError, base::loadYamlFile, base::OptionInfo, base::parseOption, base::yamlAs,
    base::yamlError;
using nodes::meantText, nodes::optionNames, nodes::PathPlannerNodeOptions;
using planning::PlannerOptions;

namespace {

// A list on one line, "[[0.5, 0.3], [0.5, -0.3]]", as a footprint is written on the command line.
std::string flowText(const YAML::Node& list) {
  YAML::Emitter out;
  out << YAML::Flow << list;
  return out.c_str();
}

// Sets one option from its node in the file.
struct FromYaml {
  const YAML::Node& root;
  const std::string& file;

  template <class Value>
  void operator()(const char* name, Value& value, const OptionInfo& info) const {
    const YAML::Node node = root[name];
    if (!node.IsDefined()) return;
    if constexpr (std::is_same_v<Value, bool>) {
      value = yamlAs<bool>(node, name, file, "true or false");
    } else {
      const std::string text = node.IsSequence() && std::is_same_v<Value, std::string>
                                   ? flowText(node)
                                   : yamlAs<std::string>(node, name, file, "a single value");
      try {
        parseOption(name, text, info, value);
      } catch (const InputError& error) {
        throw yamlError(node, file, error.what());
      }
    }
  }
};

// The first known parameter in a map, "" where there is none.
std::string knownBelow(const YAML::Node& node, const std::vector<std::string>& known) {
  if (!node.IsMap()) return "";
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const std::string& name) { return node[name].IsDefined(); });
  return found == known.end() ? "" : *found;
}

void warnAboutUnknown(const YAML::Node& root, const std::string& file) {
  const std::vector<std::string> known = optionNames<PathPlannerNodeOptions>();
  for (const auto& entry : root) {
    const auto name = yamlAs<std::string>(entry.first, "a key", file, "the name of a parameter");
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::cerr << "warning: "
              << yamlError(entry.first, file, "unknown parameter " + name + " is not used").what()
              << meantText(name, knownBelow(entry.second, known), known) << '\n';
  }
}

}  // namespace

void readNodeConfig(const std::string& file, PlannerOptions& options) {
  const YAML::Node root = loadYamlFile(file);
  if (root.IsNull()) return;
  if (!root.IsMap()) throw yamlError(root, file, "holds no parameters: name: value a line");
  warnAboutUnknown(root, file);
  PlannerOptions read = options;
  visitOptions(read, FromYaml{root, file});
  options = read;
}

}  // namespace grid_path_planner::command_line
