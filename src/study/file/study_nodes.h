// What the readers of a study file share: nodes as lists, numbers, names and choices, with errors that
// name file and line.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/base/yaml_file.h"

namespace grid_path_planner::study {

class StudyNodes {
 public:
  explicit StudyNodes(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }

  // A list with at least one entry.
  YAML::Node entriesOf(const YAML::Node& node, const std::string& name) const;
  int wholeNumber(const YAML::Node& node, const std::string& name, int least, int most) const;
  // A file name, relative to the study file's folder.
  std::string resolved(const YAML::Node& node, const std::string& name) const;
  // Runs `parse`; an InputError of it gets file and line.
  void atLine(const YAML::Node& node, const std::function<void()>& parse) const;

  template <class T>
  void refuseTwice(const YAML::Node& node, std::set<T>& seen, const T& value,
                   const std::string& name) const {
    if (!seen.insert(value).second)
      throw base::yamlError(node, file_, name + " names " + base::describeYaml(node) + " twice");
  }

  // Of a name of which a file is made.
  void refuseSameFile(const YAML::Node& node, std::set<std::string>& seen,
                      const std::string& file) const;

  // The choices of an enum under `key`, or `fallback` alone.
  template <class E>
  std::vector<E> choicesUnder(const YAML::Node& root, const std::string& key, E fallback) const {
    if (!root[key]) return {fallback};
    std::vector<E> choices;
    std::set<E> seen;
    for (const YAML::Node& entry : entriesOf(root[key], key)) {
      const auto text = base::yamlAs<std::string>(entry, key, file_, "a name");
      E choice = fallback;
      atLine(entry, [&] { choice = base::choiceFromName<E>(key, text); });
      refuseTwice(entry, seen, choice, key);
      choices.push_back(choice);
    }
    return choices;
  }

 private:
  std::string file_;
};

}  // namespace grid_path_planner::study
