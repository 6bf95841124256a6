// The action `plan_path`: a path for a program that wants feedback while it is planned, or to cancel
// it.
//
// One goal at a time: a new one cancels the one before. A cancelled goal is answered within 100 ms,
// whatever the planning thread is doing. FOUND succeeds, CANCELLED is preempted, every other
// status is aborted with its sentence.
#pragma once

#include <actionlib/server/simple_action_server.h>
#include <ros/node_handle.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "grid_path_planner/PlanPathAction.h"
#include "ros/planning/planning_server.h"

namespace actionlib {

// With the stamps of action_topics.h.
template <>
void ActionServer<grid_path_planner::PlanPathAction>::initialize();

}  // namespace actionlib

namespace grid_path_planner::nodes {

class PlanAction {
 public:
  // `server` outlives this, and its stop() is called before the destructor.
  PlanAction(const ros::NodeHandle& nh, PlanningServer& server);
  ~PlanAction();
  PlanAction(const PlanAction&) = delete;
  PlanAction& operator=(const PlanAction&) = delete;

 private:
  void onGoal();
  void run();
  bool waitForGoal();
  bool endsWithin(double seconds);
  void answerNext();
  void giveUp(const std::string& error);
  void answer(const PlanPathGoal& goal);
  bool answeredUncancelled(PlanTicket& ticket);
  void finish(const planning::Plan& plan, const path::Path& poses, const PlanStatistics& statistics,
              const planning::ViaPlan& via);

  PlanningServer& server_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool goal_came_ = false;
  bool ends_ = false;
  actionlib::SimpleActionServer<PlanPathAction> action_;
  std::thread thread_;
};

}  // namespace grid_path_planner::nodes
