#include "ros/input/input_rules.h"

#include <cmath>
#include <stdexcept>

#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::nodes {

using Stamp = InputRules::Stamp;
using Order = InputRules::Order;
using Silence = InputRules::Silence;

namespace {

// Clouds come from several sensors, and from recordings that are merged.
InputRow mappedClouds() {
  InputRules rules;
  rules.order = Order::ANY;
  rules.frames = {"map"};
  rules.most_bytes = 256 * kMebibyte;
  rules.silent_after = 5.0;
  return {"projected_map", "cloud_in", rules,
          "frame_id, base_frame_id (with filter_ground), tf_timeout, queue_size",
          "In any order, on purpose: the octree is the same whichever cloud is inserted first, and "
          "a frame whose tf is late "
          "holds up no other. 256 MiB: ten clouds of the largest cameras"};
}

InputRow scans() {
  InputRules rules;
  rules.frames = {"map"};
  rules.tf_wait = 0.5;
  rules.most_waiting = 20;
  rules.silent_after = 2.0;
  return {"map_layers", "scan", rules, "map_frame, tf_timeout, source_timeout",
          "In rising order, on purpose: a later scan clears what an earlier one marked. One that "
          "is ahead waits: marks of the "
          "future would outlive decay_time"};
}

InputRow flownClouds() {
  InputRules rules;
  rules.most_ahead = 1.0;
  rules.oldest = 1.0;
  rules.order = Order::NEWEST;
  rules.frames = {"map"};
  rules.most_waiting = 2;
  rules.silent_after = 0.4;
  rules.silence = Silence::BY_STAMP;
  return {"local_planner", "points", rules, "map_frame, cloud_timeout",
          "The newest of each sensor, on purpose: the vehicle flies by what is there now. By its "
          "stamp, at most now: a clock "
          "that is ahead prolongs nothing. A cloud by which nothing is known is refused, so that a "
          "blind sensor is silent"};
}

InputRow images() {
  InputRules rules;
  rules.most_ahead = 0.1;
  rules.oldest = 5.0;
  rules.order = Order::NEWEST;
  rules.most_waiting = 1;
  rules.silent_after = 2.0;
  return {"marker_localizer", "camera/image_raw", rules, "max_age",
          "One at a time, the newest that waits: looking at one takes longer than a camera's "
          "period. tf is not waited for here: "
          "it is asked only where the corners do not tell the pose. 0.1 s ahead as "
          "vehicle_localizer, which gets the pose"};
}

InputRow cameraInfos() {
  InputRules rules;
  rules.stamp = Stamp::ZERO_IS_NOW;
  rules.frame_required = false;
  rules.most_ahead = rules.oldest = kNever;
  rules.order = Order::ANY;
  rules.most_waiting = 1;
  return {"marker_localizer", "camera/camera_info", rules, "",
          "A lens has no time: a latched one of yesterday counts until the next"};
}

// The filter predicts to each stamp, and keeps what came within its history.
InputRules measurementRules(double silent_after) {
  InputRules rules;
  rules.most_ahead = 0.1;
  rules.oldest = 5.0;
  rules.order = Order::ANY;
  rules.most_waiting = 20;
  rules.silent_after = silent_after;
  rules.silence = Silence::BY_STAMP;
  return rules;
}

InputRow measurements(const std::string& topic, double silent_after, const std::string& reason,
                      const std::string& parameters = "history, input_timeout") {
  return {"vehicle_localizer", topic, measurementRules(silent_after), parameters, reason};
}

InputRow positions(const std::string& topic, double silent_after, const std::string& reason) {
  InputRow row = measurements(topic, silent_after, reason);
  row.rules.frame_required = false;
  return row;
}

// A command, or a pose that somebody sets: it comes when somebody wants.
InputRow given(const std::string& topic, double silent_after, std::size_t most_waiting,
               const std::string& reason) {
  InputRow row = positions(topic, silent_after, reason);
  row.rules.stamp = Stamp::ZERO_IS_NOW;
  row.rules.most_waiting = most_waiting;
  if (silent_after == kNever) row.parameters = "history";
  return row;
}

std::vector<InputRow> measurementRows() {
  InputRow imu = measurements("imu/data", 0.5,
                              "In any order, on purpose, as all of this node: the filter inserts "
                              "what is late by its stamp, and refuses a "
                              "stamp that it has used. 0.1 s ahead: it predicts to now, not "
                              "beyond. 200 wait: two seconds of 100 Hz",
                              "history, imu_timeout");
  imu.rules.most_waiting = 200;
  return {
      imu,
      measurements("dvl/twist", 3.0,
                   "tf is asked for the newest place of the sensor, not waited for: it is fixed to "
                   "the vehicle"),
      measurements("pressure", 3.0, "As the DVL"),
      positions("depth", 3.0, "A height in the map, which no frame is; other frames are refused"),
      positions("usbl/pose", 15.0, "Fixes come seldom: silent after five times as long"),
      positions("marker_pose", 15.0, "As the USBL: a panel is seen now and then"),
      given("cmd_vel", 3.0, 10, "A Twist has neither stamp nor frame. It is missed by nobody"),
      given("initialpose", kNever, 1,
            "Somebody sets it by hand, rviz or ~set_pose: silence says nothing, no stamp is now")};
}

std::string limitText(double value) {
  return std::isinf(value) ? "any" : base::decimalText(value) + " s";
}

std::string orderText(Order order) {
  switch (order) {
    case Order::ANY:
      return "any";
    case Order::RISING:
      return "rising";
    case Order::NEWEST:
      break;
  }
  return "newest";
}

std::string tfText(const InputRules& rules) {
  if (rules.frames.empty()) return "not waited for";
  std::string text;
  for (const std::string& frame : rules.frames) text += (text.empty() ? "" : ", ") + frame;
  return text + ", " + limitText(rules.tf_wait);
}

std::string silenceText(const InputRules& rules) {
  if (std::isinf(rules.silent_after)) return "never";
  return limitText(rules.silent_after) +
         (rules.silence == Silence::BY_STAMP ? " by stamp" : " by arrival");
}

std::string codes(const std::string& names) {
  return names.empty() ? "" : "`" + names + "`";
}

std::string rowText(const InputRow& row) {
  const InputRules& r = row.rules;
  std::string text = "|";
  for (const std::string& cell :
       {codes(row.node), codes(row.topic),
        std::string(r.stamp == Stamp::REQUIRED ? "required" : "0 is now"),
        std::string(r.frame_required ? "required" : "may be empty"), limitText(r.most_ahead),
        limitText(r.oldest), orderText(r.order), tfText(r),
        std::to_string(r.most_waiting) + ", " + std::to_string(r.most_bytes / kMebibyte) + " MiB",
        silenceText(r), row.parameters, row.reason})
    text += (cell.empty() ? "" : " " + cell) + " |";
  return text;
}

}  // namespace

const std::vector<InputRow>& inputTable() {
  static const std::vector<InputRow> table = [] {
    std::vector<InputRow> rows = {mappedClouds(), scans(), flownClouds(), images(), cameraInfos()};
    for (InputRow& row : measurementRows()) rows.push_back(std::move(row));
    return rows;
  }();
  return table;
}

const InputRules& rulesOf(const std::string& node, const std::string& topic) {
  for (const InputRow& row : inputTable())
    if (row.node == node && row.topic == topic) return row.rules;
  throw std::logic_error("no rules for " + topic + " of " + node);
}

std::string inputTableText() {
  std::string text =
      "| node | topic | stamp | frame | ahead | old | order | tf | waiting | silent after | "
      "parameters | why |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|";
  for (const InputRow& row : inputTable()) text += '\n' + rowText(row);
  return text;
}

}  // namespace grid_path_planner::nodes
