// A planner inside another program that keeps the costmap: what the plugins of move_base and of Move
// Base Flex have in common.
//
//   PlannerAdapter adapter(ros::NodeHandle("~/GridPathPlanner"), "map");
//   const PlannerAdapter::Answer answer = adapter.makePlan(start, goal, std::nullopt,
//       [&](planning::CostPlanner& planner) { planner.setCosts(geometry, cells, inscribed_radius); });
//   adapter.cancel();  // in another thread
//
// Reads AdapterOptions of the namespace, offers them to dynamic_reconfigure and publishes every plan
// as `plan` in it. A failure is logged as a WARN when its sentence is another one than before, once in
// a second at most.
// Calls of makePlan() in several threads wait for one another; cancel() waits for nothing.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/planning/plan.h"
#include "planning/cost_planner.h"
#include "ros/adapters/adapter_options.h"
#include "ros/guard/scheduling/log_throttle.h"

namespace grid_path_planner::nodes {

class PlannerAdapter {
 public:
  // Gives the present costs; called in makePlan(), in its thread.
  using GiveCosts = std::function<void(planning::CostPlanner&)>;

  struct Answer {
    base::Status status = base::Status::NO_MAP;
    std::string message;
    double cost = 0.0;  // weight x cells
    std::vector<geometry_msgs::PoseStamped> poses;

    bool found() const { return status == base::Status::FOUND; }
  };

  // `frame_id`: of the costmap. Throws InputError naming the parameter that cannot be used.
  PlannerAdapter(const ros::NodeHandle& private_nh, const std::string& frame_id);
  ~PlannerAdapter();

  // The poses are in the costmap's frame, else TRANSFORM_ERROR. The start may tilt, as vehicles do.
  // `tolerance`: metres; none: the parameter default_tolerance. Whatever fails, memory too, is an answer:
  // an exception would end the thread of move_base that plans, and move_base with it.
  Answer makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                  std::optional<double> tolerance, const GiveCosts& give_costs);

  // Ends the calls of makePlan() that plan or wait, with CANCELLED.
  void cancel();

 private:
  class Active;
  class Reconfiguration;

  planning::Plan plan(const geometry_msgs::PoseStamped& start,
                      const geometry_msgs::PoseStamped& goal, std::optional<double> tolerance,
                      const GiveCosts& give_costs, const base::StopSource& stop);
  Answer answerTo(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                  std::optional<double> tolerance, const GiveCosts& give_costs,
                  const base::StopSource& stop);
  void takeOptions();
  Answer answerOf(planning::Plan plan);
  void log(const Answer& answer);

  const std::string frame_id_;
  ros::Publisher plan_;
  std::mutex planning_;  // of what makePlan() uses
  AdapterOptions options_;
  planning::CostPlanner planner_;
  LogThrottle seldom_{1.0};
  std::string last_failure_;  // of which the log has told
  std::mutex mutex_;          // of what follows, held for no longer than it takes to read and write
  std::list<base::StopSource> active_;
  std::optional<AdapterOptions> wanted_;  // since the last plan
  std::unique_ptr<Reconfiguration> reconfiguration_;
};

}  // namespace grid_path_planner::nodes
