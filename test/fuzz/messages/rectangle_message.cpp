#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "ros/planning/rectangle_messages.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfRectangleMaps() {
  return {bytesOf(nodes::rectanglesToMessage(
      grid::GridGeometry(9, 5, 0.5), {{0, 0, 4, 3}, {5, 0, 2, 3}}, "map", ros::Time(1, 0)))};
}

FUZZ_TARGET(rectangle_message, seedsOfRectangleMaps) {
  const auto message = messageOf<RectangleMap>(input);
  if (!message) return;
  mayRefuse(
      [&] { nodes::rectanglesFromMessage(*message, planners::Touching::BORDERS_AND_CORNERS); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
