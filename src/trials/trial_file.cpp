#include <algorithm>
#include <cmath>
#include <set>

#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/yaml_file.h"
#include "study/study_yaml.h"
#include "trials/sensor_tape.h"
#include "trials/track_file.h"
#include "trials/trial_nodes.h"

namespace grid_path_planner::trials {

using base::checkKeys, base::yamlError, base::yamlHas, base::yamlNode, base::yamlValue;

namespace {

constexpr int kMostSeeds = 10000;
constexpr int kMostSeed = 1000000000;

// Reads one file; every method reads a node of it and reports errors with its line.
class TrialReader {
 public:
  explicit TrialReader(const std::string& file) : file_(file), nodes_(file) {}

  TrialStudy read() {
    const YAML::Node root = base::loadYamlFile(file_);
    checkKeys(root, "the trial", file_,
              {"title",
               "world",
               "layout",
               "panel",
               "drive",
               "first_seed",
               "seeds",
               "settle",
               "fault",
               "outliers",
               "flips",
               "start_deviation",
               "current",
               "default_covariance",
               "published_covariance",
               "camera",
               "markers",
               "sensors",
               "filter",
               "error_sets",
               "published"});
    study_.file = file_;
    study_.title = yamlValue<std::string>(root, "title", file_, "a sentence");
    study_.world = nodes_.resolved(yamlNode(root, "world", file_, "an SDF file"), "world");
    study_.layout = nodes_.resolved(yamlNode(root, "layout", file_, "a layout file"), "layout");
    readPanel(yamlNode(root, "panel", file_, "x, y, z, yaw"));
    if (yamlHas(root, "drive", file_)) readDrive(root["drive"]);
    readSetting(root);
    readOptions(root, "camera", study_.camera);
    readOptions(root, "markers", study_.markers);
    readOptions(root, "filter", study_.filter);
    readOptions(root, "sensors", sensors_);
    readSets(yamlNode(root, "error_sets", file_, "a list of error sets"));
    checkFault(root["fault"] ? root["fault"] : root);
    if (yamlHas(root, "published", file_)) readPublished(root["published"]);
    return study_;
  }

 private:
  void readPanel(const YAML::Node& node) {
    const auto panel = nodes_.numbersOf(node, "panel", 4);
    study_.map_from_panel = Eigen::Translation3d(panel[0], panel[1], panel[2]) *
                            Eigen::AngleAxisd(panel[3], Eigen::Vector3d::UnitZ());
  }

  TimeWindow windowOf(const YAML::Node& node, const std::string& name) const {
    const auto times = nodes_.numbersOf(node, name, 2);
    if (!(times[0] >= 0.0 && times[0] < times[1]))
      throw yamlError(node, file_, name + " must be two times, the earlier one first");
    return {times[0], times[1]};
  }

  void readDrive(const YAML::Node& node) {
    checkKeys(node, "drive", file_,
              {"seconds", "arc", "range", "arc_period", "range_period", "rise", "rise_period",
               "rock", "rock_period", "away", "away_turn", "away_ramp"});
    DriveOptions& drive = study_.drive;
    const TrialNodes::Limits periods = {1.0, 3600.0};
    nodes_.readNumber(node, "seconds", {5.0, 3600.0}, drive.seconds);
    nodes_.readNumber(node, "arc", {0.0, 1.5}, drive.arc);
    nodes_.readNumber(node, "arc_period", periods, drive.arc_period);
    nodes_.readNumber(node, "range_period", periods, drive.range_period);
    nodes_.readNumber(node, "rise", {0.0, 10.0}, drive.rise);
    nodes_.readNumber(node, "rise_period", periods, drive.rise_period);
    nodes_.readNumber(node, "rock", {0.0, 0.5}, drive.rock);
    nodes_.readNumber(node, "rock_period", periods, drive.rock_period);
    nodes_.readNumber(node, "away_turn", {0.0, M_PI}, drive.away_turn);
    nodes_.readNumber(node, "away_ramp", {0.1, 60.0}, drive.away_ramp);
    if (node["range"]) {
      const auto range = nodes_.numbersOf(node["range"], "range", 2);
      if (!(range[0] > 0.1 && range[0] <= range[1] && range[1] <= 100.0))
        throw yamlError(node["range"], file_, "range must be the nearest and the farthest, in m");
      drive.nearest = range[0];
      drive.farthest = range[1];
    }
    if (!node["away"]) return;
    drive.away.clear();
    for (const YAML::Node& entry : nodes_.entriesOf(node["away"], "away"))
      drive.away.push_back(windowOf(entry, "away"));
  }

  void readSetting(const YAML::Node& root) {
    if (root["seeds"]) study_.seeds = nodes_.wholeNumber(root["seeds"], "seeds", 2, kMostSeeds);
    if (root["first_seed"])
      study_.first_seed = nodes_.wholeNumber(root["first_seed"], "first_seed", 1, kMostSeed);
    nodes_.readNumber(root, "settle", {0.0, 0.5 * study_.drive.seconds}, study_.settle);
    nodes_.readNumber(root, "outliers", {0.0, 1.0}, study_.outliers);
    nodes_.readNumber(root, "flips", {0.0, 1.0}, study_.flips);
    nodes_.readNumber(root, "current", {0.0, 10.0}, study_.current);
    if (root["fault"]) study_.fault = windowOf(root["fault"], "fault");
    nodes_.readStated(root, study_);
  }

  // How far a row is off at the end of the faults is seen by an image.
  void checkFault(const YAML::Node& node) const {
    for (const ErrorSet& set : study_.sets) {
      const double last = std::min(lastLook(study_, set), study_.drive.seconds);
      if (study_.fault.to > last)
        throw yamlError(node, file_,
                        "fault must end within the drive, and not after its last image, which '" +
                            set.name + "' has at " + base::decimalText(last) + " s");
    }
  }

  // A mapping of options of one struct.
  template <class Options>
  void readOptions(const YAML::Node& parent, const std::string& key, Options& options) const {
    nodes_.readOptions(parent, key, [&](const std::string& name, const std::string& text) {
      return base::setOption(options, name, text);
    });
  }

  void readSets(const YAML::Node& list) {
    std::set<std::string> names, files;
    for (const YAML::Node& entry : nodes_.entriesOf(list, "error_sets")) {
      checkKeys(entry, "an error set", file_,
                {"name", "sensors", "camera_offset", "camera_turn", "focal_error", "camera_clock",
                 "corner_noise"});
      ErrorSet set;
      set.name = yamlValue<std::string>(entry, "name", file_, "a name");
      nodes_.refuseTwice(entry["name"], names, set.name, "error_sets");
      for (const std::string& file : trackFilesOf(set.name))
        nodes_.refuseSameFile(entry["name"], files, file);
      set.sensors = sensors_;
      readOptions(entry, "sensors", set.sensors);
      nodes_.readNumber(entry, "camera_offset", {0.0, 10.0}, set.camera_offset);
      nodes_.readNumber(entry, "camera_turn", {0.0, 0.5}, set.camera_turn);
      nodes_.readNumber(entry, "focal_error", {-0.5, 0.5}, set.focal_error);
      nodes_.readNumber(entry, "camera_clock", {0.0, 2.0}, set.camera_clock);
      nodes_.readNumber(entry, "corner_noise", {0.0, 10.0}, set.corner_noise);
      nodes_.atLine(entry, [&] { checkNavigationSensorOptions(set.sensors, 0.01); });
      study_.sets.push_back(set);
    }
  }

  void readPublished(const YAML::Node& node) {
    checkKeys(node, "published", file_, {"source", "rows", "figures"});
    if (node["figures"])
      study_.published_figures =
          study::mappingOf<std::string, double>(node["figures"], "figures", file_);
  }

  std::string file_;
  TrialNodes nodes_;
  simulation::NavigationSensorOptions sensors_;
  TrialStudy study_;
};

}  // namespace

TrialStudy readTrialFile(const std::string& file) {
  return TrialReader(file).read();
}

}  // namespace grid_path_planner::trials
