// Plays a bag with /clock, as fast as those follow who hear it: nothing depends on the speed of the machine.
//
//   BagPlayer player(nh, file);
//   player.play(until, [&](const ros::Time& now) { return isThere(now); });
#pragma once

#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <rosgraph_msgs/Clock.h>

#include <functional>
#include <map>
#include <string>

#include "ros/support/wait.h"

namespace grid_path_planner::test {

class BagPlayer {
 public:
  BagPlayer(ros::NodeHandle nh, const std::string& file)
      : bag_(file), view_(bag_), clock_(nh.advertise<rosgraph_msgs::Clock>("/clock", 10)) {
    for (const rosbag::ConnectionInfo* connection : view_.getConnections()) {
      ros::AdvertiseOptions options(connection->topic, 100, connection->md5sum,
                                    connection->datatype, connection->msg_def);
      publishers_[connection->topic] = nh.advertise(options);
    }
  }

  // Whether somebody listens to every topic and to the clock.
  bool isHeard() const {
    for (const auto& [topic, publisher] : publishers_)
      if (publisher.getNumSubscribers() == 0) return false;
    return clock_.getNumSubscribers() > 0;
  }

  // Sets the clock.
  void tell(const ros::Time& time) {
    now_ = time;
    rosgraph_msgs::Clock message;
    message.clock = time;
    clock_.publish(message);
  }

  void rewind() { next_ = view_.begin(); }

  // What the bag has before `until`. The clock steps on once `follows`; false where that does not come true in time.
  bool play(const ros::Time& until, const std::function<bool(const ros::Time&)>& follows) {
    for (; next_ != view_.end() && next_->getTime() < until; ++next_) {
      if (next_->getTime() != now_ && !stepTo(next_->getTime(), follows)) return false;
      publishers_.at(next_->getTopic()).publish(*next_);
    }
    return true;
  }

 private:
  bool stepTo(const ros::Time& time, const std::function<bool(const ros::Time&)>& follows) {
    tell(time);
    ros::WallDuration(0.001).sleep();
    return waitFor([&] { return follows(time); });
  }

  rosbag::Bag bag_;
  rosbag::View view_;
  rosbag::View::iterator next_ = view_.begin();
  ros::Publisher clock_;
  std::map<std::string, ros::Publisher> publishers_;
  ros::Time now_;
};

}  // namespace grid_path_planner::test
