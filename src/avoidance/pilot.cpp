#include "grid_path_planner/avoidance/pilot.h"

#include <utility>

#include "avoidance/pilot_parts.h"
#include "avoidance/sentence.h"

namespace grid_path_planner::avoidance {

using base::InputError;
using Eigen::Vector3d;

namespace {

constexpr double kFarthestGoal = 1e6;  // m
constexpr double kFarthestBin = 12.0;  // m

void checkPoint(const Vector3d& point, std::size_t index, const PilotOptions& options) {
  const std::string name = "waypoint " + std::to_string(index + 1);
  if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kFarthestGoal)
    throw InputError(name + " must be three finite numbers of at most 1e6 m");
  if (options.elevation && (point.z() < options.z_min || point.z() > options.z_max))
    throw InputError(name + " is at a height of " + shortNumber(point.z()) +
                     " m, outside the fence from " + shortNumber(options.z_min) + " to " +
                     shortNumber(options.z_max) + " m");
}

void checkPoints(const Points& points, const PilotOptions& options) {
  if (points.empty()) throw InputError("a route needs at least one waypoint");
  for (std::size_t i = 0; i < points.size(); ++i) checkPoint(points[i], i, options);
}

}  // namespace

Pilot::Pilot(const PilotOptions& options) {
  checkPilotOptions(options);
  parts_ = std::make_unique<Parts>(options);
}

Pilot::~Pilot() = default;

void Pilot::setOptions(const PilotOptions& options) {
  checkPilotOptions(options);
  parts_->options = options;
  parts_->finder.setOptions(options);
}

const PilotOptions& Pilot::options() const {
  return parts_->options;
}

void Pilot::setRoute(const Points& waypoints) {
  checkPoints(waypoints, parts_->options);
  parts_->route.setWaypoints(waypoints);
  parts_->start();
}

void Pilot::setPath(const Points& path) {
  checkPoints(path, parts_->options);
  parts_->route.setPath(path);
  parts_->start();
}

void Pilot::setMapPlan(MapPlan plan) {
  parts_->map_plan = std::move(plan);
}

void Pilot::cancel(const std::string& reason) {
  parts_->end(PilotStatus::CANCELLED, "cancelled: " + reason);
}

void Pilot::forget() {
  parts_->surroundings.forget();
}

PilotAnswer Pilot::update(const PilotInput& input) {
  return parts_->update(input);
}

void Pilot::see(const Frame& frame) {
  parts_->see(frame);
}

const Points& Pilot::path() const {
  return parts_->flown.points();
}

std::string Pilot::explain() const {
  const PilotAnswer now = parts_->answer();
  std::string text = std::string(toString(now.status)) + ": " + now.sentence;
  if (!parts_->flown.empty())
    text += "; the path has " + std::to_string(path().size()) + " points, of it " +
            shortNumber(now.clear_path) + " m are open";
  text += "; nearest point " + shortNumber(now.clearance) + " m, newest cloud " +
          shortNumber(now.frame_age) + " s old";
  return text + "; tried without progress: " + parts_->recovery.tried();
}

std::vector<RememberedPoint> Pilot::rememberedPoints() const {
  return parts_->surroundings.points();
}

HistogramView Pilot::histogram() const {
  const Directions directions(parts_->options.bin, parts_->options.elevation);
  Histogram histogram;
  histogram.fill(parts_->surroundings.space(), directions, parts_->position(), kFarthestBin);
  return {directions.columns(), directions.rows(), histogram.distances()};
}

bool Pilot::isOpen(const Vector3d& point) const {
  const OpenSpace& space = parts_->surroundings.space();
  return space.seen(point) &&
         space.nearest(point, parts_->options.d_safe) >= parts_->options.d_safe;
}

}  // namespace grid_path_planner::avoidance
