#include "ros/planning/record/plan_record.h"

#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/option_text.h"
#include "path/pose_spacing.h"
#include "ros/planning/record/map_checksum.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::OptionInfo;
using base::optionText;
using base::parseOption;
using grid::OccupancyGrid;
using path::HeadingMode;
using path::Path;
using path::Pose;
using path::spacedPoses;
using planning::checkPlannerOptions;
using planning::Plan;
using planning::PlannerOptions;
using planning::ViaOrder;

namespace {

constexpr double kWidestSpacing = 10000.0;  // m, as the parameter's limit
constexpr double kFarthest = 1e8;           // m: no map lies farther away

using Numbers = PlanRecord::_start_type;

Numbers numbersOf(const Pose& pose) {
  return {pose.position.x(), pose.position.y(), pose.position.z(), pose.yaw};
}

// path_planner refuses poses that are farther away than maps may be, or no numbers.
template <class List>
void checkPlaces(const List& numbers) {
  for (const double number : numbers)
    if (!(std::abs(number) <= kFarthest))
      throw InputError("its start, goal or via-points hold " + std::to_string(number));
}

Pose poseOf(const Numbers& numbers) {
  Pose pose;
  pose.position = {numbers[0], numbers[1], numbers[2]};
  pose.yaw = numbers[3];
  return pose;
}

std::map<std::string, std::string> valuesIn(const std::string& text) {
  std::map<std::string, std::string> values;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) throw InputError("its options have a line without a value");
    values[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return values;
}

// Takes the values of options out of a list.
struct FromList {
  std::map<std::string, std::string>& values;

  template <class Value>
  void operator()(const char* name, Value& value, const OptionInfo& info) const {
    const auto found = values.find(name);
    if (found == values.end())
      throw InputError(std::string("its options lack ") + name + ", which this version has");
    parseOption(name, found->second, info, value);
    values.erase(found);
  }
};

PlannerOptions optionsFrom(const std::string& text) {
  std::map<std::string, std::string> values = valuesIn(text);
  PlannerOptions options;
  visitOptions(options, FromList{values});
  if (!values.empty())
    throw InputError("its options have " + values.begin()->first + ", which this version lacks");
  checkPlannerOptions(options);
  return options;
}

}  // namespace

PlanRecord recordOf(const PlanQuestion& question, const OccupancyGrid& map, const Plan& plan,
                    const Path& poses) {
  PlanRecord record;
  record.header.frame_id = poses.frame_id;
  record.version = packageVersion();
  record.map_checksum = MapChecksum(map).value();
  record.options = optionText(question.options);
  record.pose_spacing = question.pose_spacing;
  record.start = numbersOf(question.request.start);
  record.goal = numbersOf(question.request.goal);
  if (question.request.any_goal_heading) record.goal[3] = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Vector3d& via : question.request.via)
    record.via_points.insert(record.via_points.end(), {via.x(), via.y(), via.z()});
  record.best_order = question.request.order == ViaOrder::BEST;
  record.status = std::string(toString(plan.status));
  record.message = plan.message;
  record.answered_by = plan.answered_by;
  record.cost = plan.costValue();
  for (const Pose& pose : poses.poses) {
    const Numbers numbers = numbersOf(pose);
    record.poses.insert(record.poses.end(), numbers.begin(), numbers.end());
  }
  return record;
}

PlanQuestion questionOf(const PlanRecord& record) {
  if (record.poses.size() % 4 != 0 || record.via_points.size() % 3 != 0)
    throw InputError("its lists of numbers are no poses");
  if (!(record.pose_spacing >= -1.0 && record.pose_spacing <= kWidestSpacing))
    throw InputError("its pose_spacing is " + std::to_string(record.pose_spacing));
  Numbers goal = record.goal;
  const bool any_goal_heading = std::isnan(goal[3]);
  if (any_goal_heading) goal[3] = record.start[3];
  checkPlaces(record.start);
  checkPlaces(goal);
  checkPlaces(record.via_points);
  PlanQuestion question;
  question.options = optionsFrom(record.options);
  question.pose_spacing = record.pose_spacing;
  question.request.start = poseOf(record.start);
  question.request.goal = poseOf(goal);
  question.request.any_goal_heading = any_goal_heading;
  for (std::size_t i = 0; i < record.via_points.size(); i += 3)
    question.request.via.emplace_back(record.via_points[i], record.via_points[i + 1],
                                      record.via_points[i + 2]);
  if (record.best_order) question.request.order = ViaOrder::BEST;
  return question;
}

Path posesAlong(const Plan& plan, const OccupancyGrid& map, double pose_spacing,
                HeadingMode heading) {
  const double spacing = pose_spacing < 0.0 ? map.geometry().resolution() : pose_spacing;
  return spacedPoses(plan.path, spacing, heading);
}

const char* packageVersion() {
  return GPP_VERSION;
}

}  // namespace grid_path_planner::nodes
