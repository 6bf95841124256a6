#include "ros/guard/scheduling/guarded_timer.h"

#include <utility>

#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {
namespace {

ros::SteadyTimer timer(const ros::NodeHandle& nh, double period, std::function<void()> work,
                       bool once) {
  return nh.createSteadyTimer(
      ros::WallDuration(period),
      [work = std::move(work)](const ros::SteadyTimerEvent&) {
        guarded("What a timer calls", work);
      },
      once);
}

}  // namespace

ros::SteadyTimer guardedTimer(const ros::NodeHandle& nh, double period,
                              std::function<void()> work) {
  return timer(nh, period, std::move(work), false);
}

ros::SteadyTimer guardedTimerOnce(const ros::NodeHandle& nh, double delay,
                                  std::function<void()> work) {
  return timer(nh, delay, std::move(work), true);
}

}  // namespace grid_path_planner::nodes
