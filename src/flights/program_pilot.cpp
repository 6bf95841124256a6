#include "flights/program_pilot.h"

#include <nlohmann/json.hpp>

namespace grid_path_planner::flights {

using avoidance::PilotAnswer, avoidance::PilotInput, avoidance::PilotOptions,
    avoidance::PilotStatus;
using base::InputError;
using nlohmann::json;

namespace {

ProgramProcess::Deadline oneMinute() {  // a program that hangs ends its flight
  return std::chrono::steady_clock::now() + std::chrono::minutes(1);
}

json placeJson(const Eigen::Vector3d& place) {
  return {place.x(), place.y(), place.z()};
}

json helloOf(const FlightStudy& study, const PilotOptions& options,
             const simulation::CameraIntrinsics& camera) {
  json route = json::array();
  for (const auto& place : study.route) route.push_back(placeJson(place));
  return {{"protocol", 1},
          {"route", route},
          {"max_speed", options.max_speed},
          {"max_climb", options.max_climb},
          {"max_yaw_rate", options.max_yaw_rate},
          {"max_acceleration", options.max_acceleration},
          {"z_min", options.z_min},
          {"z_max", options.z_max},
          {"arrival_radius", options.arrival_radius},
          {"home_radius", options.home_radius},
          {"command_rate", study.command_rate},
          {"camera",
           {{"width", study.camera.width},
            {"height", study.camera.height},
            {"rate", study.camera.rate},
            {"fx", camera.fx},
            {"fy", camera.fy},
            {"cx", camera.cx},
            {"cy", camera.cy},
            {"range_min", study.camera.range_min},
            {"range_max", study.camera.range_max}}}};
}

json matrixJson(const Eigen::Isometry3d& pose) {
  json rows = json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) rows.push_back(pose.matrix()(row, column));
  return rows;
}

json updateOf(const PilotInput& input) {
  json update = {
      {"time", input.time},
      {"velocity",
       {input.velocity.surge, input.velocity.sway, input.velocity.heave, input.velocity.yaw_rate}},
      {"frame_bytes", input.frame == nullptr ? 0 : 4 * input.frame->points.size()}};
  if (input.pose) {
    update["position"] = placeJson(input.pose->position);
    update["yaw"] = input.pose->yaw;
  }
  if (input.frame != nullptr) update["map_from_optical"] = matrixJson(input.frame->map_from_sensor);
  return update;
}

PilotStatus pilotStatusFrom(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(PilotStatus::CANCELLED); ++i)
    if (toString(static_cast<PilotStatus>(i)) == name) return static_cast<PilotStatus>(i);
  throw InputError("no status is called '" + name + "'");
}

PilotAnswer answerFrom(const json& object) {
  const json& velocity = object.at("velocity");
  PilotAnswer answer;
  answer.velocity = {velocity.at(0).get<double>(), velocity.at(1).get<double>(),
                     velocity.at(2).get<double>(), velocity.at(3).get<double>()};
  if (!answer.velocity.isFinite()) throw InputError("a velocity that is not finite");
  answer.status = pilotStatusFrom(object.value("status", std::string("FLYING")));
  answer.sentence = object.value("sentence", std::string());
  return answer;
}

}  // namespace

PilotAnswer pilotAnswerFrom(const std::string& line) {
  try {
    return answerFrom(json::parse(line));
  } catch (const json::exception& error) {
    throw InputError(error.what());
  }
}

ProgramPilot::ProgramPilot(const FlightStudy& study, const FlightVariant& variant,
                           const simulation::CameraIntrinsics& camera)
    : name_(variant.program.front()), process_(variant.program) {
  const std::string hello = helloOf(study, variant.pilot, camera).dump() + '\n';
  process_.send(hello.data(), hello.size(), oneMinute());
}

PilotAnswer ProgramPilot::update(const PilotInput& input) {
  const std::string update = updateOf(input).dump() + '\n';
  const ProgramProcess::Deadline deadline = oneMinute();
  process_.send(update.data(), update.size(), deadline);
  if (input.frame != nullptr)
    process_.send(input.frame->points.data(), 4 * input.frame->points.size(), deadline);
  const std::string line = process_.receiveLine(deadline);
  try {
    return pilotAnswerFrom(line);
  } catch (const InputError& error) {
    throw InputError(name_, "answered '" + line.substr(0, 80) + "': " + error.what());
  }
}

}  // namespace grid_path_planner::flights
