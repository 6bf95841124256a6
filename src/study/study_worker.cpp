#include "study/study_worker.h"

#include <chrono>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"
#include "study/study_planners.h"
#include "study/unfilled_border.h"

namespace grid_path_planner::study {

using base::InputError, base::Status, base::StopToken;
using costmap::CostmapOptions;
using grid::Cell, grid::OccupancyGrid;
using path::ClassLengths, path::clearanceOf, path::lengthsByClass, path::Path, path::Pose,
    path::turningOf;
using planners::SearchOptions;
using planning::PathPlanner, planning::Plan, planning::PlannerOptions, planning::PoseRequest;

namespace {

Pose poseOf(const OccupancyGrid& map, Cell cell) {
  Pose pose;
  pose.position << map.geometry().centre(cell), 0.0;
  return pose;
}

// The corners of the polyline; what lies straight between two of them is left out.
std::vector<float> cornersOf(const Path& path) {
  std::vector<float> corners;
  const auto at = [&path](std::size_t i) { return path.poses[i].position.head<2>(); };
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    if (i > 0 && i + 1 < path.poses.size()) {
      const Eigen::Vector2d before = at(i) - at(i - 1), after = at(i + 1) - at(i);
      const double cross = before.x() * after.y() - before.y() * after.x();
      if (std::abs(cross) < 1e-9 && before.dot(after) > 0.0) continue;
    }
    corners.push_back(static_cast<float>(at(i).x()));
    corners.push_back(static_cast<float>(at(i).y()));
  }
  return corners;
}

void fillQuestion(const StudyUnit& unit, const StudyQuery& query, StudyRun& run) {
  run.setting = unit.setting;
  run.query = unit.query;
  run.start = query.start;
  run.goal = query.goal;
  run.note = query.note;
}

void fillAnswer(const Plan& report, StudyRun& run) {
  run.status = report.status;
  run.message = report.message;
  run.expanded = report.statistics.expanded;
  run.generated = report.statistics.generated;
  run.bytes = report.statistics.search_bytes;
}

void fillPath(const Plan& report, const OccupancyGrid& map, const CostmapOptions& costmap,
              bool keep_path, StudyRun& run) {
  run.cost = report.costValue();
  run.length_m = report.length_m;
  run.turning_rad = turningOf(report.path);
  run.clearance_m = clearanceOf(report.path, map, costmap.thresholds);
  const ClassLengths lengths = lengthsByClass(report.path, map, costmap.thresholds);
  run.unknown_m = lengths.unknown_m;
  run.occupied_m = lengths.occupied_m;
  run.cells = report.cells;
  run.border_cells = unfilledBlocksOf(report.path, map.geometry(), costmap.kernel);
  if (keep_path) run.path_xy = cornersOf(report.path);
}

}  // namespace

PathPlanner StudyWorker::plannerFor(const StudySetting& setting,
                                    const StudyVariant& variant) const {
  PlannerOptions options = plan_.study().base;
  options.costmap = setting.costmap;
  options.planner = variant.planner;
  options.search = variant.search;
  options.retry_finer = false;  // what a kernel closes is a result here
  PathPlanner made(options, [cross = variant.published_cross](const std::string& name,
                                                              const SearchOptions& search) {
    return makeStudyPlanner(name, search, cross);
  });
  made.setMap(searched_);
  return made;
}

// What the planner itself does for a map, after the costmap that all planners share; 0 where it
// cannot be used on it, which every plan says then.
double StudyWorker::preparationTime(PathPlanner& planner) {
  try {
    planner.downsampledCosts(StopToken());
    const auto begin = StopToken::Clock::now();
    planner.finishPreparation(StopToken());
    return std::chrono::duration<double, std::milli>(StopToken::Clock::now() - begin).count();
  } catch (const InputError&) {
    return 0.0;
  }
}

void StudyWorker::prepare(std::size_t setting) {
  if (prepared_ == setting) return;
  planners_.clear();
  preparations_ms_.clear();
  const StudySetting& chosen = plan_.study().settings[setting];
  searched_ = plan_.mapOf(chosen);
  for (const StudyVariant& variant : plan_.study().variants) {
    planners_.push_back(plannerFor(chosen, variant));
    preparations_ms_.push_back(preparationTime(planners_.back()));
  }
  exact_ = std::make_unique<PathPlanner>(plannerFor(chosen, {"", "dijkstra", {}}));
  preparationTime(*exact_);
  prepared_ = setting;
}

std::vector<StudyRun> StudyWorker::run(const StudyUnit& unit) {
  prepare(unit.setting);
  const StudySetting& setting = plan_.study().settings[unit.setting];
  const OccupancyGrid& map = *plan_.map(setting.map);
  const StudyQuery& query = plan_.queries(setting.map)[unit.query];
  const PoseRequest request{poseOf(map, query.start), poseOf(map, query.goal), false};

  const Plan exact = exact_->plan(request);
  const std::size_t variants = planners_.size();
  std::vector<StudyRun> runs(variants);
  for (int repeat = 0; repeat < plan_.study().repeats; ++repeat)
    for (std::size_t turn = 0; turn < variants; ++turn) {
      const std::size_t variant = (turn + static_cast<std::size_t>(repeat)) % variants;
      StudyRun& run = runs[variant];
      const Plan report = planners_[variant].plan(request);
      run.times_ms.push_back(report.statistics.time_s * 1e3);
      if (repeat > 0) continue;
      run.variant = variant;
      run.preparation_ms = preparations_ms_[variant];
      fillQuestion(unit, query, run);
      fillAnswer(report, run);
      if (exact.status == Status::FOUND) run.optimum = exact.cost.toDouble();
      if (report.status == Status::FOUND)
        fillPath(report, map, setting.costmap, unit.query < kDrawnQueries, run);
    }
  return runs;
}

}  // namespace grid_path_planner::study
