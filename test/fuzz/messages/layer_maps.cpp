// Maps and masks as map_layers lays them over one another.
#include <nav_msgs/OccupancyGrid.h>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "layers/layered_map.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr int kMostLayers = 8;
enum LayerKind { BASE, LIVE, KEEP_OUT, SPEED, kLayerKinds };

std::string layer(LayerKind kind, std::uint32_t side, float resolution, std::int8_t value) {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.resolution = resolution;
  map.info.width = map.info.height = side;
  map.info.origin.position.x = -0.5;
  map.info.origin.orientation.w = 1.0;
  map.data.assign(side * side, 0);
  map.data[side + 1] = value;
  return static_cast<char>(kind) + bytesOf(map);
}

std::vector<std::string> seedsOfLayers() {
  return {layer(BASE, 6, 0.5F, 100) + layer(LIVE, 5, 0.3F, 100) + layer(SPEED, 3, 1.0F, 40),
          layer(LIVE, 4, 0.5F, -1) + layer(BASE, 4, 0.5F, 0) + layer(KEEP_OUT, 4, 0.7F, 100),
          layer(BASE, 4, 0.5F, 7) + layer(BASE, 3, 0.25F, -1)};
}

FUZZ_TARGET(layer_maps, seedsOfLayers) {
  Messages messages(input);
  layers::LayeredMap map;
  map.configure({}, {});
  for (int i = 0; i < kMostLayers && !messages.atEnd(); ++i) {
    const int kind = messages.byte() % kLayerKinds;
    const auto message = messages.next<nav_msgs::OccupancyGrid>();
    if (!message) return;
    mayRefuse([&] {
      nodes::frameName(message->header.frame_id);
      auto grid =
          std::make_shared<const grid::OccupancyGrid>(nodes::occupancyFromMessage(*message));
      if (kind == BASE)
        map.setBase(std::move(grid));
      else if (kind == LIVE)
        map.setLive(std::move(grid));
      else if (kind == KEEP_OUT)
        map.setKeepOutMask(std::move(grid));
      else
        map.setSpeedMask(std::move(grid));
    });
    if (!map.hasBase()) continue;
    grid::checkOccupancyValues(map.merged());
    const grid::GridGeometry& geometry = map.merged().geometry();
    for (const grid::CellRect& rect : map.takeChanged())
      mustHold(rect.intersection({0, 0, geometry.width(), geometry.height()}) == rect,
               "what changed lies in the map");
    mustHold(map.speedLimits().geometry() == geometry, "limits are of the same cells");
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
