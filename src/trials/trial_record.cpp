#include "trials/trial_record.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "grid_path_planner/base/errors.h"
#include "study/json_numbers.h"

namespace grid_path_planner::trials {
namespace {

using nlohmann::json;
using study::wholeNumberOf;

template <class Vector>
json arrayOf(const Eigen::MatrixBase<Vector>& values) {
  json array = json::array();
  for (int i = 0; i < values.size(); ++i) array.push_back(values[i]);
  return array;
}

// Six digits are more than anybody looks at.
json roundedArray(const std::vector<double>& values) {
  json array = json::array();
  for (const double value : values) array.push_back(std::round(1e3 * value) / 1e3);
  return array;
}

json jsonOf(const CameraPose& pose) {
  json array = arrayOf(pose.position);
  for (int i = 0; i < 4; ++i) array.push_back(pose.attitude.coeffs()[i]);
  return array;
}

CameraPose cameraPose(const json& array) {
  CameraPose pose;
  for (int i = 0; i < 3; ++i) pose.position[i] = array.at(i).get<double>();
  for (int i = 0; i < 4; ++i) pose.attitude.coeffs()[i] = array.at(3 + i).get<double>();
  return pose;
}

json jsonOf(const PoseError& error) {
  return {error.metres, error.degrees};
}

PoseError poseError(const json& array) {
  return {array.at(0).get<double>(), array.at(1).get<double>()};
}

json jsonOf(const JointPose& pose) {
  const Eigen::Map<const Eigen::Matrix<double, 36, 1>> covariance(pose.covariance.data());
  return {{"camera", jsonOf(pose.camera)}, {"covariance", arrayOf(covariance)}};
}

JointPose jointPose(const json& object) {
  JointPose pose{cameraPose(object.at("camera")), {}};
  for (int i = 0; i < 36; ++i) pose.covariance(i) = object.at("covariance").at(i).get<double>();
  return pose;
}

template <class T>
json orNull(const std::optional<T>& value) {
  return value ? jsonOf(*value) : json(nullptr);
}

json jsonOf(const ViewSolution& solution) {
  return {{"markers", solution.markers},
          {"mean", orNull(solution.mean)},
          {"joint", orNull(solution.joint)},
          {"panel",
           {jsonOf(solution.panel.mean), jsonOf(solution.panel.sequential),
            orNull(solution.panel.joint)}}};
}

ViewSolution viewSolution(const json& object) {
  ViewSolution solution;
  solution.markers = wholeNumberOf<decltype(solution.markers)>(object.at("markers"));
  if (!object.at("mean").is_null()) solution.mean = cameraPose(object.at("mean"));
  if (!object.at("joint").is_null()) solution.joint = jointPose(object.at("joint"));
  const json& panel = object.at("panel");
  solution.panel.mean = poseError(panel.at(0));
  solution.panel.sequential = poseError(panel.at(1));
  if (!panel.at(2).is_null()) solution.panel.joint = poseError(panel.at(2));
  return solution;
}

json jsonOf(const ErrorSpread& spread) {
  return {spread.metres, spread.metres_deviation, spread.degrees, spread.degrees_deviation,
          spread.count};
}

// Of nothing it is NaN, which JSON has no number for.
ErrorSpread errorSpread(const json& array) {
  const auto count = wholeNumberOf<int>(array.at(4));
  if (count == 0) return {};
  return {array.at(0).get<double>(), array.at(1).get<double>(), array.at(2).get<double>(),
          array.at(3).get<double>(), count};
}

double orNan(const json& value) {
  return value.is_null() ? NAN : value.get<double>();
}

json jsonOf(const RowResult& row) {
  json rpe = json::array(), nis = json::array();
  for (const auto& error : row.rpe) rpe.push_back(orNull(error));
  for (const NisMean& of : row.nis) nis.push_back({of.mean, of.count});
  return {{"markers", jsonOf(row.markers)},
          {"in_view", jsonOf(row.in_view)},
          {"all", jsonOf(row.all)},
          {"smoothness", row.smoothness},
          {"position_smoothness", row.position_smoothness},
          {"ate", row.ate},
          {"rpe", rpe},
          {"nees", roundedArray(row.nees)},
          {"pose_nees", roundedArray(row.pose_nees)},
          {"nis", nis},
          {"gated", row.gated},
          {"resets", row.resets},
          {"fault_end", jsonOf(row.fault_end)},
          {"fault_nees", row.fault_nees}};
}

RowResult rowResult(const json& object) {
  RowResult row;
  row.markers = errorSpread(object.at("markers"));
  row.in_view = errorSpread(object.at("in_view"));
  row.all = errorSpread(object.at("all"));
  row.smoothness = orNan(object.at("smoothness"));
  row.position_smoothness = orNan(object.at("position_smoothness"));
  row.ate = orNan(object.at("ate"));
  for (std::size_t i = 0; i < row.rpe.size(); ++i)
    if (const json& error = object.at("rpe").at(i); !error.is_null()) row.rpe[i] = poseError(error);
  object.at("nees").get_to(row.nees);
  object.at("pose_nees").get_to(row.pose_nees);
  for (std::size_t i = 0; i < row.nis.size(); ++i)
    row.nis[i] = {object.at("nis").at(i).at(0).get<double>(),
                  wholeNumberOf<int>(object.at("nis").at(i).at(1))};
  row.gated = wholeNumberOf<decltype(row.gated)>(object.at("gated"));
  row.resets = wholeNumberOf<decltype(row.resets)>(object.at("resets"));
  const json& fault_end = object.at("fault_end");
  row.fault_end = {orNan(fault_end.at(0)), orNan(fault_end.at(1))};
  row.fault_nees = orNan(object.at("fault_nees"));
  return row;
}

template <class Read>
auto fromLine(const std::string& line, const char* what, const Read& read) {
  try {
    return read(json::parse(line));
  } catch (const json::exception& error) {
    throw base::InputError(std::string("is not the line of ") + what + ": " + error.what());
  }
}

}  // namespace

std::string lineOf(const SeenFrame& frame) {
  json solutions = json::array();
  for (const ViewSolution& solution : frame.solutions) solutions.push_back(jsonOf(solution));
  return json{
      {"frame", frame.frame}, {"turbid", frame.water == Water::TURBID}, {"solutions", solutions}}
      .dump();
}

std::string lineOf(const RunRecord& run) {
  json rows = json::array();
  for (const RowResult& row : run.rows) rows.push_back(jsonOf(row));
  return json{{"set", run.set}, {"seed", run.seed}, {"rows", rows}}.dump();
}

std::string lineOf(const RowRecord& row) {
  return json{{"row", row.row}, {"result", jsonOf(row.result)}}.dump();
}

bool isFrameLine(const std::string& line) {
  return line.rfind("{\"frame\"", 0) == 0;
}

SeenFrame frameFromLine(const std::string& line) {
  return fromLine(line, "an image", [](const json& object) {
    SeenFrame frame;
    frame.frame = wholeNumberOf<decltype(frame.frame)>(object.at("frame"));
    frame.water = object.at("turbid").get<bool>() ? Water::TURBID : Water::CLEAR;
    for (const json& solution : object.at("solutions"))
      frame.solutions.push_back(viewSolution(solution));
    return frame;
  });
}

RunRecord runFromLine(const std::string& line) {
  return fromLine(line, "a run", [](const json& object) {
    RunRecord run;
    run.set = wholeNumberOf<decltype(run.set)>(object.at("set"));
    run.seed = wholeNumberOf<decltype(run.seed)>(object.at("seed"));
    for (const json& row : object.at("rows")) run.rows.push_back(rowResult(row));
    return run;
  });
}

RowRecord rowFromLine(const std::string& line) {
  return fromLine(line, "a row", [](const json& object) {
    return RowRecord{object.at("row").get<std::string>(), rowResult(object.at("result"))};
  });
}

}  // namespace grid_path_planner::trials
