// Mappings of a study file.
#pragma once

#include <map>
#include <string>

#include "grid_path_planner/base/yaml_file.h"

namespace grid_path_planner::study {

using base::checkKeys;

// Throws InputError with file and line where `node`, called `name`, is no mapping of a Key to a Value.
template <class Key, class Value>
std::map<Key, Value> mappingOf(const YAML::Node& node, const std::string& name,
                               const std::string& file) {
  if (!node.IsMap())
    throw base::yamlError(node, file, name + " must be a mapping, got " + base::describeYaml(node));
  std::map<Key, Value> values;
  for (const auto& entry : node)
    values[base::yamlAs<Key>(entry.first, "a key of " + name, file, "a name or number")] =
        base::yamlAs<Value>(entry.second, name, file, "a value");
  return values;
}

}  // namespace grid_path_planner::study
