// A seabed that is looked for as far as seabed_radius may be, 100 m.
//
// What was seen before: of each column that changed all columns within the radius were kept in memory, 1 MB at 0.05 m,
// whether there was something or not, and for each of these all columns around it were looked up again. A client that
// set the radius while a map of 2000 columns was there took 2 GB and all of the mapping's time. At 0.001 m the squares
// of distances did not fit into their type.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "grid_path_planner/mapping/projection.h"
#include "mapping/side_view.h"
#include "support/bounded_run.h"

namespace grid_path_planner::mapping {

using grid::Cell;
using grid::OccupancyGrid;

namespace {

constexpr double kSide = 0.05;  // m, of a voxel

// In voxels, of which (0, 0, 0) begins at 0 m. At the bottom, and at the top, is an occupied voxel.
struct Mast {
  int x = 0;
  int y = 0;
  int bottom = 0;
  int top = 0;
};

std::vector<Mast> scattered(int count) {
  std::mt19937 random(1911);
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  std::vector<Mast> masts;
  for (int i = 0; i < count; ++i) {
    const int bottom = below(200);
    masts.push_back({below(3600) - 1800, below(3600) - 1800, bottom, bottom + 1 + below(100)});
  }
  return masts;
}

// Where two stand in one column the lower bottom is that of both.
void build(const std::vector<Mast>& masts, OccupancyBricks& bricks) {
  for (const Mast& mast : masts)
    for (const int z : {mast.bottom, mast.top})
      bricks.setVoxel(test::voxelKey(mast.x, mast.y, z), Voxel::OCCUPIED);
}

ProjectionOptions aboveTheSeabed(double radius) {
  ProjectionOptions options;
  options.reference = ProjectionReference::SEABED;
  options.seabed_radius = radius;
  options.seabed_max_slope = 0.02;
  options.min_z = 0.5;
  options.max_z = 4.0;
  options.bounds = {-100.0, -100.0, 100.0, 100.0};
  return options;
}

// The definition of seabed.h.
double seabedAt(const Mast& at, const std::vector<Mast>& masts, const ProjectionOptions& options) {
  double height = 1e9;
  for (const Mast& mast : masts) {
    const double distance = std::hypot(mast.x - at.x, mast.y - at.y);
    if (distance * kSide <= options.seabed_radius)
      height = std::min(height, mast.bottom + options.seabed_max_slope * distance);
  }
  return height;
}

bool isObstacle(const Mast& mast, double seabed, const ProjectionOptions& options) {
  for (const int z : {mast.bottom, mast.top}) {
    const double above = z - (seabed + 0.5);  // from the seabed up to the lower side, voxels
    if ((above + 1.0) * kSide > options.min_z + 1e-9 && above * kSide < options.max_z - 1e-9)
      return true;
  }
  return false;
}

OccupancyGrid expectedGrid(const std::vector<Mast>& masts, const ProjectionOptions& options,
                           const OccupancyGrid& like) {
  OccupancyGrid grid(like.geometry(), -1);
  for (const Mast& mast : masts)
    if (isObstacle(mast, seabedAt(mast, masts, options), options))
      grid[*grid.geometry().cellAt({(mast.x + 0.5) * kSide, (mast.y + 0.5) * kSide})] = 100;
  return grid;
}

TEST(SeabedRadius, AWideOneGivesWhatAWalkThroughAllColumnsGives) {
  std::vector<Mast> masts = scattered(2000);
  OccupancyBricks bricks(kSide);
  build(masts, bricks);
  Projection projection(kSide, aboveTheSeabed(1.0));
  projection.update(bricks);
  EXPECT_EQ(projection.grid(), expectedGrid(masts, projection.options(), projection.grid()));
  projection.setOptions(aboveTheSeabed(100.0));
  projection.update(bricks);
  EXPECT_EQ(projection.grid(), expectedGrid(masts, projection.options(), projection.grid()));
  masts.push_back({40, -70, -900, -800});  // far below all others: it changes columns all around
  build({masts.back()}, bricks);
  const OccupancyGrid before = projection.grid();
  projection.update(bricks);
  EXPECT_FALSE(projection.grid() == before);
  EXPECT_EQ(projection.grid(), expectedGrid(masts, projection.options(), projection.grid()));
}

TEST(SeabedRadius, AWideOneTakesMemoryForTheColumnsThatThereAre) {
  OccupancyBricks bricks(kSide);
  build(scattered(2000), bricks);
  Projection projection(kSide, aboveTheSeabed(1.0));
  projection.update(bricks);
  const test::BoundedRun run = test::runBounded([&] {
    projection.setOptions(aboveTheSeabed(100.0));
    projection.update(bricks);
  });
  EXPECT_TRUE(run.ended) << run;
  EXPECT_LT(run.megabytes, 100.0) << run;
}

// Two masts 60 m apart, in voxels of a millimetre; the seabed of the second one is that of the first.
TEST(SeabedRadius, ItsSquaresFitAtTheFinestResolution) {
  OccupancyBricks bricks(0.001);
  bricks.setVoxel(test::voxelKey(-30000, 0, 0), Voxel::OCCUPIED);
  bricks.setVoxel(test::voxelKey(30000, 0, 200), Voxel::OCCUPIED);
  ProjectionOptions options = aboveTheSeabed(100.0);
  options.min_z = 0.1;
  options.bounds = {29.9, -0.1, 30.1, 0.1};
  for (const double slope : {0.001, 0.01}) {
    options.seabed_max_slope = slope;
    Projection projection(0.001, options);
    projection.update(bricks);
    const auto cell = projection.grid().geometry().cellAt({30.0005, 0.0005});
    ASSERT_TRUE(cell);
    EXPECT_EQ(projection.grid()[*cell], slope < 0.005 ? 100 : -1)
        << "0.14 m above the seabed, or seabed itself";
  }
}

}  // namespace
}  // namespace grid_path_planner::mapping
