#include "study/file/study_nodes.h"

namespace grid_path_planner::study {

using base::describeYaml, base::InputError, base::yamlAs, base::yamlError;

YAML::Node StudyNodes::entriesOf(const YAML::Node& node, const std::string& name) const {
  if (!node.IsSequence())
    throw yamlError(node, file_, name + " must be a list, got " + describeYaml(node));
  if (node.size() == 0) throw yamlError(node, file_, name + " is an empty list");
  return node;
}

int StudyNodes::wholeNumber(const YAML::Node& node, const std::string& name, int least,
                            int most) const {
  const std::string expected =
      "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  const int number = yamlAs<int>(node, name, file_, expected);
  if (number < least || number > most)
    throw yamlError(node, file_, name + " must be " + expected + ", got " + describeYaml(node));
  return number;
}

std::string StudyNodes::resolved(const YAML::Node& node, const std::string& name) const {
  const auto named = yamlAs<std::string>(node, name, file_, "a file name");
  const std::size_t slash = file_.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : file_.substr(0, slash + 1);
  return !named.empty() && named.front() == '/' ? named : folder + named;
}

void StudyNodes::refuseSameFile(const YAML::Node& node, std::set<std::string>& seen,
                                const std::string& file) const {
  if (!seen.insert(file).second)
    throw yamlError(node, file_, describeYaml(node) + " has a file of another one: " + file);
}

void StudyNodes::atLine(const YAML::Node& node, const std::function<void()>& parse) const {
  try {
    parse();
  } catch (const InputError& error) {
    throw yamlError(node, file_, error.what());
  }
}

}  // namespace grid_path_planner::study
