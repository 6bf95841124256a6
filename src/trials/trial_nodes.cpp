#include "trials/trial_nodes.h"

#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::trials {

using base::yamlAs, base::yamlError, base::yamlHas, base::yamlNode, base::yamlValue;

void TrialNodes::readNumber(const YAML::Node& parent, const char* key, Limits limits,
                            double& value) const {
  if (!yamlHas(parent, key, file())) return;
  value = yamlValue<double>(parent, key, file(), "a number");
  if (value < limits.least || value > limits.most)
    throw yamlError(parent[key], file(),
                    std::string(key) + " must be from " + base::decimalText(limits.least) + " to " +
                        base::decimalText(limits.most));
}

std::vector<double> TrialNodes::numbersOf(const YAML::Node& node, const std::string& name,
                                          std::size_t count) const {
  std::vector<double> numbers;
  for (const YAML::Node& entry : entriesOf(node, name))
    numbers.push_back(yamlAs<double>(entry, name, file(), "a number"));
  if (numbers.size() != count)
    throw yamlError(node, file(), name + " must have " + std::to_string(count) + " numbers");
  return numbers;
}

void TrialNodes::readStated(const YAML::Node& root, TrialSettings& settings) const {
  readNumber(root, "start_deviation", {0.001, 100.0}, settings.start_deviation);
  readDeviation(root, "default_covariance", settings.default_covariance);
  readDeviation(root, "published_covariance", settings.published_covariance);
  if (yamlHas(root, "published", file())) readPublishedRows(root["published"], settings);
}

void TrialNodes::readDeviation(const YAML::Node& root, const std::string& key,
                               StatedDeviation& value) const {
  if (!yamlHas(root, key, file())) return;
  const auto numbers = numbersOf(root[key], key, 2);
  if (!(numbers[0] > 0.0 && numbers[1] > 0.0))
    throw yamlError(root[key], file(), key + " must be standard deviations, m and rad, above 0");
  value = {numbers[0], numbers[1]};
}

void TrialNodes::readPublishedRows(const YAML::Node& node, TrialSettings& settings) const {
  settings.published_source = yamlValue<std::string>(node, "source", file(), "a sentence");
  for (const auto& entry : yamlNode(node, "rows", file(), "a mapping of rows")) {
    const auto name = yamlAs<std::string>(entry.first, "a row", file(), "a name");
    const auto numbers = numbersOf(entry.second, name, 5);
    settings.published[name] = {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]};
  }
}

void TrialNodes::readOptions(const YAML::Node& parent, const std::string& key,
                             const SetOption& set) const {
  if (!yamlHas(parent, key, file())) return;
  if (!parent[key].IsMap()) throw yamlError(parent[key], file(), key + " must be a mapping");
  for (const auto& entry : parent[key]) {
    const auto name = yamlAs<std::string>(entry.first, "an option", file(), "a name");
    bool known = false;
    atLine(entry.second,
           [&] { known = set(name, yamlAs<std::string>(entry.second, name, file(), "a value")); });
    if (!known) throw yamlError(entry.first, file(), key + " has no option '" + name + "'");
  }
}

}  // namespace grid_path_planner::trials
