// Options of the node map_publisher.
#pragma once

#include <string>

#include "grid_path_planner/base/option_visitor.h"

namespace grid_path_planner {

struct MapPublisherOptions {
  std::string filename;  // required
  std::string frame_id = "map";
  std::string topic = "projected_map";
};

template <class Visitor>
void visitOptions(MapPublisherOptions& o, Visitor&& visit) {
  visit("filename", o.filename,
        OptionInfo{"Map file: map_server YAML, MovingAI, image, rectangles, rostopic dump or bag", ""});
  visit("frame_id", o.frame_id, OptionInfo{"Frame that the map is published in", ""});
  visit("topic", o.topic, OptionInfo{"Topic that the map is published on", ""});
}

// Throws InputError naming the option.
void checkMapPublisherOptions(const MapPublisherOptions& options);

}  // namespace grid_path_planner
