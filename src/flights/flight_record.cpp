#include "flights/flight_record.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "grid_path_planner/base/options.h"
#include "study/json_numbers.h"

namespace grid_path_planner::flights {
namespace {

using nlohmann::json;
using study::wholeNumberOf;

json pathJson(const std::vector<Eigen::Vector3f>& path) {
  json numbers = json::array();
  for (const Eigen::Vector3f& place : path)
    for (int axis = 0; axis < 3; ++axis)
      numbers.push_back(std::round(static_cast<double>(place[axis]) * 1000.0) / 1000.0);
  return numbers;
}

std::vector<Eigen::Vector3f> pathFrom(const json& numbers) {
  std::vector<Eigen::Vector3f> path;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    path.emplace_back(numbers[i].get<float>(), numbers[i + 1].get<float>(),
                      numbers[i + 2].get<float>());
  return path;
}

FlightRecord recordFrom(const json& object) {
  FlightRecord record;
  record.variant = wholeNumberOf<decltype(record.variant)>(object.at("variant"));
  record.world = wholeNumberOf<decltype(record.world)>(object.at("world"));
  record.seed = wholeNumberOf<decltype(record.seed)>(object.at("seed"));
  record.end = base::choiceFromName<FlightEnd>("end", object.at("end").get<std::string>());
  object.at("sentence").get_to(record.sentence);
  for (int axis = 0; axis < 3; ++axis) record.at[axis] = object.at("at").at(axis).get<double>();
  object.at("speed").get_to(record.speed);
  object.at("time_s").get_to(record.time_s);
  object.at("length_m").get_to(record.length_m);
  object.at("home_offset_m").get_to(record.home_offset_m);
  object.at("clearance_m").get_to(record.clearance_m);
  object.at("max_speed").get_to(record.max_speed);
  record.waypoints = wholeNumberOf<decltype(record.waypoints)>(object.at("waypoints"));
  record.unseen = wholeNumberOf<decltype(record.unseen)>(object.at("unseen"));
  record.updates = wholeNumberOf<decltype(record.updates)>(object.at("updates"));
  record.bits = wholeNumberOf<decltype(record.bits)>(object.at("bits"));
  record.path = pathFrom(object.at("path"));
  const json& cost = object.at("cpu_ms");
  record.cost = {cost.at(0).get<double>(), cost.at(1).get<double>(), cost.at(2).get<double>(),
                 cost.at(3).get<double>()};
  return record;
}

}  // namespace

const std::vector<std::pair<const char*, FlightEnd>>& choicesOf(FlightEnd) {
  static const std::vector<std::pair<const char*, FlightEnd>> choices = {
      {"HOME", FlightEnd::HOME},    {"CONTACT", FlightEnd::CONTACT}, {"FENCE", FlightEnd::FENCE},
      {"STUCK", FlightEnd::STUCK},  {"TIMEOUT", FlightEnd::TIMEOUT}, {"LOST", FlightEnd::LOST},
      {"FAILED", FlightEnd::FAILED}};
  return choices;
}

std::string lineOf(const FlightRecord& record) {
  return json{{"variant", record.variant},
              {"world", record.world},
              {"seed", record.seed},
              {"end", base::choiceName(record.end)},
              {"sentence", record.sentence},
              {"at", {record.at.x(), record.at.y(), record.at.z()}},
              {"speed", record.speed},
              {"time_s", record.time_s},
              {"length_m", record.length_m},
              {"home_offset_m", record.home_offset_m},
              {"clearance_m", record.clearance_m},
              {"max_speed", record.max_speed},
              {"waypoints", record.waypoints},
              {"unseen", record.unseen},
              {"updates", record.updates},
              {"bits", record.bits},
              {"path", pathJson(record.path)},
              {"cpu_ms",
               {record.cost.pilot_mean, record.cost.pilot_p99, record.cost.pilot_max,
                record.cost.camera_mean}}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

FlightRecord recordFromLine(const std::string& line) {
  try {
    return recordFrom(json::parse(line));
  } catch (const json::exception& error) {
    throw base::InputError(std::string("is not the line of a flight: ") + error.what());
  }
}

}  // namespace grid_path_planner::flights
