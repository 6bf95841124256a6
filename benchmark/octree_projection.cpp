// Re-projection after a few columns changed, against walking every leaf as octomap_server does.
//
//   grid_path_planner_octree_projection [FILE.bt|FILE.ot [ROUNDS]]
//
// Without a file on a seabed with posts that is mapped here. In every round 1 % of the known
// columns get one voxel more or less: those of one patch, as a sensor's frame has it, or scattered
// over the map. Both programs then make the grid, which is compared cell by cell; the times are taken
// by turns. Prints the medians; exit code 1 where a cell differs.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/mapping/octree_map.h"
#include "grid_path_planner/mapping/projection.h"

namespace {

using grid_path_planner::grid::Cell;
using grid_path_planner::grid::GridGeometry;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::mapping::Brick;
using grid_path_planner::mapping::BrickColumn;
using grid_path_planner::mapping::OctreeMap;
using grid_path_planner::mapping::OctreeOptions;
using grid_path_planner::mapping::Projection;
using grid_path_planner::mapping::ProjectionOptions;
using grid_path_planner::mapping::Scan;
using grid_path_planner::mapping::Voxel;
using Clock = std::chrono::steady_clock;

constexpr double kResolution = 0.1;

struct Column {
  int x, y;  // keys
};

// ---- a world to map

// Where a ray from `origin` ends: on the seabed or on one of the posts, which stand every 3 m.
octomap::point3d hitOf(const octomap::point3d& origin, const octomap::point3d& direction) {
  for (float range = 0.2F; range < 6.0F; range += 0.03F) {
    const octomap::point3d at = origin + direction * range;
    const bool post = std::abs(std::remainder(at.x(), 3.0F)) < 0.3F &&
                      std::abs(std::remainder(at.y(), 3.0F)) < 0.3F;
    if (post || at.z() < 0.2F * std::sin(at.x()) + 0.2F * std::sin(0.7F * at.y())) return at;
  }
  return origin + direction * 6.0F;
}

OctreeMap mappedSeabed() {
  OctreeOptions options;
  options.resolution = kResolution;
  OctreeMap map(options);
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  for (float x = -7.5F; x <= 7.5F; x += 3.0F)
    for (float y = -7.5F; y <= 7.5F; y += 3.0F) {
      Scan scan;
      scan.origin = {x, y, 1.5F};
      for (int ray = 0; ray < 20000; ++ray) {
        octomap::point3d direction(normal(random), normal(random), normal(random));
        scan.hits.push_back(hitOf(scan.origin, direction.normalize()));
      }
      map.insert(scan);
    }
  return map;
}

// ---- as octomap_server does it

void write(OccupancyGrid& grid, const Column& first, int x, int y, bool occupied) {
  const Cell cell{x - first.x, y - first.y};
  if (!grid.contains(cell)) return;
  std::int8_t& value = grid[cell];
  value = std::max<std::int8_t>(value, occupied ? 100 : 0);
}

OccupancyGrid walkedGrid(const octomap::OcTree& tree, const GridGeometry& geometry,
                         const ProjectionOptions& options) {
  OccupancyGrid grid(geometry, -1);
  const double resolution = geometry.resolution();
  const Column first{static_cast<int>(std::lround(geometry.origin().x / resolution)) + 32768,
                     static_cast<int>(std::lround(geometry.origin().y / resolution)) + 32768};
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const double half = leaf.getSize() / 2.0;
    if (leaf.getZ() + half <= options.min_z + 1e-9 || leaf.getZ() - half >= options.max_z - 1e-9)
      continue;
    const bool occupied = tree.isNodeOccupied(*leaf);
    const octomap::OcTreeKey key = leaf.getIndexKey();
    const int side = 1 << (tree.getTreeDepth() - leaf.getDepth());
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) write(grid, first, key[0] + x, key[1] + y, occupied);
  }
  return grid;
}

// ---- changes

std::vector<Column> knownColumns(const OctreeMap& map) {
  std::vector<Column> known;
  for (const BrickColumn column : map.bricks().columns()) {
    Brick seen;
    map.bricks().forEachBrick(column, [&](std::uint16_t, const Brick& brick) {
      for (std::size_t y = 0; y < 8; ++y) seen.known[y] |= brick.known[y];
    });
    for (unsigned i = 0; i < 64; ++i)
      if (Brick::column(seen.known, i % 8, i / 8) != 0)
        known.push_back(
            {8 * column.x + static_cast<int>(i % 8), 8 * column.y + static_cast<int>(i / 8)});
  }
  return known;
}

// Turns the voxel of a column at height z over.
void flip(OctreeMap& map, const Column& column, double z) {
  const octomap::OcTreeKey key(static_cast<octomap::key_type>(column.x),
                               static_cast<octomap::key_type>(column.y), map.tree().coordToKey(z));
  const octomap::point3d centre = map.tree().keyToCoord(key);
  if (map.bricks().voxel(key) == Voxel::OCCUPIED) {
    map.clearBox(centre, centre);
    return;
  }
  while (map.bricks().voxel(key) != Voxel::OCCUPIED) map.insert({centre, {centre}, {}});
}

std::vector<Column> patch(std::vector<Column> columns, std::size_t number, std::mt19937& random) {
  const Column middle = columns[random() % columns.size()];
  const auto distance = [&](const Column& column) {
    return std::max(std::abs(column.x - middle.x), std::abs(column.y - middle.y));
  };
  std::nth_element(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(number),
                   columns.end(), [&](auto& a, auto& b) { return distance(a) < distance(b); });
  columns.resize(number);
  return columns;
}

std::vector<Column> scattered(std::vector<Column> columns, std::size_t number,
                              std::mt19937& random) {
  std::shuffle(columns.begin(), columns.end(), random);
  columns.resize(number);
  return columns;
}

// ---- the comparison

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

template <class Action>
double milliseconds(Action action) {
  const auto start = Clock::now();
  action();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Whether all grids were the same.
template <class Choose>
bool compare(const char* name, OctreeMap& map, int rounds, Choose choose) {
  double x, y, low, high;
  map.tree().getMetricMin(x, y, low);
  map.tree().getMetricMax(x, y, high);
  ProjectionOptions options;
  options.min_z = low + 0.25 * (high - low);
  options.max_z = low + 0.75 * (high - low);
  Projection projection(map.options().resolution, options);
  projection.update(map.bricks());
  const std::vector<Column> known = knownColumns(map);
  std::mt19937 random(2);
  std::vector<double> ours, theirs;
  bool same = true;
  for (int round = 0; round < rounds; ++round) {
    for (const Column& column : choose(known, known.size() / 100, random))
      flip(map, column, 0.5 * (low + high));
    OccupancyGrid walked;
    ours.push_back(milliseconds([&] { projection.update(map.bricks()); }));
    theirs.push_back(milliseconds(
        [&] { walked = walkedGrid(map.tree(), projection.grid().geometry(), options); }));
    same = same && walked == projection.grid();
  }
  std::printf(
      "%-10s %7zu of %zu columns: update %8.4f ms, all %zu leaves %8.3f ms, ratio %.0f, %s\n", name,
      known.size() / 100, known.size(), median(ours), map.tree().getNumLeafNodes(), median(theirs),
      median(theirs) / median(ours), same ? "same grids" : "GRIDS DIFFER");
  return same;
}

}  // namespace

int main(int argc, char** argv) {
  OctreeMap map{OctreeOptions{}};
  if (argc > 1)
    map.load(argv[1]);
  else
    map = mappedSeabed();
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 31;
  std::printf("a tree of %zu nodes at %g m\n", map.tree().size(), map.options().resolution);
  bool same = compare("one patch", map, rounds, patch);
  same = compare("scattered", map, rounds, scattered) && same;
  return same ? 0 : 1;
}
