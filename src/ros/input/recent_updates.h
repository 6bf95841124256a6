// Updates of a map that have come, for a whole map that was sent before them and comes after them: it has another
// connection, and takes as long as 16 MB take. Such a map is used withUpdates() that are newer than it.
//
// Not thread-safe.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/time.h>

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

namespace grid_path_planner::nodes {

class RecentUpdates {
 public:
  using Update = map_msgs::OccupancyGridUpdate::ConstPtr;

  // `publisher`: the node. The oldest are forgotten beyond 16 MB and 1,000 updates; one with values, or the name of a frame, that no
  // map has, stamped 0, or more than kMostAhead after `now`, which would be newer than every map to come, is not kept.
  void keep(const std::string& publisher, const Update& update, const ros::Time& now);
  // Those of `publisher` that are stamped later than `stamp` and no later than
  // `until`, in the order in which they came; none where `stamp` is 0, of no
  // time.
  std::vector<Update> since(const std::string& publisher, const ros::Time& stamp,
                            const ros::Time& until = ros::TIME_MAX) const;
  // A map of `publisher` that is stamped so was taken: all but since() are forgotten.
  void forgetBefore(const std::string& publisher, const ros::Time& stamp, const ros::Time& now);
  // Whether since() would have all of these that have come.
  bool complete(const ros::Time& stamp) const { return forgotten_ <= stamp; }

 private:
  struct Kept {
    std::string publisher;
    Update update;
  };

  static bool isSince(const Kept& kept, const std::string& publisher, const ros::Time& stamp);
  void forgetLaterThan(const std::string& publisher, const ros::Time& stamp);
  void forgetTheOldest();
  void noteForgotten(const Update& update);

  std::deque<Kept> kept_;
  std::size_t bytes_ = 0;
  ros::Time forgotten_;  // stamp of the newest that was
};

// `map` with the cells of `updates`, but of those that do not lie in it, or are of another frame.
nav_msgs::OccupancyGrid withUpdates(nav_msgs::OccupancyGrid map,
                                    const std::vector<RecentUpdates::Update>& updates);

}  // namespace grid_path_planner::nodes
