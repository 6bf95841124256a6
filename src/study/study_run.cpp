#include "study/study_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "grid_path_planner/base/errors.h"
#include "study/json_numbers.h"

namespace grid_path_planner::study {

using base::InputError, base::Status;
using grid::Cell;

namespace {

using nlohmann::json;

Status statusOf(const std::string& name) {
  if (const auto status = base::statusFromName(name)) return *status;
  throw InputError("no status is called '" + name + "'");
}

json jsonOf(Cell cell) {
  return {cell.column, cell.row};
}

Cell cellFrom(const json& pair) {
  return {wholeNumberOf<int>(pair.at(0)), wholeNumberOf<int>(pair.at(1))};
}

// JSON has no infinity: null stands for it.
json orNull(double value) {
  return std::isfinite(value) ? json(value) : json();
}

double orInfinity(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

}  // namespace

std::string lineOf(const StudyRun& run) {
  return json{{"setting", run.setting},
              {"query", run.query},
              {"variant", run.variant},
              {"start", jsonOf(run.start)},
              {"goal", jsonOf(run.goal)},
              {"note", run.note},
              {"status", std::string(toString(run.status))},
              {"message", run.message},
              {"cost", run.cost},
              {"optimum", run.optimum},
              {"length_m", run.length_m},
              {"turning_rad", run.turning_rad},
              {"clearance_m", orNull(run.clearance_m)},
              {"unknown_m", run.unknown_m},
              {"occupied_m", run.occupied_m},
              {"cells", run.cells},
              {"border_cells", run.border_cells},
              {"expanded", run.expanded},
              {"generated", run.generated},
              {"bytes", run.bytes},
              {"preparation_ms", run.preparation_ms},
              {"times_ms", run.times_ms},
              {"path_xy", run.path_xy}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

StudyRun runFromLine(const std::string& line) {
  try {
    const json object = json::parse(line);
    StudyRun run;
    run.setting = wholeNumberOf<decltype(run.setting)>(object.at("setting"));
    run.query = wholeNumberOf<decltype(run.query)>(object.at("query"));
    run.variant = wholeNumberOf<decltype(run.variant)>(object.at("variant"));
    run.start = cellFrom(object.at("start"));
    run.goal = cellFrom(object.at("goal"));
    object.at("note").get_to(run.note);
    run.status = statusOf(object.at("status").get<std::string>());
    object.at("message").get_to(run.message);
    object.at("cost").get_to(run.cost);
    object.at("optimum").get_to(run.optimum);
    object.at("length_m").get_to(run.length_m);
    object.at("turning_rad").get_to(run.turning_rad);
    run.clearance_m = orInfinity(object.at("clearance_m"));
    object.at("unknown_m").get_to(run.unknown_m);
    object.at("occupied_m").get_to(run.occupied_m);
    run.cells = wholeNumberOf<decltype(run.cells)>(object.at("cells"));
    run.border_cells = wholeNumberOf<decltype(run.border_cells)>(object.at("border_cells"));
    run.expanded = wholeNumberOf<decltype(run.expanded)>(object.at("expanded"));
    run.generated = wholeNumberOf<decltype(run.generated)>(object.at("generated"));
    run.bytes = wholeNumberOf<decltype(run.bytes)>(object.at("bytes"));
    object.at("preparation_ms").get_to(run.preparation_ms);
    object.at("times_ms").get_to(run.times_ms);
    object.at("path_xy").get_to(run.path_xy);
    if (run.times_ms.empty()) throw InputError("a run without times");
    return run;
  } catch (const json::exception& error) {
    throw InputError(std::string("is no run of a study: ") + error.what());
  }
}

}  // namespace grid_path_planner::study
