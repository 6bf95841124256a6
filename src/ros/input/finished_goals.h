// Which goals of the topic `path` the vehicle still drives for: a drive that is over is not begun
// again by itself when a path for its goal is planned anew.
//
//   FinishedGoals goals;
//   const nav_msgs::Path path;
//   if (!goals.isOver(path)) goals.drive(path);
//   goals.end();                                 // arrived
//   const bool is_driven = !goals.isOver(path);  // planned again: no
//
// path_planner stamps the last pose of a path with the time at which it got the goal, so that paths of
// one goal are told from those of the next. Paths whose other poses have not the path's stamp, or whose last one has
// none, are of others: they are driven. Not guaranteed: anything where the clocks of two machines differ by
// more than tf would bear.
#pragma once

#include <nav_msgs/Path.h>
#include <ros/time.h>

namespace grid_path_planner::nodes {

class FinishedGoals {
 public:
  // `path` is driven from now on.
  void drive(const nav_msgs::Path& path);
  // The drive for that path's goal is over.
  void end();
  // Somebody ended the drive at `now`: its goal is over, and what was asked for until half a second before, also
  // where no path was found yet.
  void endAllUntil(const ros::Time& now);
  // Time went back, which ended the drive: goals from before are over. path_planner stamps them TIME_MIN from then on;
  // until it has noticed, they are those that are later than their path.
  void timeWentBack();

  bool isOver(const nav_msgs::Path& path) const;

 private:
  ros::Time driven_;
  ros::Time ended_;
  ros::Time until_;
  bool went_back_ = false;
};

}  // namespace grid_path_planner::nodes
