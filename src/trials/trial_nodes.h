// What the readers of trial files share, with errors that name file and line.
#pragma once

#include <string>
#include <vector>

#include "study/file/study_nodes.h"
#include "trials/trial_study.h"

namespace grid_path_planner::trials {

class TrialNodes : public study::StudyNodes {
 public:
  using StudyNodes::StudyNodes;

  struct Limits {
    double least, most;
  };

  // Under `key`, where it is there.
  void readNumber(const YAML::Node& parent, const char* key, Limits limits, double& value) const;
  std::vector<double> numbersOf(const YAML::Node& node, const std::string& name,
                                std::size_t count) const;

  // start_deviation, default_covariance, published_covariance and the rows of published.
  void readStated(const YAML::Node& root, TrialSettings& settings) const;

  // A mapping of options; `set` takes a name and a text, and returns whether there is such an option.
  using SetOption = std::function<bool(const std::string& name, const std::string& text)>;
  void readOptions(const YAML::Node& parent, const std::string& key, const SetOption& set) const;

 private:
  void readDeviation(const YAML::Node& root, const std::string& key, StatedDeviation& value) const;
  void readPublishedRows(const YAML::Node& node, TrialSettings& settings) const;
};

}  // namespace grid_path_planner::trials
