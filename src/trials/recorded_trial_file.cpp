#include "trials/recorded_trial.h"

namespace grid_path_planner::trials {

using base::yamlAs, base::yamlHas, base::yamlNode, base::yamlValue, base::yamlValueOr;
using localization::Mounting, localization::NavigationTopics;

namespace {

constexpr TrialNodes::Limits kSettle = {0.0, 86400.0};

NavigationTopics topicsOf(const YAML::Node& node, const std::string& file) {
  NavigationTopics topics;
  const std::map<std::string, std::string*> names = {
      {"imu", &topics.imu},           {"dvl", &topics.dvl},   {"depth", &topics.depth},
      {"pressure", &topics.pressure}, {"usbl", &topics.usbl}, {"marker", &topics.marker},
      {"truth", &topics.truth}};
  std::set<std::string> known;
  for (const auto& name : names) known.insert(name.first);
  base::checkKeys(node, "topics", file, known);
  for (const auto& [name, topic] : names)
    *topic = yamlValueOr<std::string>(node, name, file, "a topic", *topic);
  return topics;
}

// x, y, z in m, roll, pitch, yaw in rad.
Mounting mountingFrom(const std::vector<double>& place) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return {{place[0], place[1], place[2]},
          AngleAxisd(place[5], Vector3d::UnitZ()) * AngleAxisd(place[4], Vector3d::UnitY()) *
              AngleAxisd(place[3], Vector3d::UnitX())};
}

std::map<std::string, Mounting> framesOf(const YAML::Node& node, const TrialNodes& nodes) {
  if (!node.IsMap()) throw base::yamlError(node, nodes.file(), "frames must be a mapping");
  std::map<std::string, Mounting> frames;
  std::set<std::string> names;
  for (const auto& entry : node) {
    const auto name = yamlAs<std::string>(entry.first, "a frame", nodes.file(), "a name");
    nodes.refuseTwice(entry.first, names, name, "frames");
    frames[name] = mountingFrom(nodes.numbersOf(entry.second, name, 6));
  }
  return frames;
}

}  // namespace

bool isRecordedTrial(const std::string& file) {
  const YAML::Node root = base::loadYamlFile(file);
  return root.IsMap() && root["bag"];
}

RecordedTrial readRecordedTrialFile(const std::string& file, const TrialNodes::SetOption& set) {
  const YAML::Node root = base::loadYamlFile(file);
  base::checkKeys(root, "the trial", file,
                  {"title", "bag", "topics", "truth_frame", "frames", "localizer", "settle",
                   "start_deviation", "default_covariance", "published_covariance", "published"});
  const TrialNodes nodes(file);
  RecordedTrial trial;
  trial.file = file;
  trial.title = yamlValue<std::string>(root, "title", file, "a sentence");
  trial.bag = nodes.resolved(yamlNode(root, "bag", file, "a bag"), "bag");
  if (yamlHas(root, "topics", file)) trial.topics = topicsOf(root["topics"], file);
  trial.truth_frame = yamlValueOr<std::string>(root, "truth_frame", file, "a frame", "");
  if (yamlHas(root, "frames", file)) trial.frames = framesOf(root["frames"], nodes);
  nodes.readOptions(root, "localizer", set);
  nodes.readNumber(root, "settle", kSettle, trial.settle);
  nodes.readStated(root, trial);
  return trial;
}

}  // namespace grid_path_planner::trials
