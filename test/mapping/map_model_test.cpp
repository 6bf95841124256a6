// A map that was kept for a restart is read to its end: on a machine with other work that took longer
// than read_time_limit, or a map that takes more memory than read_memory_limit, the map was called lost, and a node that
// was killed began with an empty world.
#include "grid_path_planner/mapping/map_model.h"

#include <gtest/gtest.h>

#include <random>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::mapping {
namespace {

// Whose reading takes more than a hundredth of a second on any machine.
std::string writeLargeMap(const test::TemporaryFolder& folder, const ProjectedMapOptions& options) {
  MapModel map(options);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-8.0, 8.0);
  std::vector<Eigen::Vector3d> points(2000);
  for (Eigen::Vector3d& point : points)
    point << coordinate(random), coordinate(random), coordinate(random);
  map.insert(points, {});
  const std::string file = folder.path("kept.ot");
  map.map().save(file);
  return file;
}

TEST(MapModel, BeginsWithAKeptMapWhateverThatTakes) {
  const test::TemporaryFolder folder;
  ProjectedMapOptions options;
  const std::string file = writeLargeMap(folder, options);
  options.reading.read_time_limit = 0.01;
  EXPECT_GT(MapModel(options, file).map().tree().size(), 100000U);
  options.filename = file;
  EXPECT_TRUE(test::contains(test::errorText([&] { MapModel{options}; }), "read_time_limit"));
  options.reading = {};
  options.reading.read_memory_limit = 1;
  EXPECT_GT(MapModel(options, file).map().tree().size(), 100000U);
  EXPECT_TRUE(test::contains(test::errorText([&] { MapModel{options}; }), "read_memory_limit"));
}

// dynamic_reconfigure sends every parameter with every request, the resolution as it was at the start: after a
// file of another one, no request was accepted any more.
TEST(MapModel, OptionsChangeAfterAFileOfAnotherResolution) {
  const test::TemporaryFolder folder;
  ProjectedMapOptions options;
  options.octree.resolution = 0.1;
  const std::string file = writeLargeMap(folder, options);
  options.octree.resolution = 0.2;
  MapModel map(options);
  options.filename = file;
  map.setOptions(options);
  EXPECT_EQ(map.map().options().resolution, 0.1);
  options.occupancy_max_z = 2.0;
  map.setOptions(options);
  EXPECT_EQ(map.options().occupancy_max_z, 2.0);
  EXPECT_EQ(map.map().options().resolution, 0.1);
  options.octree.resolution = 0.3;
  EXPECT_TRUE(test::contains(test::errorText([&] { map.setOptions(options); }), "it is 0.1 m"));
}

}  // namespace
}  // namespace grid_path_planner::mapping
