// Options of the node map_publisher.
#pragma once

#include <string>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::nodes {

struct MapPublisherOptions {
  std::string filename;  // required
  std::string bag_topic;
  std::string frame_id = "map";
  std::string topic = "projected_map";
  base::ReadOptions reading;
};

template <class Visitor>
void visitOptions(MapPublisherOptions& o, Visitor&& visit) {
  visit("filename", o.filename,
        base::OptionInfo{
            "Map file below the folder to load from: map_server YAML, MovingAI .map, image, "
            "rostopic dump or bag; required, unless the node's argument names one",
            ""});
  visit("bag_topic", o.bag_topic,
        base::OptionInfo{
            "Topic of the map in a bag; empty: projected_map, or the only one that has maps", ""});
  visit("frame_id", o.frame_id, base::OptionInfo{"Frame that the map is published in", ""});
  visit("topic", o.topic,
        base::OptionInfo{"Latched topic that the map is published on; fixed while the node runs",
                         ""});
  visitOptions(o.reading, visit);
}

// Throws InputError naming the option.
void checkMapPublisherOptions(const MapPublisherOptions& options);

}  // namespace grid_path_planner::nodes
