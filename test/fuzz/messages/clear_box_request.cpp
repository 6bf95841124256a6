#include <grid_path_planner/ClearBox.h>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/mapping/map_model.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfBoxes() {
  ClearBoxRequest box;
  box.min.x = -0.5;
  box.max.x = box.max.y = box.max.z = 0.5;
  return {bytesOf(box), bytesOf(ClearBoxRequest())};
}

FUZZ_TARGET(clear_box_request, seedsOfBoxes) {
  const auto box = messageOf<ClearBoxRequest>(input);
  if (!box) return;
  mapping::MapModel model{mapping::ProjectedMapOptions()};
  model.insert({{0.3, 0.1, 0.2}, {0.4, -0.1, 0.0}}, {});
  mayRefuse([&] {
    model.clearBox({box->min.x, box->min.y, box->min.z}, {box->max.x, box->max.y, box->max.z});
    grid::checkOccupancyValues(model.grid());
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
