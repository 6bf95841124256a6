#include "ros/mapping/kept_map.h"

#include <cstdint>
#include <sstream>

namespace grid_path_planner::nodes {
namespace {

constexpr char kNewestCloud[] = "newest cloud ";

ros::Time timeIn(const std::string& line) {
  const std::string beginning = std::string("# ") + kNewestCloud;
  if (line.compare(0, beginning.size(), beginning) != 0) return {};
  std::istringstream numbers(line.substr(beginning.size()));
  std::uint32_t seconds = 0, nanoseconds = 0;
  if (!(numbers >> seconds >> nanoseconds) || nanoseconds >= 1000000000) return {};
  return {seconds, nanoseconds};
}

}  // namespace

std::vector<std::string> commentsOf(const std::string& marker, const ros::Time& newest_cloud) {
  return {marker, kNewestCloud + std::to_string(newest_cloud.sec) + " " +
                      std::to_string(newest_cloud.nsec)};
}

std::optional<KeptMap> keptMap(const std::string& beginning, const std::string& marker) {
  std::istringstream file(beginning);
  std::string first, whose, newest;
  if (!std::getline(file, first) || !std::getline(file, whose) || !std::getline(file, newest) ||
      newest.empty() || whose != "# " + marker)
    return std::nullopt;
  return KeptMap{timeIn(newest)};
}

}  // namespace grid_path_planner::nodes
