// The command line of a node: ROS's own arguments (_parameter:=value, topic:=other), and a file
// where the node reads one.
//
//   const NodeArguments given = nodeArguments(argc, argv, "map_publisher", "MAP");
//   if (given.exit_code) return *given.exit_code;
//
// roscpp ignores unknown arguments, so that a node started as `navigate_path site.yaml` would wait
// for a path for ever.
#pragma once

#include <optional>
#include <string>

namespace grid_path_planner::nodes {

struct NodeArguments {
  std::string file;              // empty: none was given
  std::optional<int> exit_code;  // the program ends with it; the message is printed
};

// `file_kind` names the file in the usage; empty: the node reads none. --help and -h print the
// usage; any other option, or one file too many, is refused on the standard error.
NodeArguments nodeArguments(int argc, const char* const* argv, const std::string& name,
                            const std::string& file_kind = "");

}  // namespace grid_path_planner::nodes
