// The parameters of the node `local_planner`.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/avoidance/pilot_options.h"
#include "ros/guard/scheduling/realtime_priority.h"
#include "ros/messages/zero_heading.h"

namespace grid_path_planner::nodes {

struct LocalPlannerOptions {
  std::string config_filename;
  std::string log;
  int log_limit = 4000;  // MB
  std::string cloud_topics;
  ZeroHeading zero_heading = ZeroHeading::REFUSED;
  avoidance::PilotOptions pilot;
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  double tf_timeout = 0.3;     // s
  double control_rate = 20.0;  // Hz, wall time
  int realtime_priority = 1;
  double master_timeout = 30.0;  // s, wall time
  bool share_cmd_vel = false;
};

template <class Visitor>
void visitOptions(LocalPlannerOptions& o, Visitor&& visit) {
  visit("config_filename", o.config_filename,
        base::OptionInfo{"Waypoint file to fly at the start, below the folder to load from; empty: "
                         "it waits for a goal or a path",
                         ""}
            .under("What is flown"));
  visitZeroHeading(o.zero_heading, visit);
  visit("log", o.log,
        base::OptionInfo{
            "File, name.flight below the folder to save in, for all that the pilot is given "
            "and answers, some 9 MB/s at 320x240; an old one is emptied; empty: none. "
            "grid_path flights --log repeats it",
            ""});
  visit("log_limit", o.log_limit,
        base::OptionInfo{"Beyond it the log ends; the flight goes on", "MB", 1, 1000000});
  visit("cloud_topics", o.cloud_topics,
        base::OptionInfo{
            "Topics of several sensors, separated by spaces, such as front/points rear/points, "
            "each with a camera_info beside it; the vehicle stops where one of them is "
            "silent. Empty: points and camera_info",
            ""});
  visitOptions(o.pilot, visit);
  visit("map_frame", o.map_frame,
        base::OptionInfo{"Frame in which is remembered and planned; its z points up", ""}.under(
            "The vehicle's pose"));
  visit("base_frame", o.base_frame,
        base::OptionInfo{"Frame of the vehicle, whose pose tf gives and in which it is commanded",
                         ""});
  visit(
      "tf_timeout", o.tf_timeout,
      base::OptionInfo{"The vehicle stops while its newest pose is older; a younger one is carried "
                       "on by the velocity. A path in another frame whose transform is older is "
                       "refused",
                       "s", 0.01, 1.0});
  visit("control_rate", o.control_rate,
        base::OptionInfo{"How often the velocity is computed, by the wall clock; at least once in "
                         "frame_period; PX4 wants more than 2",
                         "Hz", 2.0, 1000.0});
  visitRealtimePriority(o.realtime_priority, visit);
  visit("master_timeout", o.master_timeout,
        base::OptionInfo{"The vehicle stands when the ROS master has not answered for so long, by "
                         "the wall clock; 0: it flies on",
                         "s", 0.0, 86400.0});
  visit("share_cmd_vel", o.share_cmd_vel,
        base::OptionInfo{"Whether the node starts where another publishes cmd_vel too; true only "
                         "where the two never drive at once",
                         ""});
}

// Throws InputError naming the option for a value outside its limits, options that
// checkPilotOptions refuses, frames that are empty, and topics that are no names.
void checkLocalPlannerOptions(const LocalPlannerOptions& options);

// Names its frames as tf does: "/map" is "map".
void nameFrames(LocalPlannerOptions& options);

// Those of cloud_topics, or `points`.
std::vector<std::string> cloudTopics(const LocalPlannerOptions& options);
// camera_info beside a topic of clouds.
std::string cameraTopic(const std::string& cloud_topic);

}  // namespace grid_path_planner::nodes
