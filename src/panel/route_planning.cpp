#include "panel/route_planning.h"

#include <utility>

namespace grid_path_planner::panel {

void RoutePlanning::ask(const RoutePoints& points, bool best_order) {
  wanted_ = PlanRequest{0, points, best_order};
}

std::optional<PlanRequest> RoutePlanning::next(double now) {
  if (sent_ || !wanted_) return std::nullopt;
  sent_ = true;
  last_sign_ = now;
  std::optional<PlanRequest> request = std::exchange(wanted_, std::nullopt);
  request->id = ++id_;
  return request;
}

void RoutePlanning::heard(unsigned id, double now) {
  if (sent_ && id == id_) last_sign_ = now;
}

bool RoutePlanning::take(unsigned id, const PlanAnswer& answer, double now) {
  if (!sent_ || id != id_) return false;
  sent_ = false;
  last_sign_ = now;
  if (wanted_) return false;  // the points are others by now
  outcome_ = answer;
  return true;
}

void RoutePlanning::giveUp(base::Status status, const std::string& message) {
  wanted_.reset();
  sent_ = false;
  outcome_ = PlanAnswer();
  outcome_.status = toString(status);
  outcome_.message = message;
}

bool RoutePlanning::overdue(double now) const {
  return sent_ && now - last_sign_ > kPatience;
}

}  // namespace grid_path_planner::panel
