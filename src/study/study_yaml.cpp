#include "study/study_yaml.h"

namespace grid_path_planner::study {

using base::describeYaml, base::yamlAs, base::yamlError;

namespace {

std::string listOfNames(const std::set<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

void checkKeys(const YAML::Node& node, const std::string& what, const std::string& file,
               const std::set<std::string>& known) {
  if (!node.IsMap())
    throw yamlError(node, file, what + " must be a mapping, got " + describeYaml(node));
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const auto key = yamlAs<std::string>(entry.first, "a key", file, "a name");
    if (known.count(key) == 0)
      throw yamlError(entry.first, file,
                      what + " has no '" + key + "'; it has " + listOfNames(known));
    if (!seen.insert(key).second)
      throw yamlError(entry.first, file, what + " has '" + key + "' twice");
  }
}

}  // namespace grid_path_planner::study
