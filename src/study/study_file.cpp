#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/base/yaml_file.h"
#include "study/study.h"
#include "study/study_planners.h"
#include "study/study_yaml.h"

namespace grid_path_planner::study {

using base::choiceFromName, base::choiceName, base::describeYaml, base::InputError,
    base::kLargestYaml, base::OptionInfo, base::parseYaml, base::readWholeFile, base::parseOption,
    base::yamlAs, base::yamlError, base::yamlNode, base::yamlValue, base::yamlValueOr;
using costmap::checkCostmapOptions, costmap::CostmapOptions, costmap::KernelRule;
using grid::Cell;
using planners::Heuristic, planners::SearchOptions;

namespace {

constexpr int kMostRepeats = 1000;
constexpr int kMostQueries = 1000000;
// Few letters may ask for many, by lists that are multiplied and by YAML's aliases.
constexpr std::size_t kMostSettings = 100000, kMostVariants = 10000;
constexpr std::size_t kBytesOfSetting = 1000, kBytesOfVariant = 1000, kBytesOfMap = 500,
                      kBytesOfPair = 2 * sizeof(Cell);

std::string weightsLabel(const Weights& weights) {
  return std::to_string(weights.free) + '/' + std::to_string(weights.unknown) + '/' +
         std::to_string(weights.occupied);
}

std::string folderOf(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? "" : file.substr(0, slash + 1);
}

bool published(StudyTieBreak tie_break) {
  return tie_break == StudyTieBreak::CROSS_PRODUCT_PUBLISHED;
}

std::string stemOf(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  const std::string base = slash == std::string::npos ? file : file.substr(slash + 1);
  return base.substr(0, base.rfind('.'));
}

// Reads one study file; every method reads a node of it and reports errors with its line.
class StudyReader {
 public:
  explicit StudyReader(const std::string& file) : file_(file) {
    study_.base.costmap.outside = costmap::Outside::FREE;  // comparisons use all of their maps
  }

  Study read() {
    limits_.start();
    const YAML::Node root = parseYaml(readWholeFile(file_, kLargestYaml, limits_), file_, limits_);
    checkKeys(root, "the study", file_,
              {"title", "maps", "planners", "heuristics", "tie_breaks", "kernels", "kernel_rules",
               "weights", "options", "queries", "repeats", "published"});
    study_.file = file_;
    study_.title = yamlValueOr<std::string>(root, "title", file_, "a sentence", stemOf(file_));
    if (root["options"]) {
      readOptions(root["options"]);
      refuseSaidTwice(root);
    }
    if (root["repeats"]) study_.repeats = wholeNumber(root["repeats"], "repeats", 1, kMostRepeats);
    if (root["queries"]) common_queries_ = queriesOf(root["queries"]);
    readMaps(yamlNode(root, "maps", file_, "a list of map files"));
    readVariants(root);
    readSettings(root);
    if (root["published"]) readPublished(root["published"]);
    return study_;
  }

 private:
  // A list with at least one entry.
  YAML::Node entriesOf(const YAML::Node& node, const std::string& name) const {
    if (!node.IsSequence())
      throw yamlError(node, file_, name + " must be a list, got " + describeYaml(node));
    if (node.size() == 0) throw yamlError(node, file_, name + " is an empty list");
    return node;
  }

  int wholeNumber(const YAML::Node& node, const std::string& name, int least, int most) const {
    const std::string expected =
        "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
    const int number = yamlAs<int>(node, name, file_, expected);
    if (number < least || number > most)
      throw yamlError(node, file_, name + " must be " + expected + ", got " + describeYaml(node));
    return number;
  }

  std::string resolved(const YAML::Node& node, const std::string& name) const {
    const auto named = yamlAs<std::string>(node, name, file_, "a file name");
    return !named.empty() && named.front() == '/' ? named : folderOf(file_) + named;
  }

  template <class T>
  void refuseTwice(const YAML::Node& node, std::set<T>& seen, const T& value,
                   const std::string& name) const {
    if (!seen.insert(value).second)
      throw yamlError(node, file_, name + " names " + describeYaml(node) + " twice");
  }

  // Runs `parse`; an InputError of it gets file and line.
  void atLine(const YAML::Node& node, const std::function<void()>& parse) const {
    try {
      parse();
    } catch (const InputError& error) {
      throw yamlError(node, file_, error.what());
    }
  }

  void readOptions(const YAML::Node& node) {
    if (!node.IsMap())
      throw yamlError(node, file_, "options must be a mapping, got " + describeYaml(node));
    for (const auto& entry : node) readOption(entry.first, entry.second);
  }

  void readOption(const YAML::Node& name_node, const YAML::Node& value_node) {
    const auto key = yamlAs<std::string>(name_node, "an option", file_, "a name");
    const auto text = yamlAs<std::string>(value_node, key, file_, "a value");
    if (key == "tie_break") {
      atLine(value_node, [&] { tie_break_ = choiceFromName<StudyTieBreak>(key, text); });
      study_.base.search.tie_break = orderOf(tie_break_);
      return;
    }
    bool known = false;
    visitOptions(study_.base, [&](const char* name, auto& value, const OptionInfo& info) {
      if (key != name) return;
      known = true;
      atLine(value_node, [&] { parseOption(key, text, info, value); });
    });
    if (!known)
      throw yamlError(name_node, file_, "there is no option '" + key + "' of path_planner");
  }

  // An option that a list of the study replaces would have no effect.
  void refuseSaidTwice(const YAML::Node& root) const {
    static const std::map<std::string, std::string> lists = {
        {"planner", "planners"},       {"heuristic", "heuristics"},     {"tie_break", "tie_breaks"},
        {"kernel", "kernels"},         {"kernel_rule", "kernel_rules"}, {"free_weight", "weights"},
        {"unknown_weight", "weights"}, {"occupied_weight", "weights"}};
    for (const auto& entry : root["options"]) {
      const auto list = lists.find(entry.first.Scalar());
      if (list != lists.end() && root[list->second])
        throw yamlError(entry.first, file_,
                        list->first + " stands in '" + list->second + "' already");
    }
  }

  Cell cellOf(const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() != 2)
      throw yamlError(node, file_, "a cell must be [column, row], got " + describeYaml(node));
    constexpr int kLargest = 1 << 19;
    return {wholeNumber(node[0], "column", 0, kLargest), wholeNumber(node[1], "row", 0, kLargest)};
  }

  CellPair pairOf(const YAML::Node& node) const {
    if (!node.IsSequence() || node.size() != 2)
      throw yamlError(node, file_,
                      "a pair must be [[column, row], [column, row]], got " + describeYaml(node));
    return {cellOf(node[0]), cellOf(node[1])};
  }

  void readRandom(const YAML::Node& node, QuerySource& queries) const {
    checkKeys(node, "random", file_, {"count", "seed"});
    queries.random_count =
        wholeNumber(yamlNode(node, "count", file_, "how many"), "count", 1, kMostQueries);
    if (node["seed"])
      queries.random_seed =
          static_cast<std::uint32_t>(wholeNumber(node["seed"], "seed", 0, 2147483647));
  }

  void readScenario(const YAML::Node& node, QuerySource& queries) const {
    if (node.IsScalar()) {
      queries.scenario = resolved(node, "scenario");
      return;
    }
    checkKeys(node, "scenario", file_, {"file", "limit"});
    queries.scenario = resolved(yamlNode(node, "file", file_, "a .scen file"), "file");
    if (node["limit"])
      queries.scenario_limit = wholeNumber(node["limit"], "limit", 1, kMostQueries);
  }

  void readPairs(const YAML::Node& node, QuerySource& queries) const {
    limits_.check(file_, 2 * kBytesOfPair * entriesOf(node, "pairs").size());
    base::ReadPoll poll(limits_, file_, 16);
    for (const YAML::Node& pair : node) {
      poll();
      queries.pairs.push_back(pairOf(pair));
    }
  }

  QuerySource queriesOf(const YAML::Node& node) const {
    checkKeys(node, "queries", file_, {"pairs", "random", "scenario"});
    QuerySource queries;
    if (node["pairs"]) readPairs(node["pairs"], queries);
    if (node["random"]) readRandom(node["random"], queries);
    if (node["scenario"]) readScenario(node["scenario"], queries);
    if (queries.empty()) throw yamlError(node, file_, "queries names none");
    return queries;
  }

  StudyMap mapOf(const YAML::Node& entry) const {
    StudyMap map;
    map.queries = common_queries_;
    if (!entry.IsMap()) {
      map.file = resolved(entry, "a map");
      map.name = stemOf(map.file);
      return map;
    }
    checkKeys(entry, "a map", file_, {"file", "name", "queries"});
    map.file = resolved(yamlNode(entry, "file", file_, "a map file"), "file");
    map.name = yamlValueOr<std::string>(entry, "name", file_, "a name", stemOf(map.file));
    if (entry["queries"]) map.queries = queriesOf(entry["queries"]);
    return map;
  }

  void readMaps(const YAML::Node& node) {
    std::set<std::string> names;
    for (const YAML::Node& entry : entriesOf(node, "maps")) {
      const StudyMap map = mapOf(entry);
      if (map.queries.empty())
        throw yamlError(entry, file_, "map '" + map.name + "' has no queries");
      refuseTwice(entry, names, map.name, "maps");
      limits_.goOn(file_);
      limits_.take(file_, kBytesOfMap + map.queries.pairs.size() * kBytesOfPair);
      study_.maps.push_back(map);
    }
  }

  // The choices of an enum under `key`, or `fallback` alone.
  template <class E>
  std::vector<E> choicesUnder(const YAML::Node& root, const std::string& key, E fallback) const {
    if (!root[key]) return {fallback};
    std::vector<E> choices;
    std::set<E> seen;
    for (const YAML::Node& entry : entriesOf(root[key], key)) {
      const auto text = yamlAs<std::string>(entry, key, file_, "a name");
      E choice = fallback;
      atLine(entry, [&] { choice = choiceFromName<E>(key, text); });
      refuseTwice(entry, seen, choice, key);
      choices.push_back(choice);
    }
    return choices;
  }

  void addVariant(const YAML::Node& node, const StudyVariant& variant) {
    atLine(node,
           [&] { makeStudyPlanner(variant.planner, variant.search, variant.published_cross); });
    if (study_.variants.size() == kMostVariants)
      throw yamlError(node, file_,
                      "the study has more than " + std::to_string(kMostVariants) + " planners");
    limits_.goOn(file_);
    limits_.take(file_, kBytesOfVariant);
    study_.variants.push_back(variant);
  }

  void addVariants(const YAML::Node& node, const std::string& planner,
                   const std::vector<Heuristic>& heuristics,
                   const std::vector<StudyTieBreak>& tie_breaks) {
    for (const Heuristic heuristic : heuristics)
      for (const StudyTieBreak tie_break : tie_breaks) {
        SearchOptions search = study_.base.search;
        search.heuristic = heuristic;
        search.tie_break = orderOf(tie_break);
        addVariant(node,
                   {planner + ' ' + choiceName(heuristic) +
                        (tie_breaks.size() > 1 ? std::string(", ") + choiceName(tie_break) : ""),
                    planner, search, published(tie_break)});
      }
  }

  void readVariants(const YAML::Node& root) {
    const auto heuristics = choicesUnder(root, "heuristics", study_.base.search.heuristic);
    const auto tie_breaks = choicesUnder(root, "tie_breaks", tie_break_);
    std::set<std::string> seen;
    for (const YAML::Node& entry :
         entriesOf(yamlNode(root, "planners", file_, "a list of planners"), "planners")) {
      const auto planner = yamlAs<std::string>(entry, "planners", file_, "a name");
      refuseTwice(entry, seen, planner, "planners");
      bool guided = false;
      atLine(entry, [&] { guided = guidedInStudies(planner); });
      if (guided)
        addVariants(entry, planner, heuristics, tie_breaks);
      else
        addVariant(entry, {planner, planner, study_.base.search, published(tie_break_)});
    }
  }

  std::vector<int> kernelsOf(const YAML::Node& root) const {
    if (!root["kernels"]) return {study_.base.costmap.kernel};
    std::vector<int> kernels;
    std::set<int> seen;
    for (const YAML::Node& entry : entriesOf(root["kernels"], "kernels")) {
      kernels.push_back(wholeNumber(entry, "a kernel", 1, 1024));
      refuseTwice(entry, seen, kernels.back(), "kernels");
    }
    return kernels;
  }

  std::vector<Weights> weightsOf(const YAML::Node& root) const {
    const CostmapOptions& costmap = study_.base.costmap;
    if (!root["weights"])
      return {{costmap.free_weight, costmap.unknown_weight, costmap.occupied_weight}};
    std::vector<Weights> weights;
    std::set<std::string> seen;
    for (const YAML::Node& entry : entriesOf(root["weights"], "weights")) {
      if (!entry.IsSequence() || entry.size() != 3)
        throw yamlError(entry, file_,
                        "weights must be [free, unknown, occupied], got " + describeYaml(entry));
      const auto weight = [&](int i) { return wholeNumber(entry[i], "a weight", 1, 65535); };
      weights.push_back({weight(0), weight(1), weight(2)});
      refuseTwice(entry, seen, weightsLabel(weights.back()), "weights");
    }
    return weights;
  }

  void addSetting(const YAML::Node& root, std::size_t map, int kernel, KernelRule rule,
                  const Weights& weights) {
    StudySetting setting;
    setting.map = map;
    setting.weights = weightsLabel(weights);
    setting.costmap = study_.base.costmap;
    setting.costmap.kernel = kernel;
    setting.costmap.kernel_rule = rule;
    setting.costmap.free_weight = weights.free;
    setting.costmap.unknown_weight = weights.unknown;
    setting.costmap.occupied_weight = weights.occupied;
    setting.label = study_.maps[map].name + ", kernel " + std::to_string(kernel) + ' ' +
                    choiceName(rule) + ", weights " + setting.weights;
    atLine(root, [&] { checkCostmapOptions(setting.costmap); });
    study_.settings.push_back(setting);
  }

  void readSettings(const YAML::Node& root) {
    const std::vector<int> kernels = kernelsOf(root);
    const auto rules = choicesUnder(root, "kernel_rules", study_.base.costmap.kernel_rule);
    const std::vector<Weights> weights = weightsOf(root);
    const std::size_t most = kMostSettings / study_.maps.size();
    if (kernels.size() * rules.size() > most || weights.size() > most ||
        kernels.size() * rules.size() * weights.size() > most)
      throw yamlError(root, file_,
                      "the study has more than " + std::to_string(kMostSettings) +
                          " combinations of maps, kernels, rules and weights");
    limits_.take(file_, kBytesOfSetting * study_.maps.size() * kernels.size() * rules.size() *
                            weights.size());
    for (std::size_t map = 0; map < study_.maps.size(); ++map)
      for (const int kernel : kernels)
        for (const KernelRule rule : rules)
          for (const Weights& each : weights) addSetting(root, map, kernel, rule, each);
  }

  void readPublished(const YAML::Node& node) {
    checkKeys(node, "published", file_,
              {"source", "time_s", "expanded_ratio", "shortest_percent", "alone_percent",
               "crossing", "dijkstra_not_optimal"});
    PublishedFigures& published = study_.published;
    published.source = yamlValue<std::string>(node, "source", file_, "who published them");
    if (node["time_s"]) {
      if (!node["time_s"].IsMap())
        throw yamlError(node["time_s"], file_, "time_s must be a mapping");
      for (const auto& entry : node["time_s"])
        published.time_s[yamlAs<std::string>(entry.first, "time_s", file_, "a variant")] =
            mappingOf<int, double>(entry.second, "time_s", file_);
    }
    published.expanded_ratio = yamlValueOr<double>(node, "expanded_ratio", file_, "a number", 0.0);
    if (node["shortest_percent"])
      published.shortest_percent =
          mappingOf<std::string, double>(node["shortest_percent"], "shortest_percent", file_);
    if (node["alone_percent"])
      published.alone_percent =
          mappingOf<std::string, double>(node["alone_percent"], "alone_percent", file_);
    if (node["crossing"])
      published.crossing = mappingOf<std::string, std::string>(node["crossing"], "crossing", file_);
    published.dijkstra_not_optimal =
        yamlValueOr<bool>(node, "dijkstra_not_optimal", file_, "true or false", false);
  }

  std::string file_;
  base::ReadLimits limits_;
  Study study_;
  QuerySource common_queries_;
  StudyTieBreak tie_break_ = StudyTieBreak::NONE;  // of the options
};

}  // namespace

Study readStudyFile(const std::string& file) {
  return base::readWithin(file, {},
                          [&](const base::ReadLimits&) { return StudyReader(file).read(); });
}

}  // namespace grid_path_planner::study
