// grid_path waypoints: a waypoint file from one format to another.
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "path/waypoint_formats/waypoint_formats.h"

namespace grid_path_planner::command_line {

using base::choiceFromName, base::choiceName, base::InputError;
using path::Datum, path::Path, path::readWaypoints, path::WaypointFormat, path::waypointFormatOf,
    path::WaypointWriting, path::writeWaypoints;

namespace {

namespace po = boost::program_options;

constexpr std::int64_t kMostWaypoints = 1000000;  // that are written
constexpr double kSamePosition = 1e-6;            // m

po::options_description waypointsOptions() {
  po::options_description known("Options");
  const char* formats =
      "planner, uuv (UUV simulator), pose_array (rostopic echo of it or of a path), csv or "
      "geojson; default: as the "
      "file's name and, in YAML, its first keys say";
  known.add_options()("input", po::value<std::string>()->required(), "the file that is read")(
      "output", po::value<std::string>()->required(), "the file that is written")(
      "from", po::value<std::string>(), formats)("to", po::value<std::string>(),
                                                 "the same; of a .yaml default planner")(
      "datum", po::value<std::string>(),
      "LAT,LON[,YAW[,ALTITUDE]] of the map's origin for geojson: degrees, radians of its x axis "
      "anticlockwise from east, metres above the WGS84 ellipsoid")(
      "speed", po::value<std::string>(), "max_forward_speed of uuv [m/s]; default 0.5")(
      "frame", po::value<std::string>(), "frame of the waypoints instead of the file's own")(
      "laps", po::value<std::string>(),
      "how often the waypoints are written one after the other, for a patrol; default 1");
  return known;
}

std::optional<Datum> datumFrom(const po::variables_map& values) {
  if (values.count("datum") == 0) return std::nullopt;
  const auto numbers = numbersOf("datum", values["datum"].as<std::string>(), 2, 4);
  Datum datum;
  datum.origin.latitude = numbers[0];
  datum.origin.longitude = numbers[1];
  if (numbers.size() > 2) datum.yaw = numbers[2];
  if (numbers.size() > 3) datum.origin.altitude = numbers[3];
  path::LocalTangentPlane{datum};  // checks it
  return datum;
}

WaypointFormat formatToWrite(const po::variables_map& values) {
  if (values.count("to") != 0)
    return choiceFromName<WaypointFormat>("--to", values["to"].as<std::string>());
  const std::string& file = values["output"].as<std::string>();
  const std::string extension = base::extensionOf(file);
  if (extension == "yaml" || extension == "yml") return WaypointFormat::PLANNER;
  return waypointFormatOf(file);
}

WaypointWriting writingFrom(const po::variables_map& values) {
  WaypointWriting writing;
  writing.datum = datumFrom(values);
  if (values.count("speed") == 0) return writing;
  writing.speed = numbersOf("speed", values["speed"].as<std::string>(), 1, 1)[0];
  if (writing.speed <= 0.0) throw InputError("--speed must be above 0 m/s");
  return writing;
}

// Where it ends at its first position, as a round trip does, that is not visited twice in a row.
Path repeated(const Path& path, std::int64_t laps) {
  if (static_cast<double>(laps) * static_cast<double>(path.poses.size()) > kMostWaypoints)
    throw InputError("--laps gives more than " + std::to_string(kMostWaypoints) + " waypoints");
  const bool closed =
      (path.poses.front().position - path.poses.back().position).norm() < kSamePosition;
  Path all = path;
  for (std::int64_t lap = 1; lap < laps; ++lap)
    all.poses.insert(all.poses.end(), path.poses.begin() + (closed ? 1 : 0), path.poses.end());
  return all;
}

}  // namespace

int runWaypoints(int argc, char** argv) {
  po::variables_map values;
  if (!parseArguments(argc, argv, waypointsOptions(),
                      "grid_path waypoints --input FILE --output FILE [options]", values))
    return 0;
  const std::string& input = values["input"].as<std::string>();
  const WaypointFormat to = formatToWrite(values);
  const WaypointWriting writing = writingFrom(values);
  const WaypointFormat from =
      values.count("from") != 0
          ? choiceFromName<WaypointFormat>("--from", values["from"].as<std::string>())
          : waypointFormatOf(input);
  if (writing.datum && from != WaypointFormat::GEOJSON && to != WaypointFormat::GEOJSON)
    warnAboutUnusedOption("datum", "neither file a geojson");
  Path path = readWaypoints(input, from, writing.datum);
  if (values.count("laps") != 0) path = repeated(path, countFrom(values, "laps"));
  if (values.count("frame") != 0) path.frame_id = values["frame"].as<std::string>();
  writeWaypoints(values["output"].as<std::string>(), to, path, writing);
  std::cout << path.poses.size() << " waypoints, " << choiceName(from) << " to " << choiceName(to)
            << '\n';
  return 0;
}

}  // namespace grid_path_planner::command_line
