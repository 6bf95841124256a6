#include "path/waypoint_formats/waypoint_formats.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "path/waypoint_entry.h"
#include "path/waypoint_formats/waypoint_texts.h"

namespace grid_path_planner::path {

using base::extensionOf, base::InputError, base::kLargestYaml, base::OutputFile, base::parseYaml,
    base::ReadLimits, base::readWholeFile, base::writeFileAtomically;

const std::vector<std::pair<const char*, WaypointFormat>>& choicesOf(WaypointFormat) {
  static const std::vector<std::pair<const char*, WaypointFormat>> choices = {
      {"planner", WaypointFormat::PLANNER},
      {"uuv", WaypointFormat::UUV},
      {"pose_array", WaypointFormat::POSE_ARRAY},
      {"csv", WaypointFormat::CSV},
      {"geojson", WaypointFormat::GEOJSON}};
  return choices;
}

namespace {

const Datum& checkedDatum(const std::string& file, const std::optional<Datum>& datum) {
  if (!datum) throw InputError(file, "needs a datum: latitude and longitude of the map's origin");
  return *datum;
}

Path pathOfText(const WaypointText& text, WaypointFormat format,
                const std::optional<Datum>& datum) {
  switch (format) {
    case WaypointFormat::UUV:
      return uuvPath(text);
    case WaypointFormat::POSE_ARRAY:
      return poseArrayPath(text);
    case WaypointFormat::GEOJSON:
      return geojsonPath(text, checkedDatum(text.file, datum));
    case WaypointFormat::CSV:
    case WaypointFormat::PLANNER:  // read by its own reader
      break;
  }
  return csvPath(text);
}

// UUV simulator's waypoints are a list of points, with or without a frame above it.
WaypointFormat yamlFormatOf(const YAML::Node& root, const std::string& file) {
  if (root.IsSequence()) return WaypointFormat::UUV;
  if (root.IsMap() && root["poses"]) return WaypointFormat::POSE_ARRAY;
  if (root.IsMap() && root["inertial_frame_id"]) return WaypointFormat::UUV;
  if (root.IsMap() && root["waypoints"]) return WaypointFormat::PLANNER;
  throw InputError(file, "is no file of waypoints: there are neither waypoints nor poses in it");
}

}  // namespace

bool isPlainFrame(const std::string& frame) {
  return !frame.empty() && std::all_of(frame.begin(), frame.end(), [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '_' || letter == '/' || letter == '-' ||
           letter == '.';
  });
}

WaypointFormat waypointFormatOf(const std::string& file, const ReadLimits& limits) {
  const std::string extension = extensionOf(file);
  if (extension == "csv") return WaypointFormat::CSV;
  if (extension == "geojson" || extension == "json") return WaypointFormat::GEOJSON;
  if (extension != "yaml" && extension != "yml")
    throw InputError(file, "must end in .yaml, .csv or .geojson, or its format be named");
  return base::readWithin(file, limits, [&](ReadLimits& within) {
    const std::string text = readWholeFile(file, kLargestYaml, within);
    return yamlFormatOf(parseYaml(text, file, within), file);
  });
}

Path readWaypoints(const std::string& file, WaypointFormat format,
                   const std::optional<Datum>& datum, const ReadLimits& limits) {
  if (format == WaypointFormat::PLANNER) return readWaypointFile(file, limits).path;
  return base::readWithin(file, limits, [&](ReadLimits& within) {
    std::string content = readWholeFile(file, kLargestYaml, within);
    base::dropByteOrderMark(content);
    base::checkIsText(content, file);
    return pathOfText({content, file, within}, format, datum);
  });
}

void writeWaypoints(const OutputFile& file, WaypointFormat format, const Path& path,
                    const WaypointWriting& writing) {
  if (format == WaypointFormat::PLANNER) return writeWaypointFile(file, path);
  checkCanBeRead(file.name(), path);
  if (!isPlainFrame(path.frame_id))
    throw InputError(file.name(),
                     "is not written: this format has no frame '" + path.frame_id + "'");
  std::string text;
  if (format == WaypointFormat::UUV)
    text = uuvText(path, writing.speed);
  else if (format == WaypointFormat::POSE_ARRAY)
    text = poseArrayText(path);
  else if (format == WaypointFormat::CSV)
    text = csvText(path);
  else
    text = geojsonText(path, checkedDatum(file.name(), writing.datum));
  writeFileAtomically(file, text);
}

}  // namespace grid_path_planner::path
