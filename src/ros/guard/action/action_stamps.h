// Goals and cancels of an action in the order in which they come, and cancels as their senders mean them.
//
//   ActionStamps stamps;
//   goal_id.stamp = stamps.ofGoal(goal_id.stamp, ros::Time::now());
//
// actionlib orders goals by the stamps that their senders give. One goal stamped 2^32 - 1 s makes a
// SimpleActionServer refuse every later one, as does /clock that begins anew; a cancel stamped so
// cancels every later one; and where its id is unknown, no status is published any more. A cancel with a stamp is of all
// goals that are stamped until then: of those that came, by the senders' stamps, which are remembered; one that comes
// after its cancel has overtaken it is cancelled, too. One whose stamp is more than 10 s before that cancel's was not overtaken:
// no message is in transit that long, so its sender's clock is another. Stamps that are ahead of the time here are of no clock.
#pragma once

#include <ros/time.h>

#include <algorithm>
#include <deque>

#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {

class ActionStamps {
 public:
  // Above all that were given out before; now, where that is. The least of all for one that a cancel overtook. At the end
  // of what a ros::Time can hold, which /clock may say, they are equal.
  ros::Time ofGoal(ros::Time given, ros::Time now) {
    given = normalized(given);
    now = normalized(now);
    const double before = secondsBetween(given, cancelled_until_);
    if (!given.isZero() && before > 0.0 && before <= kLongestInTransit) return ros::TIME_MIN;
    const ros::Time stamp = next(now);
    goals_.push_back({given.isZero() || given > now ? now : given, stamp});
    if (goals_.size() > kMostGoals) goals_.pop_front();
    return stamp;
  }
  // That of the last goal which is meant. One that is ahead means everything that has come. 0 stays: it means the goal of
  // the cancel's id.
  ros::Time ofCancel(ros::Time given, ros::Time now) {
    given = normalized(given);
    now = normalized(now);
    if (given.isZero()) return given;
    if (given > now) return next(now);
    cancelled_until_ = std::max(cancelled_until_, given);
    ros::Time stamp = given;
    for (const Goal& goal : goals_)
      if (goal.given <= given) stamp = std::max(stamp, goal.stamp);
    last_ = std::max(last_, stamp);
    return stamp;
  }
  // Senders' stamps from before are of no order with those from after.
  void timeWentBack() {
    goals_.clear();
    cancelled_until_ = {};
  }

 private:
  struct Goal {
    ros::Time given;  // by its sender, or when it came
    ros::Time stamp;
  };
  static constexpr double kLongestInTransit = 10.0;  // s
  static constexpr std::size_t kMostGoals = 50;  // of which the last are meant by whoever cancels

  ros::Time next(const ros::Time& now) {
    last_ = std::max(now, last_ == ros::TIME_MAX ? last_ : last_ + ros::Duration(0, 1));
    return last_;
  }

  ros::Time last_;
  ros::Time cancelled_until_;  // by senders' stamps
  std::deque<Goal> goals_;
};

}  // namespace grid_path_planner::nodes
