// Nodes in tiles, against an ordered map of cells.
#include "planners/replanning/tile_nodes.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

namespace grid_path_planner::planners {

using grid::Cell;
using grid::GridGeometry;

namespace {

TEST(TileNodesLaw, AQueryReadsWhatItWroteAndNothingElse) {
  std::mt19937 random(5);
  const GridGeometry geometry(150, 70, 1.0);
  TileNodes nodes;
  nodes.prepare(geometry);
  // The ten bits of a node's stamp wrap around twice.
  for (int query = 0; query < 2500; ++query) {
    nodes.beginQuery();
    std::map<std::pair<int, int>, std::pair<SearchKey, unsigned>> written;
    for (int call = 0; call < 60; ++call) {
      const Cell cell{static_cast<int>(random() % 150), static_cast<int>(random() % 70)};
      const auto known = written.find({cell.column, cell.row});
      TileNodes::Node& node = nodes.at(cell);
      if (known == written.end()) {
        ASSERT_EQ(node.g(), TileNodes::Node::kUnknown);
        ASSERT_EQ(node.steps(), 0U);
        ASSERT_EQ(node.note(), 0U);
        ASSERT_FALSE(nodes.closed(cell));
      } else {
        ASSERT_EQ(node.g(), known->second.first);
        ASSERT_EQ(node.steps(), 1U << known->second.second);
        ASSERT_EQ(node.note(), 2U);
        ASSERT_TRUE(nodes.closed(cell));
      }
      const SearchKey g = random();
      const unsigned step = random() % 8;
      node.reach(g, step);
      ASSERT_FALSE(nodes.closed(cell));
      node.close();
      node.setNote(2);
      written[{cell.column, cell.row}] = {g, step};
    }
  }
  EXPECT_LE(nodes.bytes(), 5 * 3 * (4 + 1024 * 8));
}

}  // namespace
}  // namespace grid_path_planner::planners
