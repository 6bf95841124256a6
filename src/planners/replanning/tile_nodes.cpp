#include "planners/replanning/tile_nodes.h"

namespace grid_path_planner::planners {

using grid::GridGeometry;

void TileNodes::prepare(const GridGeometry& geometry) {
  const auto tiles = [](int cells) {
    return (static_cast<std::size_t>(cells) + kSide - 1) >> kSideBits;
  };
  across_ = tiles(geometry.width());
  tile_at_.assign(across_ * tiles(geometry.height()), 0);
  tiles_.clear();
  used_.clear();
  stamp_.restart();
}

void TileNodes::beginQuery() {
  for (const std::size_t place : used_) tile_at_[place] = 0;
  used_.clear();
  stamp_.next([this] {
    for (const std::unique_ptr<Tile>& tile : tiles_) tile->fill(Node());
  });
}

void TileNodes::addTile(std::size_t place) {
  if (used_.size() == tiles_.size()) tiles_.push_back(std::make_unique<Tile>());
  used_.push_back(place);
  tile_at_[place] = static_cast<std::uint32_t>(used_.size());
}

}  // namespace grid_path_planner::planners
