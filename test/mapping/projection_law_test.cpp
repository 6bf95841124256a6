// The projection as a function of the tree: whatever changes it and in whatever order, the grid is
// what a look at every leaf gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "grid_path_planner/mapping/octree_map.h"
#include "grid_path_planner/mapping/projection.h"

namespace grid_path_planner::mapping {

using grid::Cell;
using grid::CellRect;
using grid::OccupancyGrid;

namespace {

constexpr double kResolution = 0.25;

// Calls visit(x, y, z, occupied) with the keys of every known voxel, leaves cut into voxels.
template <class Visit>
void forEachVoxel(const octomap::OcTree& tree, Visit visit) {
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const int side = 1 << (tree.getTreeDepth() - leaf.getDepth());
    const octomap::OcTreeKey first = leaf.getIndexKey();
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z)
          visit(first[0] + x, first[1] + y, first[2] + z, tree.isNodeOccupied(*leaf));
  }
}

using Columns = std::map<std::pair<int, int>, std::map<int, bool>>;  // z -> occupied

Columns columnsOf(const octomap::OcTree& tree) {
  Columns columns;
  forEachVoxel(tree, [&](int x, int y, int z, bool occupied) { columns[{x, y}][z] = occupied; });
  return columns;
}

// The definition of seabed.h, column by column.
double seabedAt(const Columns& columns, int x, int y, const ProjectionOptions& o) {
  double height = std::numeric_limits<double>::infinity();
  for (const auto& [at, voxels] : columns) {
    const double distance = std::hypot(at.first - x, at.second - y);
    if (distance > o.seabed_radius / kResolution) continue;
    const auto lowest =
        std::find_if(voxels.begin(), voxels.end(), [](const auto& voxel) { return voxel.second; });
    if (lowest == voxels.end() || voxels.count(lowest->first - 1) != 0) continue;
    height = std::min(height, lowest->first + o.seabed_max_slope * distance);
  }
  return height;
}

std::int8_t valueOf(const std::map<int, bool>& voxels, double min_z, double max_z) {
  std::int8_t value = -1;
  for (const auto& [z, occupied] : voxels) {
    const double low = (z - 32768) * kResolution;
    if (low + kResolution <= min_z + 1e-9 || low >= max_z - 1e-9) continue;
    value = std::max<std::int8_t>(value, occupied ? 100 : 0);
  }
  return value;
}

std::int8_t expectedValue(const Columns& columns, const std::pair<int, int>& at,
                          const ProjectionOptions& o, double vehicle_z) {
  const std::map<int, bool>& voxels = columns.at(at);
  if (o.reference != ProjectionReference::SEABED) {
    const double z = o.reference == ProjectionReference::VEHICLE ? vehicle_z : 0.0;
    return valueOf(voxels, z + o.min_z, z + o.max_z);
  }
  const double seabed = seabedAt(columns, at.first, at.second, o);
  if (std::isinf(seabed)) return valueOf(voxels, -1e9, 1e9) == 100 ? 100 : -1;
  const double z = (seabed - 32768 + 0.5) * kResolution;
  return valueOf(voxels, z + o.min_z, z + o.max_z);
}

void expectAsWalkingAllLeaves(const octomap::OcTree& tree, const Projection& projection,
                              double vehicle_z) {
  OccupancyGrid expected(projection.grid().geometry(), -1);
  const Columns columns = columnsOf(tree);
  std::set<std::pair<int, int>> left_out;  // brick columns
  for (const auto& [at, voxels] : columns) {
    const auto cell = expected.geometry().cellAt(
        {(at.first - 32768 + 0.5) * kResolution, (at.second - 32768 + 0.5) * kResolution});
    if (!cell) left_out.insert({at.first / 8, at.second / 8});
    if (!cell) continue;
    expected[*cell] = expectedValue(columns, at, projection.options(), vehicle_z);
  }
  ASSERT_EQ(projection.grid(), expected);
  if (!projection.options().bounds.given()) {
    ASSERT_EQ(projection.columnsLeftOut(), left_out.size());
  }
}

// Whether the cells that differ lie in the rectangle that was told.
void expectToldChanges(const OccupancyGrid& before, const OccupancyGrid& after,
                       const ProjectionChange& change) {
  if (before.geometry() != after.geometry()) {
    EXPECT_TRUE(change.geometry);
    return;
  }
  EXPECT_FALSE(change.geometry);
  CellRect differing;
  for (int row = 0; row < after.height(); ++row)
    for (int column = 0; column < after.width(); ++column)
      if (before[Cell{column, row}] != after[Cell{column, row}])
        differing = differing.hull({column, row, 1, 1});
  EXPECT_EQ(change.cells, differing);
}

class Edits {
 public:
  explicit Edits(unsigned seed) : random_(seed) {}

  void apply(OctreeMap& map) {
    switch (random_() % 8) {
      case 0:
        return clearBox(map);
      case 1:
        return map.decay(1.0);
      case 2:
        if (random_() % 6 == 0) return map.reset();
        return insert(map, 1);
      default:
        return insert(map, 30);
    }
  }

 private:
  float number(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random_);
  }
  octomap::point3d point(float size) {
    return {number(-size, size), number(-size, size), number(-2.0F, 3.0F)};
  }
  void insert(OctreeMap& map, int points) {
    Scan scan;
    scan.origin = point(2.0F);
    for (int i = 0; i < points; ++i)
      (random_() % 3 == 0 ? scan.clear_only : scan.hits).push_back(point(6.0F));
    map.insert(scan);
  }
  void clearBox(OctreeMap& map) {
    const octomap::point3d low = point(5.0F);
    map.clearBox(low, low + octomap::point3d(number(0, 3), number(0, 3), number(0, 3)));
  }

  std::mt19937 random_;
};

ProjectionOptions randomOptions(std::mt19937& random) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  ProjectionOptions options;
  options.reference = static_cast<ProjectionReference>(random() % 3);
  options.min_z = kResolution * std::floor(number(-8.0, 4.0));
  options.max_z = options.min_z + number(0.3, 3.0);
  options.seabed_radius = number(0.0, 4.0);
  options.seabed_max_slope = number(0.0, 1.5);
  if (random() % 2 == 0) options.max_cells = 1024;
  options.keep_around = number(0.0, 3.0);
  if (random() % 3 == 0) options.bounds = {-3.0, number(-3.0, -1.0), 2.0, number(1.0, 4.0)};
  return options;
}

class ProjectionLaw : public testing::TestWithParam<unsigned> {};

TEST_P(ProjectionLaw, IncrementalIsFromScratchIsWalkingAllLeaves) {
  std::mt19937 random(GetParam());
  OctreeOptions octree;
  octree.resolution = kResolution;
  octree.decay_time = 3.0;
  OctreeMap map(octree);
  Projection projection(kResolution, randomOptions(random));
  Edits edits(GetParam());
  double vehicle_z = 0.0;
  for (int step = 0; step < 12; ++step) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", step " + std::to_string(step));
    const OccupancyGrid before = projection.grid();
    if (random() % 4 == 0) projection.setOptions(randomOptions(random));
    if (random() % 3 == 0) projection.setVehicleHeight(vehicle_z += 2 * kResolution);
    edits.apply(map);
    const ProjectionChange change = projection.update(map.bricks());
    expectToldChanges(before, projection.grid(), change);
    expectAsWalkingAllLeaves(map.tree(), projection, vehicle_z);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ProjectionLaw, testing::Range(0u, 12u));

}  // namespace
}  // namespace grid_path_planner::mapping
