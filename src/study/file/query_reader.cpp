#include "study/file/query_reader.h"

#include "study/study_yaml.h"

namespace grid_path_planner::study {

using base::describeYaml, base::ReadLimits, base::ReadPoll, base::yamlAs, base::yamlError,
    base::yamlNode;
using grid::Cell;

namespace {

constexpr int kMostQueries = 1000000;

class QueryReader {
 public:
  QueryReader(const StudyNodes& nodes, const ReadLimits& limits) : nodes_(nodes), limits_(limits) {}

  QuerySource read(const YAML::Node& node) {
    checkKeys(node, "queries", nodes_.file(), {"pairs", "random", "scenario"});
    if (node["pairs"]) readPairs(node["pairs"]);
    if (node["random"]) readRandom(node["random"]);
    if (node["scenario"]) readScenario(node["scenario"]);
    if (queries_.empty()) throw yamlError(node, nodes_.file(), "queries names none");
    return queries_;
  }

 private:
  Cell cellOf(const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() != 2)
      throw yamlError(node, nodes_.file(),
                      "a cell must be [column, row], got " + describeYaml(node));
    constexpr int kLargest = 1 << 19;
    return {nodes_.wholeNumber(node[0], "column", 0, kLargest),
            nodes_.wholeNumber(node[1], "row", 0, kLargest)};
  }

  void addPairs(const YAML::Node& list, const std::string& group) {
    limits_.check(nodes_.file(), 2 * sizeof(CellPair) * nodes_.entriesOf(list, "pairs").size());
    ReadPoll poll(limits_, nodes_.file(), 16);
    int number = 0;
    for (const YAML::Node& node : list) {
      poll();
      if (!node.IsSequence() || node.size() != 2)
        throw yamlError(node, nodes_.file(),
                        "a pair must be [[column, row], [column, row]], got " + describeYaml(node));
      queries_.pairs.push_back({cellOf(node[0]), cellOf(node[1]), group, ++number});
    }
  }

  // A list, or lists by the name of their group.
  void readPairs(const YAML::Node& node) {
    if (!node.IsMap()) return addPairs(node, "");
    std::set<std::string> seen;
    for (const auto& entry : node) {
      const auto group = yamlAs<std::string>(entry.first, "a group", nodes_.file(), "a name");
      nodes_.refuseTwice(entry.first, seen, group, "pairs");
      addPairs(entry.second, group);
    }
    if (seen.empty()) throw yamlError(node, nodes_.file(), "pairs is empty");
  }

  void readRandom(const YAML::Node& node) {
    checkKeys(node, "random", nodes_.file(), {"count", "seed"});
    queries_.random_count = nodes_.wholeNumber(yamlNode(node, "count", nodes_.file(), "how many"),
                                               "count", 1, kMostQueries);
    if (node["seed"])
      queries_.random_seed =
          static_cast<std::uint32_t>(nodes_.wholeNumber(node["seed"], "seed", 0, 2147483647));
  }

  void readScenario(const YAML::Node& node) {
    if (node.IsScalar()) {
      queries_.scenario = nodes_.resolved(node, "scenario");
      return;
    }
    checkKeys(node, "scenario", nodes_.file(), {"file", "limit"});
    queries_.scenario =
        nodes_.resolved(yamlNode(node, "file", nodes_.file(), "a .scen file"), "file");
    if (node["limit"])
      queries_.scenario_limit = nodes_.wholeNumber(node["limit"], "limit", 1, kMostQueries);
  }

  const StudyNodes& nodes_;
  const ReadLimits& limits_;
  QuerySource queries_;
};

}  // namespace

QuerySource readQueries(const YAML::Node& node, const StudyNodes& nodes, const ReadLimits& limits) {
  return QueryReader(nodes, limits).read(node);
}

}  // namespace grid_path_planner::study
