#include "ros/common/node_arguments.h"

#include <ros/init.h>

#include <iostream>

namespace grid_path_planner::nodes {
namespace {

constexpr int kWrongUsage = 2;

std::string usageOf(const std::string& name, const std::string& file_kind) {
  return "usage: " + name + (file_kind.empty() ? "" : " [" + file_kind + "]") +
         " [_parameter:=value]... [topic:=other_topic]...\n"
         "Parameters, topics and services: doc/nodes.md of grid_path_planner.\n";
}

}  // namespace

NodeArguments nodeArguments(int argc, const char* const* argv, const std::string& name,
                            const std::string& file_kind) {
  ros::V_string arguments;
  ros::removeROSArgs(argc, argv, arguments);
  const std::string usage = usageOf(name, file_kind);
  NodeArguments given;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--help" || argument == "-h") {
      std::cout << usage;
      return {"", 0};
    }
    const bool is_file = !file_kind.empty() && !argument.empty() && argument[0] != '-';
    if (!is_file || !given.file.empty()) {
      std::cerr << name << ": what is '" << argument
                << "'? Parameters are given as _parameter:=value\n"
                << usage;
      return {"", kWrongUsage};
    }
    given.file = argument;
  }
  return given;
}

}  // namespace grid_path_planner::nodes
