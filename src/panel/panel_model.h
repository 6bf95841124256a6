// What the panel shows and what may be pressed, whatever other nodes do or fail to do.
//
//   PanelModel model;
//   model.setPlanners(1);                                   // nodes that offer plan_path
//   model.place({RoutePoints::Kind::GOAL}, "map", goal);
//   model.plan();
//   if (const auto request = model.tick(now)) use(*request);   // sent; ten times a second
//   model.planAnswered(id, answer, now);
//   use(model.sentence(), model.buttons());
//
// Guaranteed: no state is for ever. A planner that is gone, is restarted or falls silent ends what
// was asked of it with a sentence, and so does a driver; calls of services end with callEnded(), which the caller gives at
// its deadline. `now` is in seconds of a clock that does not go back. Text of others is cleaned.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "panel/drive_progress.h"
#include "panel/route_planning.h"
#include "panel/route_points.h"

namespace grid_path_planner::panel {

enum class Call { NONE, COMPARE, EXPLAIN };
enum class Tone { CALM, BUSY, GOOD, BAD };

struct Buttons {
  bool plan = false, compare = false, explain = false;
  bool drive = false, pause = false, resume = false, cancel = false;
  bool save = false;
};

struct DriveFeedback {
  std::string state;  // driving, paused, ...
  unsigned waypoint = 0;
  double remaining = 0.0;  // m
  double time = 0.0;       // s of the clock that the vehicle drives by
};

class PanelModel {
 public:
  // ---- Who is there: nodes that listen to the goals of plan_path and navigate_path
  void setPlanners(std::size_t count);
  void setDrivers(std::size_t count);

  // ---- The points. With a plan shown, or wanted, it is planned anew where they are now.
  void place(RoutePoints::Id id, const std::string& frame, const path::Pose& pose);
  void addVia(const std::string& frame, const path::Pose& pose);
  void startAtVehicle();
  void removeLastVia();
  // Whether via-points are passed in the order that costs least instead of the one in which they were set.
  void setBestOrder(bool best);
  void clear();
  const RoutePoints& points() const { return points_; }

  // ---- Planning. Without effect where buttons() says no.
  void plan();
  std::optional<PlanRequest> tick(double now);
  void planHeard(unsigned id, const std::string& phase, double now);
  void planAnswered(unsigned id, const PlanAnswer& answer, double now);
  // A plan of somebody else's, such as for a goal of 2D Nav Goal: told unless one of the panel's own
  // has just been.
  void otherPlan(const PlanAnswer& answer, double now);
  // Its answer would be passed over: the request to be cancelled at the planner, if any.
  unsigned cancelPlan();
  // The path of a waypoint file takes the place of a plan.
  void loaded(const std::string& file, const path::Path& path);
  // A parameter of the planner is another one.
  void planAgain();

  // ---- Services, of which one may be pending.
  void callBegan(Call call);
  void callEnded(Tone tone, const std::string& sentence);

  // ---- Driving. `goal` is the action's id. What is heard of a goal that has ended is passed over, and a
  // drive that nothing is heard of for kPatienceWithDrives seconds is LOST, until there is more of it.
  static constexpr double kPatienceWithDrives = 3.0;  // s; a driver speaks every 0.2 s
  void driveSent(const std::string& goal, double now);
  void driveHeard(const std::string& goal, const DriveFeedback& feedback, double now);
  // The drives of another vehicle are shown from here on.
  void leaveDriver();
  void driveEnded(const std::string& goal, bool arrived, const std::string& status,
                  const std::string& message);

  // ---- What is shown
  void say(Tone tone, const std::string& sentence);
  const std::string& sentence() const { return sentence_; }
  Tone tone() const { return tone_; }
  Buttons buttons() const;
  const path::Path& path() const { return path_; }
  // "weighted_jump_point: cost 12.5, 10.2 m, ..."; "" before the first plan
  const std::string& figures() const { return figures_; }
  std::string nodesText() const;
  std::string driveText() const;
  const DriveProgress& progress() const { return progress_; }
  // Grows with each change of points or path: what is drawn is to be drawn anew.
  unsigned revision() const { return revision_; }

 private:
  void pointsChanged(const std::string& complaint);
  void showOutcome();
  void standStill(const std::string& state);
  void loseDrive(const std::string& why);

  std::size_t planners_ = 0, drivers_ = 0;
  RoutePoints points_;
  RoutePlanning planning_;
  bool best_order_ = false;
  bool follows_ = false;    // the plan follows the points
  double answered_ = -1e9;  // s, when it was last
  Call call_ = Call::NONE;
  bool driving_ = false;
  std::string driven_;             // the goal
  double drive_heard_ = 0.0;       // s, when it was last
  std::deque<std::string> ended_;  // goals; the last ones
  std::string drive_state_;
  unsigned waypoint_ = 0;
  DriveProgress progress_;
  path::Path path_;
  std::string sentence_ = "Set a goal with the tool Plan Goal, then press Plan", figures_;
  Tone tone_ = Tone::CALM;
  unsigned revision_ = 1;
};

}  // namespace grid_path_planner::panel
