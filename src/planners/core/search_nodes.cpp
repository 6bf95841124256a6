#include "planners/core/search_nodes.h"

namespace grid_path_planner::planners {

using base::ZeroedArray;

void PackedNodes::beginQuery() {
  stamp_.next([this] { nodes_ = ZeroedArray<std::uint64_t>(nodes_.size()); });
}

void WideNodes::beginQuery() {
  stamp_.next([this] { words_ = ZeroedArray<std::uint32_t>(words_.size()); });
}

}  // namespace grid_path_planner::planners
