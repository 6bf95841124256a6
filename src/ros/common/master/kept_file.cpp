#include "ros/common/master/kept_file.h"

#include <ros/master.h>
#include <ros/param.h>

#include <algorithm>

namespace grid_path_planner::nodes {

namespace {

bool isRunId(const std::string& text) {
  const auto belongs = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
  };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), belongs);
}

}  // namespace

// Names of nodes have no dots.
std::string keptFileName(const std::string& node, const std::string& ending) {
  std::string name = node.substr(std::min(node.find_first_not_of('/'), node.size()));
  std::replace(name.begin(), name.end(), '/', '.');
  return "." + name + "@" + ros::master::getHost() + "_" + std::to_string(ros::master::getPort()) +
         ending;
}

std::string runId() {
  std::string run;
  return ros::param::get("/run_id", run) && isRunId(run) ? run : "";
}

}  // namespace grid_path_planner::nodes
