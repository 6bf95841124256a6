#include "grid/formats/map_server_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "grid/formats/image_file.h"
#include "grid/formats/map_warning.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/base/options.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

using base::choiceFromName, base::choiceName, base::decimalText, base::describeYaml,
    base::extensionOf, base::InputError, base::OutputFile, base::writeFileWithPart, base::yamlAs,
    base::yamlError, base::yamlNode, base::yamlValue, base::yamlValueOr;

namespace {

constexpr const char* kResolution = "a positive, finite number of metres";
constexpr const char* kThreshold = "a number from 0 to 1";
constexpr const char* kOrigin = "a list of x, y (metres) and yaw (radians)";

double readResolution(const YAML::Node& root, const std::string& file) {
  const auto resolution = yamlValue<double>(root, "resolution", file, kResolution);
  if (!(resolution > 0.0))
    throw yamlError(
        root["resolution"], file,
        std::string("resolution must be ") + kResolution + ", got " + decimalText(resolution));
  return resolution;
}

// map_saver prints the yaw of an origin without an orientation, as octomap_server's, as nan or -nan.
bool isNotANumber(const YAML::Node& node) {
  if (!node.IsScalar()) return false;
  std::string text = node.Scalar();
  text.erase(0, text.find_first_not_of("+-."));
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text == "nan";
}

double readYaw(const YAML::Node& node, const std::string& file, const MapFileOptions& options) {
  if (!isNotANumber(node)) return yamlAs<double>(node, "origin yaw", file, "a number of radians");
  warnAbout(file, base::kYawAssumed, options);
  return 0.0;
}

Origin readOrigin(const YAML::Node& root, const std::string& file, const MapFileOptions& options) {
  const YAML::Node node = yamlNode(root, "origin", file, kOrigin);
  if (!node.IsSequence() || node.size() != 3)
    throw yamlError(
        node, file,
        std::string("origin must be ") + kOrigin + ", got " +
            (node.IsSequence() ? std::to_string(node.size()) + " entries" : describeYaml(node)));
  return {yamlAs<double>(node[0], "origin x", file, "a number of metres"),
          yamlAs<double>(node[1], "origin y", file, "a number of metres"),
          readYaw(node[2], file, options)};
}

bool readNegate(const YAML::Node& root, const std::string& file) {
  const auto text = yamlValueOr<std::string>(root, "negate", file, "0 or 1", "0");
  if (text == "0" || text == "false") return false;
  if (text == "1" || text == "true") return true;
  throw yamlError(root["negate"], file, "negate must be 0 or 1, got '" + text + "'");
}

double readThreshold(const YAML::Node& root, const char* key, double fallback,
                     const std::string& file) {
  const auto threshold = yamlValueOr<double>(root, key, file, kThreshold, fallback);
  if (threshold < 0.0 || threshold > 1.0)
    throw yamlError(
        root[key], file,
        std::string(key) + " must be " + kThreshold + ", got " + decimalText(threshold));
  return threshold;
}

MapMode readMode(const YAML::Node& root, const std::string& file) {
  const auto text = yamlValueOr<std::string>(root, "mode", file, "a name", "trinary");
  try {
    return choiceFromName<MapMode>("mode", text);
  } catch (const InputError& error) {
    throw yamlError(root["mode"], file, error.what());
  }
}

PixelRule readRule(const YAML::Node& root, const std::string& file) {
  PixelRule rule;
  rule.negate = readNegate(root, file);
  rule.mode = readMode(root, file);
  rule.occupied_thresh = readThreshold(root, "occupied_thresh", rule.occupied_thresh, file);
  rule.free_thresh = readThreshold(root, "free_thresh", rule.free_thresh, file);
  if (rule.free_thresh > rule.occupied_thresh)
    throw InputError(file, "free_thresh " + decimalText(rule.free_thresh) +
                               " must not be above occupied_thresh " +
                               decimalText(rule.occupied_thresh));
  return rule;
}

std::string imagePath(const YAML::Node& root, const std::string& file) {
  const auto image = yamlValue<std::string>(root, "image", file, "the path of an image");
  if (image.empty()) throw yamlError(root["image"], file, "image must be the path of an image");
  return (std::filesystem::path(file).parent_path() / image).string();
}

std::string yamlOfMap(const std::string& image, const GridGeometry& geometry, MapMode mode) {
  YAML::Emitter name;
  name << image;
  const Origin& origin = geometry.origin();
  return std::string("image: ") + name.c_str() +
         "\nresolution: " + decimalText(geometry.resolution()) + "\norigin: [" +
         decimalText(origin.x) + ", " + decimalText(origin.y) + ", " + decimalText(origin.yaw) +
         "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: " + choiceName(mode) +
         "\n";
}

}  // namespace

const std::vector<std::pair<const char*, MapMode>>& choicesOf(MapMode) {
  static const std::vector<std::pair<const char*, MapMode>> choices = {
      {"trinary", MapMode::TRINARY}, {"scale", MapMode::SCALE}, {"raw", MapMode::RAW}};
  return choices;
}

OccupancyGrid readMapServerMap(const YAML::Node& root, const std::string& file,
                               MapFileOptions& options) {
  const std::string image = imagePath(root, file);
  const double resolution = options.resolution ? *options.resolution : readResolution(root, file);
  double own = resolution;
  if (root["resolution"]) YAML::convert<double>::decode(root["resolution"], own);
  if (resolution != own)
    warnAbout(file,
              "its cells of " + decimalText(own) + " m are taken for cells of " +
                  decimalText(resolution) + " m",
              options);
  const Origin origin = options.origin ? *options.origin : readOrigin(root, file, options);
  const PixelRule rule = readRule(root, file);
  try {
    return readImageFile(image, rule, resolution, origin, options);
  } catch (const InputError& error) {
    throw yamlError(root["image"], file, std::string("its image ") + error.what());
  }
}

void writeMapServerFile(const OutputFile& file, const OccupancyGrid& map, MapMode mode,
                        const OccupancyThresholds& thresholds) {
  if (extensionOf(file.name()) == "pgm")
    throw InputError(file.name(), "a map_server file must end in .yaml, not in .pgm");
  writeFileWithPart(file, "pgm", pgmOfMap(map, mode, thresholds), [&](const std::string& image) {
    return yamlOfMap(image, map.geometry(), mode);
  });
}

}  // namespace grid_path_planner::grid
