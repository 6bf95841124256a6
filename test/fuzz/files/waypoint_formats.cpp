#include "path/waypoint_formats/waypoint_formats.h"

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/path/waypoint_file.h"

namespace grid_path_planner::fuzz {
namespace {

using path::Path, path::Pose, path::WaypointFormat;

const path::Datum kDatum = {{53.5, 8.1, 3.0}, 0.3};

// What was read can be written, where the format has its frame: one with a quote is refused.
bool isWritten(const std::string& file, WaypointFormat format, const Path& path) {
  try {
    path::writeWaypoints(file, format, path, {kDatum, 0.5});
    return true;
  } catch (const base::InputError& error) {
    mustHold(std::string(error.what()).find("this format has no frame") != std::string::npos,
             "all but the frame can be written");
    return false;
  }
}

// Whatever was read can be written, and read again to the same.
void readAndWrite(WaypointFormat format, const std::string& input) {
  const std::string file = fileOf("fuzz.waypoints", input);
  Path path;
  try {
    path = path::readWaypoints(file, format, kDatum, smallLimits());
  } catch (const base::InputError&) {
    return;
  }
  // At the largest coordinate rounding decides.
  for (const Pose& pose : path.poses)
    if (pose.position.cwiseAbs().maxCoeff() > 0.99 * path::kLargestCoordinate) return;
  if (!isWritten(file, format, path)) return;
  const Path again = path::readWaypoints(file, format, kDatum);
  mustHold(again.poses.size() == path.poses.size(), "all waypoints are read back");
  for (std::size_t i = 0; i < path.poses.size(); ++i)
    mustHold((again.poses[i].position - path.poses[i].position).norm() < 1e-5,
             "positions are read back");
}

std::vector<std::string> seedsOfUuv() {
  return {
      "inertial_frame_id: world_ned\nwaypoints:\n- heading: 0.5\n  max_forward_speed: 0.4\n"
      "  point: [1.0, -2.5, -20.0]\n  use_fixed_heading: true\n",
      "- {point: [0, 0, 1], heading: 0, max_forward_speed: 1, use_fixed_heading: false}\n"
      "- {point: [3, 0, 1], heading: 0, max_forward_speed: 1, use_fixed_heading: false}\n"};
}

FUZZ_TARGET(uuv_waypoints, seedsOfUuv) {
  readAndWrite(WaypointFormat::UUV, input);
}

std::vector<std::string> seedsOfPoseArrays() {
  return {
      "header: \n  seq: 0\n  frame_id: \"odom\"\nposes: \n  - \n    position: \n      x: 1.5\n"
      "      y: 2.0\n      z: 0.0\n    orientation: \n      x: 0.0\n      y: 0.0\n"
      "      z: 1.0\n      w: 0.0\n---\n",
      "header: \n  frame_id: odom\"\nposes: \n  - \n    position: {x: 1.5, y: 2.0, z: 0.0}\n"
      "    orientation: {x: 0.0, y: 0.0, z: 1.0, w: 0.0}\n",
      "header: {frame_id: o\f\fm}\nposes: [{position: {x: 1.5, y: 2.0, z: 0.0}}]\n"};
}

FUZZ_TARGET(pose_array, seedsOfPoseArrays) {
  readAndWrite(WaypointFormat::POSE_ARRAY, input);
}

std::vector<std::string> seedsOfCsv() {
  return {"# frame_id: map\nx,y,z,yaw\n1,2,3,0.5\n-4,1e2,0,-3\n", "yaw, y, x\r\n0.5, 2, 1\r\n",
          "1,2\n3,4\n"};
}

FUZZ_TARGET(csv_waypoints, seedsOfCsv) {
  readAndWrite(WaypointFormat::CSV, input);
}

std::vector<std::string> seedsOfGeojson() {
  return {
      "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":"
      "{\"yaw\":[0.1,0.2]},\"geometry\":{\"coordinates\":[[8.1,53.5],[8.1,53.501,4]],"
      "\"type\":\"LineString\"}}]}",
      "{\"type\": \"Point\", \"coordinates\": [8.1, 53.5]}"};
}

FUZZ_TARGET(geojson_waypoints, seedsOfGeojson) {
  readAndWrite(WaypointFormat::GEOJSON, input);
}

}  // namespace
}  // namespace grid_path_planner::fuzz
