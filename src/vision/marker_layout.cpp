#include "vision/marker_layout.h"

#include <cmath>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/yaml_file.h"

namespace grid_path_planner::vision {

using base::checkKeys, base::decimalText, base::describeYaml, base::yamlAs, base::yamlError,
    base::yamlNode, base::yamlValue;

namespace {

constexpr int kIds = 587;           // of the family 36h11
constexpr double kFarthest = 1e3;   // m, from the panel's origin
constexpr double kLargest = 100.0;  // m

double lengthAt(const YAML::Node& root, const std::string& key, const std::string& file) {
  const auto length = yamlValue<double>(root, key, file, "a number of metres");
  if (!(length > 0.0 && length <= kLargest))
    throw yamlError(root[key], file,
                    key + " must be above 0 and at most 100 m, got " + decimalText(length));
  return length;
}

// Three numbers, none of a larger magnitude than `largest`.
Eigen::Vector3d vectorAt(const YAML::Node& marker, const std::string& key, double largest,
                         const std::string& file) {
  const std::string expected =
      "a list of three numbers from -" + decimalText(largest) + " to " + decimalText(largest);
  const YAML::Node list = yamlNode(marker, key, file, expected);
  if (!list.IsSequence() || list.size() != 3)
    throw yamlError(list, file, key + " must be " + expected + ", got " + describeYaml(list));
  Eigen::Vector3d vector;
  for (int axis = 0; axis < 3; ++axis)
    vector[axis] = yamlAs<double>(list[axis], key, file, expected);
  if (vector.cwiseAbs().maxCoeff() > largest)
    throw yamlError(list, file, key + " must be " + expected);
  return vector;
}

Eigen::Isometry3d poseAt(const YAML::Node& marker, const std::string& file) {
  Eigen::Isometry3d pose(Eigen::Translation3d(vectorAt(marker, "position", kFarthest, file)));
  const Eigen::Vector3d angles = vectorAt(marker, "rpy", 6.3, file);
  pose.rotate(Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()));
  return pose.rotate(Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()));
}

void addMarker(const YAML::Node& marker, const std::string& file, MarkerLayout& layout) {
  checkKeys(marker, "a marker", file, {"id", "position", "rpy"});
  const int id = yamlValue<int>(marker, "id", file, "the number of a marker");
  if (id < 0 || id >= kIds)
    throw yamlError(marker["id"], file,
                    "the family 36h11 has markers 0 to 586, got " + std::to_string(id));
  if (!layout.panel_from_tag.emplace(id, poseAt(marker, file)).second)
    throw yamlError(marker, file, "there are two markers " + std::to_string(id));
}

void checkFamily(const YAML::Node& root, const std::string& file) {
  const auto family = yamlValue<std::string>(root, "family", file, "36h11");
  if (family != "36h11")
    throw yamlError(root["family"], file, "family must be 36h11, got '" + family + "'");
}

}  // namespace

Corners tagCorners(double tag_size) {
  const double half = 0.5 * tag_size;
  return {{{-half, half, 0.0}, {half, half, 0.0}, {half, -half, 0.0}, {-half, -half, 0.0}}};
}

Corners MarkerLayout::cornersOf(int id) const {
  Corners corners = tagCorners(tag_size);
  for (Eigen::Vector3d& corner : corners) corner = panel_from_tag.at(id) * corner;
  return corners;
}

MarkerLayout readMarkerLayout(const std::string& file, const base::ReadLimits& limits) {
  const YAML::Node root = base::loadYamlFile(file, limits);
  checkKeys(root, "a layout of markers", file, {"family", "tag_size", "plate_size", "markers"});
  checkFamily(root, file);
  MarkerLayout layout;
  layout.tag_size = lengthAt(root, "tag_size", file);
  if (lengthAt(root, "plate_size", file) <= layout.tag_size)
    throw yamlError(root["plate_size"], file, "plate_size must be above tag_size");
  const YAML::Node list = yamlNode(root, "markers", file, "a list of markers");
  if (!list.IsSequence() || list.size() == 0)
    throw yamlError(list, file,
                    "markers must be a list of at least one, got " + describeYaml(list));
  for (const YAML::Node& marker : list) addMarker(marker, file, layout);
  return layout;
}

}  // namespace grid_path_planner::vision
