#include "flights/program_pilot.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

extern char** environ;

namespace grid_path_planner::flights {

using avoidance::PilotAnswer, avoidance::PilotInput, avoidance::PilotOptions,
    avoidance::PilotStatus;
using base::InputError;
using nlohmann::json;

namespace {

constexpr int kLongestAnswerMs = 60000;         // a program that hangs ends its flight
constexpr std::size_t kLongestLine = 1u << 20;  // bytes

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

void makePipes(const std::string& name, int* down, int* up) {
  if (::pipe2(down, O_CLOEXEC) != 0) throw InputError(name, "no pipe can be made");
  if (::pipe2(up, O_CLOEXEC) == 0) return;
  ::close(down[0]);
  ::close(down[1]);
  throw InputError(name, "no pipe can be made");
}

PilotStatus pilotStatusFrom(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(PilotStatus::CANCELLED); ++i)
    if (toString(static_cast<PilotStatus>(i)) == name) return static_cast<PilotStatus>(i);
  throw InputError("no status is called '" + name + "'");
}

PilotAnswer answerFrom(const std::string& line) {
  const json object = json::parse(line);
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

ProgramPilot::ProgramPilot(const FlightStudy& study, const FlightVariant& variant,
                           const simulation::CameraIntrinsics& camera)
    : name_(variant.program.front()) {
  ::signal(SIGPIPE, SIG_IGN);  // write() reports a lost program
  start(variant.program);
  const std::string hello = helloOf(study, variant.pilot, camera).dump() + '\n';
  send(hello.data(), hello.size());
}

ProgramPilot::~ProgramPilot() {
  ::close(to_);
  ::close(from_);
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void ProgramPilot::start(const std::vector<std::string>& program) {
  int down[2], up[2];
  makePipes(name_, down, up);
  std::vector<char*> arguments;
  for (const std::string& word : program) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, down[0], STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, up[1], STDOUT_FILENO);
  const int error =
      ::posix_spawnp(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(down[0]);
  ::close(up[1]);
  to_ = down[1];
  from_ = up[0];
  if (error == 0) return;
  ::close(to_);
  ::close(from_);
  throw InputError(name_, std::string("cannot be started: ") + std::strerror(error));
}

void ProgramPilot::send(const void* data, std::size_t size) {
  const auto* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(to_, next, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw InputError(name_, "has ended");
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

std::string ProgramPilot::receiveLine() {
  std::size_t end;
  while ((end = received_.find('\n')) == std::string::npos) {
    pollfd polled = {from_, POLLIN, 0};
    const int ready = ::poll(&polled, 1, kLongestAnswerMs);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) throw InputError(name_, "has not answered for a minute");
    char buffer[4096];
    const ssize_t got = ::read(from_, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw InputError(name_, "has ended");
    received_.append(buffer, static_cast<std::size_t>(got));
    if (received_.size() > kLongestLine) throw InputError(name_, "answers without end");
  }
  const std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
}

PilotAnswer ProgramPilot::update(const PilotInput& input) {
  const std::string update = updateOf(input).dump() + '\n';
  send(update.data(), update.size());
  if (input.frame != nullptr) send(input.frame->points.data(), 4 * input.frame->points.size());
  const std::string line = receiveLine();
  try {
    return answerFrom(line);
  } catch (const std::exception& error) {
    throw InputError(name_, "answered '" + line.substr(0, 80) + "': " + error.what());
  }
}

}  // namespace grid_path_planner::flights
