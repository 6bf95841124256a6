// Whatever allocation fails while a cloud is inserted, projected and its change taken: afterwards the grid is the projection of
// the tree, and whoever applied the changes has the same.
//
// What was seen before: columns that were taken from the tree and not projected stayed as they were, a wall that nobody saw;
// cells that were written before the failure were in no change.
#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/mapping/map_model.h"
#include "memory/failing_allocation.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::mapping {
namespace {

using grid::OccupancyGrid;

std::vector<Eigen::Vector3d> cloud(std::uint32_t seed, double reach) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  std::vector<Eigen::Vector3d> points(60);
  for (Eigen::Vector3d& point : points)
    point << coordinate(random), coordinate(random), 0.3 * coordinate(random);
  return points;
}

// As a subscriber has it.
class Follower {
 public:
  void follow(MapModel& map) {
    const OccupancyGrid& grid = map.grid();
    const ProjectionChange change = map.takeChange();
    if (change.geometry) {
      grid_ = grid;
      return;
    }
    for (int row = change.cells.row; row < change.cells.row + change.cells.height; ++row)
      std::copy_n(grid.row(row) + change.cells.column, change.cells.width,
                  grid_.row(row) + change.cells.column);
  }
  const OccupancyGrid& grid() const { return grid_; }

 private:
  OccupancyGrid grid_;
};

ProjectedMapOptions options() {
  ProjectedMapOptions options;
  options.octree.resolution = 0.2;
  return options;
}

// The grid of the same tree, projected at once.
OccupancyGrid projectedAtOnce(const MapModel& map, const test::TemporaryFolder& folder) {
  const std::string file = folder.path("map.ot");
  map.saveOctree(base::OutputFile(file));
  MapModel other(options(), file);
  return other.grid();
}

std::int8_t valueAt(const OccupancyGrid& grid, const Eigen::Vector2d& place) {
  const auto cell = grid.geometry().cellAt(place);
  return cell ? grid[*cell] : std::int8_t{-1};
}

// Whether `holds` is so of each cell's value and that of the other grid at its centre.
template <class Holds>
bool everywhere(const OccupancyGrid& grid, const OccupancyGrid& other, Holds holds) {
  const grid::GridGeometry& geometry = grid.geometry();
  for (std::uint32_t i = 0; i < grid.values().size(); ++i)
    if (!holds(grid.values()[i],
               valueAt(other, geometry.centre(geometry.cell(grid::CellIndex(i))))))
      return false;
  return true;
}

bool equal(std::int8_t one, std::int8_t other) {
  return one == other;
}

enum class Step { INSERT, RESET };

void work(MapModel& map, Step step) {
  if (step == Step::INSERT)
    map.insert(cloud(2, 4.0), {});
  else
    map.reset();
}

// Occupied where it is with the first cloud or with both.
OccupancyGrid obstaclesOfBothClouds() {
  MapModel map(options());
  map.insert(cloud(1, 2.0), {});
  const OccupancyGrid first = map.grid();
  work(map, Step::INSERT);
  OccupancyGrid both = map.grid();
  const grid::GridGeometry& geometry = both.geometry();
  for (std::uint32_t i = 0; i < both.values().size(); ++i)
    if (valueAt(first, geometry.centre(geometry.cell(grid::CellIndex(i)))) == 100)
      both[grid::CellIndex(i)] = 100;
  return both;
}

class MapMemoryLaw : public testing::TestWithParam<Step> {};

TEST_P(MapMemoryLaw, ChangesLeadToTheProjectionOfTheTree) {
  const test::TemporaryFolder folder;
  const OccupancyGrid obstacles = obstaclesOfBothClouds();
  const auto isNoMore = [](std::int8_t is, std::int8_t may_be) {
    return is < 100 || may_be == 100;
  };
  bool happened = true;
  int number = 1;
  for (; happened; ++number) {
    MapModel map(options());
    Follower follower;
    map.insert(cloud(1, 2.0), {});
    follower.follow(map);
    {
      const test::FailingAllocation fails(number);
      try {
        work(map, GetParam());
        map.grid();
      } catch (const std::bad_alloc&) {
      }
      happened = fails.happened();
    }
    follower.follow(map);
    const OccupancyGrid expected = projectedAtOnce(map, folder);
    ASSERT_EQ(follower.grid().values(), map.grid().values()) << number;
    ASSERT_TRUE(everywhere(map.grid(), expected, equal)) << number;
    ASSERT_TRUE(everywhere(expected, map.grid(), equal)) << number;
    ASSERT_TRUE(everywhere(map.grid(), obstacles, isNoMore))
        << "an obstacle of which no cloud has evidence, after allocation " << number;
    work(map, GetParam());  // and it goes on
    follower.follow(map);
    ASSERT_EQ(follower.grid().values(), map.grid().values()) << number;
  }
  EXPECT_GT(number, GetParam() == Step::INSERT ? 300 : 5) << "so many allocations failed in turn";
}

INSTANTIATE_TEST_SUITE_P(Steps, MapMemoryLaw, testing::Values(Step::INSERT, Step::RESET),
                         [](const auto& step) {
                           return step.param == Step::INSERT ? "Insert" : "Reset";
                         });

}  // namespace
}  // namespace grid_path_planner::mapping
