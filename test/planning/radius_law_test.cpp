// The promise of `radius`: no point of a published path is nearer to an occupied cell, whatever the
// planner, the kernel and the smoothing. Any-angle and smoothed paths came 0.7 cells too near, since
// the distance was kept at the centres of cells only; so did the ends.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/planning/replan_policy.h"
#include "support/kept_distance.h"
#include "support/random_map.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::CostmapOptions;
using costmap::Outside;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::Path;
using path::Pose;
using planners::plannerNames;
using planners::PlannerTraits;
using planners::traitsOf;

namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kRounding = 1e-6;  // m

// GPP_LONG_STORM: ten thousand random maps, and more of each file.
bool isLong() {
  return std::getenv("GPP_LONG_STORM") != nullptr;
}

Pose randomRadiusPose(std::mt19937& random, const GridGeometry& geometry) {
  std::uniform_real_distribution<double> x(0.0, geometry.width()), y(0.0, geometry.height());
  Pose pose;
  const double column = x(random);
  pose.position << geometry.worldFromGrid({column, y(random)}), 0.0;
  return pose;
}

// Noise, or blocks as rooms and walls are.
OccupancyGrid randomRadiusMap(std::mt19937& random, int side) {
  const bool noise = random() % 2 == 0;
  OccupancyGrid map = test::randomOccupancy(random, side, noise ? 0.002 * (random() % 40) : 0.0,
                                            random() % 3 == 0 ? 0.03 : 0.0);
  for (unsigned block = noise ? 0 : 1 + random() % 8; block > 0; --block) {
    const grid::Cell low = test::randomCell(random, map.geometry());
    const int width = 1 + random() % 6, height = 1 + random() % 6;
    for (int row = low.row; row < std::min(low.row + height, map.height()); ++row)
      for (int column = low.column; column < std::min(low.column + width, map.width()); ++column)
        map[grid::Cell{column, row}] = 100;
  }
  const grid::Origin origin{-1.3, 0.7, random() % 2 == 0 ? 0.0 : 0.6};
  return OccupancyGrid(GridGeometry(map.width(), map.height(), 0.05, origin), map.values());
}

PlannerOptions randomRadiusOptions(std::mt19937& random) {
  PlannerOptions options;
  options.planner = plannerNames()[random() % plannerNames().size()];
  const PlannerTraits traits = traitsOf(options.planner);
  options.costmap.radius = 0.01 + 0.19 * (random() % 1000) / 1000.0;
  if (random() % 3 == 0) options.costmap.radius = 0.025 * (1 + random() % 7);
  options.costmap.unknown_is_passable = random() % 3 != 0;
  if (random() % 4 == 0) options.costmap.radius_to_unknown = 0.02 * (random() % 6);
  options.costmap.outside = choicesOf(Outside{})[random() % 3].second;
  options.costmap.kernel = random() % 2 == 0 ? 1 : 1 + random() % 6;
  options.costmap.decay = traits.weights && random() % 2 == 0 ? 5.0 : 0.0;
  if (!traits.weights || random() % 3 == 0) options.costmap.unknown_weight = 1;
  options.smooth = random() % 2 == 0;
  options.search.rectangle_funnel = random() % 2 == 0;
  options.waypoint_tolerance = random() % 2 == 0 ? 0.0 : 0.01 * (random() % 30);
  options.waypoint_spacing = random() % 3 == 0 ? 0.05 * (1 + random() % 10) : 0.0;
  return options;
}

Points pointsOf(const Path& path) {
  Points points;
  for (const Pose& pose : path.poses) points.push_back(pose.position.head<2>());
  return points;
}

std::string describe(const PlannerOptions& options, const OccupancyGrid& map) {
  return options.planner + " radius " + std::to_string(options.costmap.radius) + " kernel " +
         std::to_string(options.costmap.kernel) + (options.smooth ? " smooth" : "") + " map " +
         std::to_string(map.width()) + "x" + std::to_string(map.height());
}

using test::KeptFrom;

constexpr KeptFrom kOccupied{true, false, false};
constexpr KeptFrom kUnknown{false, true, false};
constexpr KeptFrom kBorder{false, false, true};

double nearest(const Points& points, const OccupancyGrid& map, const KeptFrom& from, double limit) {
  return test::leastDistance(points, map, from, limit);
}

// The polyline without the first `length` metres of its first segment.
Points beyond(const Points& points, double length) {
  Points rest = points;
  const Eigen::Vector2d first = points[1] - points[0];
  const double share = first.norm() > 0.0 ? std::min(1.0, length / first.norm()) : 1.0;
  rest[0] = points[0] + share * first;
  return rest;
}

// The start may be nearer than what is kept: then the path is never nearer than the start and has
// left it within a cell's diagonal.
void expectDistanceKept(const Points& points, const OccupancyGrid& map, const KeptFrom& from,
                        double kept) {
  if (kept <= 0.0) return;
  const double at_start = nearest({points[0]}, map, from, kept);
  EXPECT_GE(nearest(points, map, from, kept), at_start - kRounding) << "nearer than the start";
  if (at_start >= kept - kRounding || points.size() < 2) return;
  const double diagonal = M_SQRT2 * map.geometry().resolution();
  EXPECT_GE(nearest(beyond(points, diagonal), map, from, kept), kept - kRounding)
      << "nearer beyond a diagonal";
}

void expectAllKept(const Points& points, const OccupancyGrid& map, const CostmapOptions& options) {
  expectDistanceKept(points, map, kOccupied, options.radius);
  double unknown = options.radius_to_unknown;
  if (unknown < 0.0) unknown = options.unknown_is_passable ? 0.0 : options.radius;
  expectDistanceKept(points, map, kUnknown, unknown);
  const double outside = options.outside == Outside::FREE      ? 0.0
                         : options.outside == Outside::UNKNOWN ? unknown
                                                               : options.radius;
  expectDistanceKept(points, map, kBorder, outside);
}

// What was just planned is not blocked, for a vehicle at the start and for one along the path; but
// where less was kept because of the start, a vehicle that has left it may plan anew.
void expectNotBlocked(const Plan& plan, const CostGrid& costs, std::mt19937& random) {
  const Path& path = plan.path;
  EXPECT_FALSE(pathBlocked(path, std::nullopt, costs)) << "blocked";
  if (plan.message.find("nearer than the ") != std::string::npos) return;
  const std::size_t i = random() % path.poses.size();
  const Eigen::Vector2d from = path.poses[i].position.head<2>();
  const Eigen::Vector2d to = path.poses[std::min(i + 1, path.poses.size() - 1)].position.head<2>();
  const double share = std::uniform_real_distribution<double>(0.0, 1.0)(random);
  const Eigen::Vector2d position = from + share * (to - from);
  EXPECT_FALSE(pathBlocked(path, position, costs))
      << "blocked at segment " << i << " of " << path.poses.size();
}

double distanceTo(const Points& line, const Eigen::Vector2d& point) {
  double least = (line.front() - point).norm();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d along = line[i] - line[i - 1];
    const double squared = along.squaredNorm();
    const double share =
        squared > 0.0 ? std::clamp(along.dot(point - line[i - 1]) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, (line[i - 1] + share * along - point).norm());
  }
  return least;
}

// How far a line has left a start is measured on its first straight stretch.
Points withoutStraightOnes(const Points& line) {
  Points corners = {line.front()};
  for (std::size_t i = 1; i + 1 < line.size(); ++i)
    if (distanceTo({corners.back(), line[i + 1]}, line[i]) > 1e-7) corners.push_back(line[i]);
  if (line.size() > 1) corners.push_back(line.back());
  return corners;
}

// What a file holds keeps the same distances, is as near to the path as it is told to be, and has
// poses as near to one another.
void expectWaypoints(const Plan& plan, const OccupancyGrid& map, const PlannerOptions& options) {
  const Points path = pointsOf(plan.path), waypoints = pointsOf(plan.waypoints);
  expectAllKept(withoutStraightOnes(waypoints), map, options.costmap);
  EXPECT_EQ(waypoints.front(), path.front());
  EXPECT_EQ(waypoints.back(), path.back());
  for (const Eigen::Vector2d& point : path)
    EXPECT_LE(distanceTo(waypoints, point), options.waypoint_tolerance + 1e-6);
  for (std::size_t i = 1; i < waypoints.size() && options.waypoint_spacing > 0.0; ++i)
    EXPECT_LE((waypoints[i] - waypoints[i - 1]).norm(), options.waypoint_spacing * (1.0 + 1e-6));
  if (options.waypoint_spacing == 0.0) {
    EXPECT_LE(waypoints.size(), path.size());
  }
}

struct RadiusCounts {
  int found = 0;
  std::size_t left_out = 0;  // of the paths' poses
};

// Plans between random poses, and judges what is found.
void judge(const OccupancyGrid& map, const PlannerOptions& options, int queries,
           std::mt19937& random, RadiusCounts& counts) {
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  for (int query = 0; query < queries; ++query) {
    const PoseRequest request{randomRadiusPose(random, map.geometry()),
                              randomRadiusPose(random, map.geometry()), false};
    const Plan plan = planner.plan(request);
    if (plan.status != Status::FOUND) continue;
    ++counts.found;
    expectAllKept(pointsOf(plan.path), map, options.costmap);
    expectWaypoints(plan, map, options);
    counts.left_out +=
        std::max(plan.path.poses.size(), plan.waypoints.poses.size()) - plan.waypoints.poses.size();
    const Points start = {request.start.position.head<2>()};
    EXPECT_EQ(plan.message.find("nearer than the radius of") != std::string::npos,
              nearest(start, map, kOccupied, options.costmap.radius) <
                  options.costmap.radius * (1.0 - 1e-7))
        << plan.message;
    expectNotBlocked(plan, *planner.fullResolutionCosts(StopToken()), random);
  }
}

TEST(RadiusLaw, NoPointOfAPathIsNearerThanItMay) {
  std::mt19937 random(13);
  RadiusCounts counts;
  for (int trial = 0; trial < (isLong() ? 10000 : 1500); ++trial) {
    const OccupancyGrid map = randomRadiusMap(random, 48);
    const PlannerOptions options = randomRadiusOptions(random);
    SCOPED_TRACE("trial " + std::to_string(trial) + ' ' + describe(options, map));
    judge(map, options, 3, random, counts);
  }
  std::printf("%d paths\n", counts.found);
  EXPECT_GT(counts.found, 1000);
  EXPECT_GT(counts.left_out, 1000U);
}

// The options above are made for cells of 0.05 m.
PlannerOptions scaled(PlannerOptions options, double factor) {
  options.costmap.radius *= factor;
  if (options.costmap.radius_to_unknown > 0.0) options.costmap.radius_to_unknown *= factor;
  options.costmap.decay /= factor;
  options.waypoint_tolerance *= factor;
  options.waypoint_spacing *= factor;
  return options;
}

// Of maps/, or of the folder that GPP_MAPS names.
TEST(RadiusLaw, HoldsOnTheMapsOfFiles) {
  const char* folder = std::getenv("GPP_MAPS");
  std::mt19937 random(5);
  RadiusCounts counts;
  int maps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder ? folder : "maps")) {
    const std::string ending = entry.path().extension();
    if (ending != ".yaml" && ending != ".map") continue;
    const OccupancyGrid map = grid::readMapFile(entry.path());
    ++maps;
    for (int trial = 0; trial < (isLong() ? 40 : 6); ++trial) {
      const PlannerOptions options =
          scaled(randomRadiusOptions(random), map.geometry().resolution() / 0.05);
      SCOPED_TRACE(entry.path().string() + ' ' + describe(options, map));
      judge(map, options, 4, random, counts);
    }
  }
  std::printf("%d paths on %d maps\n", counts.found, maps);
  EXPECT_GT(counts.found, 3 * maps);
}

}  // namespace
}  // namespace grid_path_planner::planning
