#include <cmath>
#include <cstdio>
#include <set>

#include "flights/flight_steps.h"
#include "flights/flight_study.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/yaml_file.h"
#include "study/file/study_nodes.h"
#include "study/run_folder.h"
#include "study/study_yaml.h"

namespace grid_path_planner::flights {

using avoidance::PilotOptions, avoidance::Rules;
using base::describeYaml, base::OptionInfo, base::yamlAs, base::yamlError, base::yamlNode,
    base::yamlValue, base::yamlValueOr;
using Eigen::Vector3d;
using simulation::BodyShape, simulation::MovingBody;
using study::checkKeys, study::StudyNodes;

namespace {

constexpr int kMostFlights = 100000;
constexpr int kMostSeed = 1000000000;

// Reads one file; every method reads a node of it and reports errors with its line.
class FlightReader {
 public:
  explicit FlightReader(const std::string& file) : file_(file), nodes_(file) {}

  FlightStudy read() {
    const YAML::Node root = base::loadYamlFile(file_);
    checkKeys(root, "the study of flights", file_,
              {"title", "worlds", "vehicle", "command_rate", "start", "start_shift", "yaw_shift",
               "route", "fence", "time_limit", "bodies", "pilot", "rules", "configurations",
               "flights", "first_seed", "shortest", "published"});
    study_.file = file_;
    study_.title = yamlValue<std::string>(root, "title", file_, "a sentence");
    readSetting(root);
    readWorlds(yamlNode(root, "worlds", file_, "a list of SDF files"));
    if (root["shortest"])
      study_.shortest = study::mappingOf<std::string, double>(root["shortest"], "shortest", file_);
    if (root["bodies"]) readBodies(root["bodies"]);
    readVariants(root);
    if (root["published"]) readPublished(root["published"]);
    return study_;
  }

 private:
  double number(const YAML::Node& root, const char* key, double least, double most,
                double fallback) const {
    const auto value = yamlValueOr<double>(root, key, file_, "a number", fallback);
    if (value < least || value > most)
      throw yamlError(root[key], file_, std::string(key) + " is out of limits");
    return value;
  }

  std::vector<double> numbersOf(const YAML::Node& node, const std::string& name,
                                std::size_t count) const {
    const YAML::Node list = nodes_.entriesOf(node, name);
    if (list.size() != count)
      throw yamlError(node, file_, name + " must have " + std::to_string(count) + " numbers");
    std::vector<double> numbers;
    for (const YAML::Node& entry : list)
      numbers.push_back(yamlAs<double>(entry, name, file_, "a number"));
    return numbers;
  }

  // Under `key`, which must be there.
  YAML::Node listOf(const YAML::Node& parent, const std::string& key) const {
    return nodes_.entriesOf(yamlNode(parent, key, file_, "a list"), key);
  }

  Vector3d placeOf(const YAML::Node& node, const std::string& name) const {
    const std::vector<double> xyz = numbersOf(node, name, 3);
    return {xyz[0], xyz[1], xyz[2]};
  }

  // Option `key` of any struct, if it has it.
  template <class Options>
  bool tryOption(Options& options, const std::string& prefix, const std::string& key,
                 const YAML::Node& value_node) const {
    bool known = false;
    visitOptions(options, [&](const char* name, auto& value, const OptionInfo& info) {
      if (key != prefix + name) return;
      known = true;
      const auto text = yamlAs<std::string>(value_node, key, file_, "a value");
      nodes_.atLine(value_node, [&] { base::parseOption(key, text, info, value); });
    });
    return known;
  }

  // A file of parameters of `simulator`: those of vehicle, odometry and camera.
  void readVehicle(const std::string& name) {
    const FlightReader of(name);
    for (const auto& entry : base::loadYamlFile(name)) {
      const auto key = yamlAs<std::string>(entry.first, "an option", name, "a name");
      if (!of.tryOption(study_.vehicle, "", key, entry.second) &&
          !of.tryOption(study_.odometry, "", key, entry.second) &&
          !of.tryOption(study_.camera, "camera_", key, entry.second))
        throw yamlError(entry.first, name, "vehicle, odometry and camera have no '" + key + "'");
    }
    checkVehicleOptions(study_.vehicle);
    checkDepthCameraOptions(study_.camera);
  }

  void readSetting(const YAML::Node& root) {
    if (root["vehicle"]) readVehicle(nodes_.resolved(root["vehicle"], "vehicle"));
    study_.command_rate = number(root, "command_rate", 1.0, 1000.0, study_.command_rate);
    nodes_.atLine(root["command_rate"] ? root["command_rate"] : root,
                  [this] { flightSteps(study_); });
    const auto start = numbersOf(yamlNode(root, "start", file_, "x, y, z, yaw"), "start", 4);
    study_.start = {start[0], start[1], start[2]};
    study_.start_yaw = start[3];
    study_.start_shift = number(root, "start_shift", 0.0, 100.0, 0.0);
    study_.yaw_shift = number(root, "yaw_shift", 0.0, 3.2, 0.0);
    for (const YAML::Node& entry : listOf(root, "route"))
      study_.route.push_back(placeOf(entry, "a place of the route"));
    if (root["fence"]) {
      const auto fence = numbersOf(root["fence"], "fence", 2);
      study_.fence_low = fence[0];
      study_.fence_high = fence[1];
    }
    study_.time_limit = number(root, "time_limit", 1.0, 3600.0, study_.time_limit);
  }

  static std::string stemOf(const std::string& file) {
    const std::string base = file.substr(file.rfind('/') + 1);
    return base.substr(0, base.rfind('.'));
  }

  // {pattern: "course_%d.sdf", seeds: [200, 249]}
  void readPattern(const YAML::Node& entry) {
    checkKeys(entry, "a world", file_, {"pattern", "seeds"});
    const std::string pattern =
        nodes_.resolved(yamlNode(entry, "pattern", file_, "a file name"), "pattern");
    const std::size_t at = pattern.find("%d");
    if (at == std::string::npos)
      throw yamlError(entry, file_, "a pattern of worlds needs %d for their seeds");
    const YAML::Node seeds =
        nodes_.entriesOf(yamlNode(entry, "seeds", file_, "first and last"), "seeds");
    if (seeds.size() != 2) throw yamlError(entry, file_, "seeds must have 2 numbers");
    const int first = nodes_.wholeNumber(seeds[0], "a seed", 0, kMostSeed);
    const int last = nodes_.wholeNumber(seeds[1], "a seed", 0, kMostSeed);
    if (first > last || last - first > 10000)
      throw yamlError(entry, file_, "seeds must be [first, last], at most 10000");
    for (int seed = first; seed <= last; ++seed) {
      std::string name = pattern;
      name.replace(at, 2, std::to_string(seed));
      study_.worlds.push_back({stemOf(name), name});
    }
  }

  void readWorlds(const YAML::Node& node) {
    for (const YAML::Node& entry : nodes_.entriesOf(node, "worlds")) {
      if (entry.IsMap()) {
        readPattern(entry);
        continue;
      }
      const std::string file = nodes_.resolved(entry, "a world");
      study_.worlds.push_back({stemOf(file), file});
    }
    std::set<std::string> names;
    for (const FlightWorld& world : study_.worlds)
      if (!names.insert(world.name).second)
        throw yamlError(node, file_, "worlds has '" + world.name + "' twice");
  }

  void readBodies(const YAML::Node& node) {
    for (const YAML::Node& entry : nodes_.entriesOf(node, "bodies")) {
      checkKeys(entry, "a body", file_, {"name", "shape", "half_size", "track"});
      MovingBody body;
      body.name = yamlValue<std::string>(entry, "name", file_, "a name");
      const auto shape = yamlValue<std::string>(entry, "shape", file_, "a shape");
      nodes_.atLine(entry, [&] { body.shape = base::choiceFromName<BodyShape>("shape", shape); });
      body.half_size = placeOf(yamlNode(entry, "half_size", file_, "x, y, z"), "half_size");
      for (const YAML::Node& at : listOf(entry, "track")) {
        const auto knot = numbersOf(at, "a place of the track", 4);
        body.track.push_back({knot[0], {knot[1], knot[2], knot[3]}});
      }
      study_.bodies.push_back(body);
    }
    nodes_.atLine(node, [&] { simulation::MovingBodies{study_.bodies}; });
  }

  void readPilot(const YAML::Node& node, PilotOptions& options) const {
    if (!node.IsMap()) throw yamlError(node, file_, "pilot must be a mapping of options");
    for (const auto& entry : node) {
      const auto key = yamlAs<std::string>(entry.first, "an option", file_, "a name");
      if (!tryOption(options, "", key, entry.second))
        throw yamlError(entry.first, file_, "the pilot has no option '" + key + "'");
    }
  }

  // pilot: {program: [file, argument...]} or options.
  void readPilotOrProgram(const YAML::Node& node, FlightVariant& variant) const {
    if (!node.IsMap() || !node["program"]) return readPilot(node, variant.pilot);
    checkKeys(node, "pilot", file_, {"program"});
    for (const YAML::Node& word : nodes_.entriesOf(node["program"], "program"))
      variant.program.push_back(yamlAs<std::string>(word, "program", file_, "a word"));
    if (variant.program.front().find('/') != std::string::npos)
      variant.program.front() = nodes_.resolved(node["program"][0], "program");
  }

  void readConfiguration(const YAML::Node& entry, const FlightVariant& common,
                         const std::vector<Rules>& rules) {
    checkKeys(entry, "a configuration", file_, {"name", "pilot", "rules", "flights", "first_seed"});
    FlightVariant variant = common;
    variant.name = yamlValue<std::string>(entry, "name", file_, "a name");
    if (entry["pilot"]) readPilotOrProgram(entry["pilot"], variant);
    readSeeds(entry, variant);
    for (const Rules each :
         entry["rules"] ? nodes_.choicesUnder(entry, "rules", Rules::SAFE) : rules) {
      variant.pilot.rules = each;
      nodes_.atLine(entry, [&] { checkPilotOptions(variant.pilot); });
      study_.variants.push_back(variant);
    }
  }

  void readSeeds(const YAML::Node& node, FlightVariant& variant) const {
    if (node["flights"])
      variant.flights = nodes_.wholeNumber(node["flights"], "flights", 1, kMostFlights);
    if (node["first_seed"])
      variant.first_seed = nodes_.wholeNumber(node["first_seed"], "first_seed", 0, kMostSeed);
  }

  void readVariants(const YAML::Node& root) {
    FlightVariant common;
    if (root["pilot"]) readPilot(root["pilot"], common.pilot);
    readSeeds(root, common);
    const auto rules = nodes_.choicesUnder(root, "rules", common.pilot.rules);
    const YAML::Node list = yamlNode(root, "configurations", file_, "a list of configurations");
    for (const YAML::Node& entry : nodes_.entriesOf(list, "configurations"))
      readConfiguration(entry, common, rules);
    std::set<std::string> labels;
    for (const FlightVariant& variant : study_.variants)
      if (!labels.insert(variant.label()).second)
        throw yamlError(list, file_, "configurations has '" + variant.label() + "' twice");
    refuseSamePictures(list);
  }

  void refuseSamePictures(const YAML::Node& node) const {
    std::set<std::string> files;
    for (const FlightVariant& variant : study_.variants)
      for (const FlightWorld& world : study_.worlds) {
        const std::string title = pictureTitle(variant, world);
        if (!files.insert(study::fileNameOf(title)).second)
          throw yamlError(node, file_,
                          "'" + title + "' has the file of another one: above_" +
                              study::fileNameOf(title) + ".svg");
      }
  }

  void readPublished(const YAML::Node& node) {
    checkKeys(node, "published", file_, {"source", "figures", "pairs", "conclusions"});
    study_.published_source = yamlValue<std::string>(node, "source", file_, "a sentence");
    for (const auto& entry : yamlNode(node, "figures", file_, "a mapping")) {
      const auto figures = numbersOf(entry.second, "time, length, success", 3);
      study_.published[yamlAs<std::string>(entry.first, "a name", file_, "a name")] = {
          figures[0], figures[1], figures[2]};
    }
    for (const YAML::Node& entry : listOf(node, "pairs")) {
      checkKeys(entry, "a pair", file_, {"pair", "p"});
      const auto p = numbersOf(listOf(entry, "p"), "p of time and length", 2);
      study_.pairs.push_back({pairOf(listOf(entry, "pair")), p[0], p[1]});
    }
    if (!node["conclusions"]) return;
    for (const YAML::Node& entry : nodes_.entriesOf(node["conclusions"], "conclusions")) {
      checkKeys(entry, "a conclusion", file_, {"claim", "pairs"});
      study_.conclusions.push_back(
          {yamlValue<std::string>(entry, "claim", file_, "a sentence"), {}});
      for (const YAML::Node& pair : listOf(entry, "pairs"))
        study_.conclusions.back().pairs.push_back(pairOf(pair));
    }
  }

  ComparedPair pairOf(const YAML::Node& node) const {
    const YAML::Node list = nodes_.entriesOf(node, "a pair");
    if (list.size() != 2)
      throw yamlError(node, file_, "a pair must be two names, worse and better");
    return {configurationOf(list[0]), configurationOf(list[1])};
  }

  // The name of one that is flown. Precondition: these are read.
  std::string configurationOf(const YAML::Node& node) const {
    const auto name = yamlAs<std::string>(node, "a pair", file_, "a name");
    for (const FlightVariant& variant : study_.variants)
      if (variant.name == name) return name;
    throw yamlError(node, file_, "a pair names '" + name + "', which is no configuration");
  }

  std::string file_;
  StudyNodes nodes_;
  FlightStudy study_;
};

}  // namespace

FlightStudy readFlightFile(const std::string& file) {
  return FlightReader(file).read();
}

}  // namespace grid_path_planner::flights
