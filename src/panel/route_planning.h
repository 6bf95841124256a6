// One request for a plan after the other, of points that may change while it is answered.
//
//   planning.ask(points, best_order);
//   if (const auto request = planning.next(now)) use(*request);   // sent; at every tick
//   if (planning.take(id, answer, now)) use(planning.outcome());
//
// Guaranteed: one request is pending at a time, answers to others are passed over, and one that
// shows no sign of life for kPatience seconds is given up. What is asked for meanwhile (a point is
// dragged) is asked when the present request is answered; what came in between is left out.
#pragma once

#include <optional>
#include <string>

#include "grid_path_planner/base/status.h"
#include "panel/route_points.h"

namespace grid_path_planner::panel {

struct PlanRequest {
  unsigned id = 0;     // from 1
  RoutePoints points;  // with a goal
  bool best_order = false;
};

// Those of PlanStatistics that are shown.
struct PlanFigures {
  std::string planner;
  double cost = 0.0;
  double length = 0.0;     // m
  double turning = 0.0;    // rad
  double clearance = 0.0;  // m
  double expanded = 0.0;   // cells
  double time = 0.0;       // ms, of the searches
};

struct PlanAnswer {
  std::string status, message;  // FOUND, ... and a sentence
  path::Path path;              // empty unless FOUND
  PlanFigures figures;

  bool found() const { return base::statusFromName(status) == base::Status::FOUND; }
};

class RoutePlanning {
 public:
  static constexpr double kPatience = 10.0;  // s

  // `best_order`: the via-points are passed in the order that costs least. Precondition: there is a goal.
  void ask(const RoutePoints& points, bool best_order);
  // What is to be sent to the planner now, once. `now` in seconds of a clock that does not go back.
  std::optional<PlanRequest> next(double now);
  // The planner works on it.
  void heard(unsigned id, double now);
  // Whether that is the answer that was waited for: outcome() is new.
  bool take(unsigned id, const PlanAnswer& answer, double now);
  // Ends what runs and what waits, with this outcome.
  void giveUp(base::Status status, const std::string& message);
  bool overdue(double now) const;

  bool busy() const { return wanted_ || sent_; }
  // Of the request that is pending; 0: none.
  unsigned pending() const { return sent_ ? id_ : 0; }
  const PlanAnswer& outcome() const { return outcome_; }

 private:
  std::optional<PlanRequest> wanted_;
  bool sent_ = false;
  unsigned id_ = 0;
  double last_sign_ = 0.0;
  PlanAnswer outcome_;
};

}  // namespace grid_path_planner::panel
