#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/base/yaml_file.h"
#include "study/file/figures_reader.h"
#include "study/file/query_reader.h"
#include "study/file/study_nodes.h"
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
// Few letters may ask for many, by lists that are multiplied and by YAML's aliases.
constexpr std::size_t kMostSettings = 100000, kMostVariants = 10000;
constexpr std::size_t kBytesOfSetting = 1000, kBytesOfVariant = 1000, kBytesOfMap = 500,
                      kBytesOfPair = sizeof(CellPair);

std::string weightsLabel(const Weights& weights) {
  return std::to_string(weights.free) + '/' + std::to_string(weights.unknown) + '/' +
         std::to_string(weights.occupied);
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
  explicit StudyReader(const std::string& file) : file_(file), nodes_(file) {
    study_.base.costmap.outside = costmap::Outside::FREE;  // comparisons use all of their maps
    study_.base.smooth = false;                            // they are of the searches' own paths
  }

  Study read() {
    limits_.start();
    const YAML::Node root = parseYaml(readWholeFile(file_, kLargestYaml, limits_), file_, limits_);
    checkKeys(root, "the study", file_,
              {"title", "maps", "planners", "heuristics", "tie_breaks", "kernels", "kernel_rules",
               "borders", "weights", "options", "queries", "repeats", "published"});
    study_.file = file_;
    study_.title = yamlValueOr<std::string>(root, "title", file_, "a sentence", stemOf(file_));
    if (root["options"]) {
      readOptions(root["options"]);
      refuseSaidTwice(root);
    }
    if (root["repeats"])
      study_.repeats = nodes_.wholeNumber(root["repeats"], "repeats", 1, kMostRepeats);
    if (root["queries"]) common_queries_ = readQueries(root["queries"], nodes_, limits_);
    readMaps(yamlNode(root, "maps", file_, "a list of map files"));
    readVariants(root);
    readSettings(root);
    if (root["published"]) study_.published = readFigures(root["published"], nodes_);
    return study_;
  }

 private:
  void readOptions(const YAML::Node& node) {
    if (!node.IsMap())
      throw yamlError(node, file_, "options must be a mapping, got " + describeYaml(node));
    for (const auto& entry : node) readOption(entry.first, entry.second);
  }

  void readOption(const YAML::Node& name_node, const YAML::Node& value_node) {
    const auto key = yamlAs<std::string>(name_node, "an option", file_, "a name");
    const auto text = yamlAs<std::string>(value_node, key, file_, "a value");
    if (key == "tie_break") {
      nodes_.atLine(value_node, [&] { tie_break_ = choiceFromName<StudyTieBreak>(key, text); });
      study_.base.search.tie_break = orderOf(tie_break_);
      return;
    }
    bool known = false;
    visitOptions(study_.base, [&](const char* name, auto& value, const OptionInfo& info) {
      if (key != name) return;
      known = true;
      nodes_.atLine(value_node, [&] { parseOption(key, text, info, value); });
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

  StudyMap mapOf(const YAML::Node& entry) const {
    StudyMap map;
    map.queries = common_queries_;
    if (!entry.IsMap()) {
      map.file = nodes_.resolved(entry, "a map");
      map.name = stemOf(map.file);
      return map;
    }
    checkKeys(entry, "a map", file_, {"file", "name", "queries"});
    map.file = nodes_.resolved(yamlNode(entry, "file", file_, "a map file"), "file");
    map.name = yamlValueOr<std::string>(entry, "name", file_, "a name", stemOf(map.file));
    if (entry["queries"]) map.queries = readQueries(entry["queries"], nodes_, limits_);
    return map;
  }

  void readMaps(const YAML::Node& node) {
    std::set<std::string> names;
    for (const YAML::Node& entry : nodes_.entriesOf(node, "maps")) {
      const StudyMap map = mapOf(entry);
      if (map.queries.empty())
        throw yamlError(entry, file_, "map '" + map.name + "' has no queries");
      nodes_.refuseTwice(entry, names, map.name, "maps");
      limits_.goOn(file_);
      limits_.take(file_, kBytesOfMap + map.queries.pairs.size() * kBytesOfPair);
      study_.maps.push_back(map);
    }
  }

  void addVariant(const YAML::Node& node, const StudyVariant& variant) {
    nodes_.atLine(
        node, [&] { makeStudyPlanner(variant.planner, variant.search, variant.published_cross); });
    if (study_.variants.size() == kMostVariants)
      throw yamlError(node, file_,
                      "the study has more than " + std::to_string(kMostVariants) + " planners");
    limits_.goOn(file_);
    limits_.take(file_, kBytesOfVariant);
    study_.variants.push_back(variant);
  }

  // The published tie-break replaces the heuristic of the published programs, which have no other,
  // and no other planner has it.
  void addVariants(const YAML::Node& node, const std::string& planner,
                   const std::vector<Heuristic>& heuristics,
                   std::vector<StudyTieBreak> tie_breaks) {
    const auto end = std::remove_if(tie_breaks.begin(), tie_breaks.end(), published);
    const bool cross = end != tie_breaks.end();
    tie_breaks.erase(end, tie_breaks.end());
    if (isPublishedAStar(planner) && tie_breaks.size() > 1) tie_breaks.resize(1);
    for (const Heuristic heuristic : heuristics)
      for (const StudyTieBreak tie_break : tie_breaks) {
        SearchOptions search = study_.base.search;
        search.heuristic = heuristic;
        search.tie_break = orderOf(tie_break);
        addVariant(node,
                   {planner + ' ' + choiceName(heuristic) +
                        (tie_breaks.size() > 1 ? std::string(", ") + choiceName(tie_break) : ""),
                    planner, search, false});
      }
    if (cross && (isPublishedAStar(planner) || tie_breaks.empty()))
      addVariant(node, {planner + " cross_product_published", planner, study_.base.search, true});
  }

  void readVariants(const YAML::Node& root) {
    const auto heuristics = nodes_.choicesUnder(root, "heuristics", study_.base.search.heuristic);
    const auto tie_breaks = nodes_.choicesUnder(root, "tie_breaks", tie_break_);
    std::set<std::string> seen;
    for (const YAML::Node& entry :
         nodes_.entriesOf(yamlNode(root, "planners", file_, "a list of planners"), "planners")) {
      const auto planner = yamlAs<std::string>(entry, "planners", file_, "a name");
      nodes_.refuseTwice(entry, seen, planner, "planners");
      bool guided = false;
      nodes_.atLine(entry, [&] { guided = guidedInStudies(planner); });
      if (guided)
        addVariants(entry, planner, heuristics, tie_breaks);
      else
        addVariant(entry, {planner, planner, study_.base.search, false});
    }
  }

  std::vector<int> kernelsOf(const YAML::Node& root) const {
    if (!root["kernels"]) return {study_.base.costmap.kernel};
    std::vector<int> kernels;
    std::set<int> seen;
    for (const YAML::Node& entry : nodes_.entriesOf(root["kernels"], "kernels")) {
      kernels.push_back(nodes_.wholeNumber(entry, "a kernel", 1, 1024));
      nodes_.refuseTwice(entry, seen, kernels.back(), "kernels");
    }
    return kernels;
  }

  std::vector<Weights> weightsOf(const YAML::Node& root) const {
    const CostmapOptions& costmap = study_.base.costmap;
    if (!root["weights"])
      return {{costmap.free_weight, costmap.unknown_weight, costmap.occupied_weight}};
    std::vector<Weights> weights;
    std::set<std::string> seen;
    for (const YAML::Node& entry : nodes_.entriesOf(root["weights"], "weights")) {
      if (!entry.IsSequence() || entry.size() != 3)
        throw yamlError(entry, file_,
                        "weights must be [free, unknown, occupied], got " + describeYaml(entry));
      const auto weight = [&](int i) { return nodes_.wholeNumber(entry[i], "a weight", 1, 65535); };
      weights.push_back({weight(0), weight(1), weight(2)});
      nodes_.refuseTwice(entry, seen, weightsLabel(weights.back()), "weights");
    }
    return weights;
  }

  void addSetting(const YAML::Node& root, std::size_t map, int kernel, KernelRule rule,
                  Border border, const Weights& weights) {
    StudySetting setting;
    setting.map = map;
    setting.border = border;
    setting.weights = weightsLabel(weights);
    setting.costmap = study_.base.costmap;
    setting.costmap.kernel = kernel;
    setting.costmap.kernel_rule = rule;
    setting.costmap.free_weight = weights.free;
    setting.costmap.unknown_weight = weights.unknown;
    setting.costmap.occupied_weight = weights.occupied;
    setting.label = study_.maps[map].name + ", kernel " + std::to_string(kernel) + ' ' +
                    choiceName(rule) + (border == Border::UNFILLED ? ", border unfilled" : "") +
                    ", weights " + setting.weights;
    nodes_.atLine(root, [&] { checkCostmapOptions(setting.costmap); });
    study_.settings.push_back(setting);
  }

  void readSettings(const YAML::Node& root) {
    const std::vector<int> kernels = kernelsOf(root);
    const auto rules = nodes_.choicesUnder(root, "kernel_rules", study_.base.costmap.kernel_rule);
    const auto borders = nodes_.choicesUnder(root, "borders", Border::FILLED);
    const std::vector<Weights> weights = weightsOf(root);
    const std::size_t most = kMostSettings / study_.maps.size();
    const std::size_t problems = kernels.size() * rules.size() * borders.size();
    if (problems > most || weights.size() > most || problems * weights.size() > most)
      throw yamlError(root, file_,
                      "the study has more than " + std::to_string(kMostSettings) +
                          " combinations of maps, kernels, rules, borders and weights");
    limits_.take(file_, kBytesOfSetting * study_.maps.size() * problems * weights.size());
    for (std::size_t map = 0; map < study_.maps.size(); ++map)
      for (const int kernel : kernels)
        for (const KernelRule rule : rules)
          for (const Border border : borders)
            for (const Weights& each : weights) addSetting(root, map, kernel, rule, border, each);
  }

  std::string file_;
  StudyNodes nodes_;
  base::ReadLimits limits_;
  Study study_;
  QuerySource common_queries_;
  StudyTieBreak tie_break_ = StudyTieBreak::NONE;  // of the options
};

}  // namespace

const std::vector<std::pair<const char*, Border>>& choicesOf(Border) {
  static const std::vector<std::pair<const char*, Border>> choices = {
      {"filled", Border::FILLED}, {"unfilled", Border::UNFILLED}};
  return choices;
}

Study readStudyFile(const std::string& file) {
  return base::readWithin(file, {},
                          [&](const base::ReadLimits&) { return StudyReader(file).read(); });
}

}  // namespace grid_path_planner::study
