#include "grid_path_planner/planners/search_nodes.h"

namespace grid_path_planner::planners {

using base::ZeroedArray;

void PackedNodes::beginQuery() {
  const std::uint64_t one = std::uint64_t{1} << kQueryShift;
  if (query_ > kInfiniteKey - one) {
    nodes_ = ZeroedArray<std::uint64_t>(nodes_.size());
    query_ = 0;
  }
  query_ += one;
}

void WideNodes::beginQuery() {
  const std::uint32_t one = std::uint32_t{1} << kQueryShift;
  if (query_ > ~std::uint32_t{0} - one) {
    words_ = ZeroedArray<std::uint32_t>(words_.size());
    query_ = 0;
  }
  query_ += one;
}

}  // namespace grid_path_planner::planners
