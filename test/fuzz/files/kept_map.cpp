#include "ros/mapping/kept_map.h"

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr char kMarkerOfMap[] = "run 7, frame map, resolution 0.1";

std::string keptText(const std::string& marker, const ros::Time& newest) {
  std::string text = "# Octomap OcTree file\n";
  for (const std::string& comment : nodes::commentsOf(marker, newest))
    text += "# " + comment + "\n";
  return text + "id OcTree\nsize 0\nres 0.1\ndata\n";
}

std::vector<std::string> seedsOfKeptMaps() {
  return {keptText(kMarkerOfMap, ros::Time(1000, 5)),
          keptText("run 8, frame map, resolution 0.1", ros::Time(1000, 5))};
}

FUZZ_TARGET(kept_map, seedsOfKeptMaps) {
  const auto kept = nodes::keptMap(input, kMarkerOfMap);
  if (!kept) return;
  mustHold(kept->newest_cloud.nsec < 1000000000, "its newest cloud is a time");
  const auto again = nodes::keptMap(keptText(kMarkerOfMap, kept->newest_cloud), kMarkerOfMap);
  mustHold(again && again->newest_cloud == kept->newest_cloud, "what is kept is read back");
}

}  // namespace
}  // namespace grid_path_planner::fuzz
