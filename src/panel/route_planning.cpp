#include "panel/route_planning.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace grid_path_planner::panel {

using path::Pose;

namespace {

constexpr double kSamePlace = 1e-9;  // m

std::string nameOfLeg(std::size_t leg, std::size_t count) {
  if (leg + 1 == count) return "from the last via-point to the goal";
  return "to via-point " + std::to_string(leg + 1);
}

}  // namespace

void RoutePlanning::ask(const RoutePoints& points) {
  wanted_ = points;
}

void RoutePlanning::begin() {
  legs_ = wanted_->legs();
  frame_ = wanted_->frame();
  wanted_.reset();
  leg_ = 0;
  joined_ = PlanAnswer();
  joined_.figures.clearance = std::numeric_limits<double>::infinity();
}

std::optional<PlanRequest> RoutePlanning::next(double now) {
  if (sent_) return std::nullopt;
  if (wanted_) begin();
  if (legs_.empty()) return std::nullopt;
  sent_ = true;
  last_sign_ = now;
  return PlanRequest{++id_, frame_, legs_[leg_]};
}

void RoutePlanning::heard(unsigned id, double now) {
  if (sent_ && id == id_) last_sign_ = now;
}

bool RoutePlanning::take(unsigned id, const PlanAnswer& answer, double now) {
  if (!sent_ || id != id_) return false;
  sent_ = false;
  last_sign_ = now;
  if (wanted_) return false;  // the points are others by now
  if (!answer.found()) {
    const std::string where = legs_.size() > 1 ? nameOfLeg(leg_, legs_.size()) + ": " : "";
    giveUp(answer.status, where + answer.message);
    outcome_.figures = answer.figures;
    return true;
  }
  join(answer);
  if (++leg_ < legs_.size()) return false;
  if (legs_.size() == 1) joined_.message = answer.message;
  outcome_ = std::move(joined_);
  legs_.clear();
  return true;
}

void RoutePlanning::join(const PlanAnswer& answer) {
  std::vector<Pose>& poses = joined_.path.poses;
  const std::vector<Pose>& added = answer.path.poses;
  const bool again = !poses.empty() && !added.empty() &&
                     (poses.back().position - added.front().position).norm() < kSamePlace;
  poses.insert(poses.end(), added.begin() + (again ? 1 : 0), added.end());
  joined_.path.frame_id = answer.path.frame_id;
  joined_.status = answer.status;
  joined_.message = "a path through " + std::to_string(legs_.size() - 1) + " via-points";
  PlanFigures& sum = joined_.figures;
  sum.planner = answer.figures.planner;
  sum.cost += answer.figures.cost;
  sum.length += answer.figures.length;
  sum.turning += answer.figures.turning;
  sum.clearance = std::min(sum.clearance, answer.figures.clearance);
  sum.expanded += answer.figures.expanded;
  sum.time += answer.figures.time;
}

void RoutePlanning::giveUp(const std::string& status, const std::string& message) {
  wanted_.reset();
  legs_.clear();
  sent_ = false;
  outcome_ = PlanAnswer();
  outcome_.status = status;
  outcome_.message = message;
}

bool RoutePlanning::overdue(double now) const {
  return sent_ && now - last_sign_ > kPatience;
}

}  // namespace grid_path_planner::panel
