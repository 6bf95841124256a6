// What the survey, the demo and later flights rely on in the worlds that come with the package.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/simulation/depth_camera.h"
#include "grid_path_planner/simulation/world.h"
#include "support/free_space.h"

namespace grid_path_planner::simulation {

using base::Status;
using grid::GridGeometry;
using grid::OccupancyGrid;
using planning::PathPlanner;
using planning::Plan;
using planning::PlannerOptions;
using planning::PoseRequest;

namespace {

using Eigen::Vector3d;

const Vector3d kStart(10.6115, -12.4845, 2.947);
const Vector3d kGoal(1.2191, 4.8549, 2.883);
const double kPlanningDepth = 2.915;
const double kSurveyDepth = 4.5;

GridGeometry siteMap(double resolution) {
  return {static_cast<int>(std::lround(18.3 / resolution)),
          static_cast<int>(std::lround(18.1 / resolution)),
          resolution,
          {-2.65, -12.9, 0.0}};
}

const World& site() {
  static const World world = readWorld("worlds/dexrov_site.sdf");
  return world;
}

const World& rescueCourse() {
  static const World world = readWorld("worlds/rescue_course.sdf");
  return world;
}

// The tour that is flown: it ends where it begins.
const std::vector<Vector3d> kTour = {{0.0, 0.0, 1.5},  {30.0, 10.0, 1.5}, {40.0, 7.0, 1.5},
                                     {47.0, 4.5, 1.5}, {38.7, -7.5, 1.5}, {0.0, 0.0, 1.5}};

const World& forestMaze() {
  static const World world = readWorld("worlds/forest_maze.sdf");
  return world;
}

std::string modelOf(std::string_view mesh) {
  return std::string(mesh.substr(0, mesh.find("::")));
}

// What a ball of `radius` would cut on the straight line.
std::set<std::string> modelsBetween(const World& world, const Vector3d& from, const Vector3d& to,
                                    double radius) {
  std::set<std::string> models;
  for (double share = 0.0; share <= 1.0; share += 0.002)
    if (const auto surface = world.nearest(from + share * (to - from), radius))
      models.insert(modelOf(surface->name));
  return models;
}

Plan route(const OccupancyGrid& map, const Vector3d& from, const Vector3d& to, double radius = 0.0,
           int kernel = 1, const std::string& planner_name = "weighted_jump_point") {
  PlannerOptions options;
  options.planner = planner_name;
  options.costmap.radius = radius;
  options.costmap.kernel = kernel;
  options.retry_finer = false;
  options.timeout = 0.0;
  options.smooth = false;  // the laws are of paths over the grid
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  PoseRequest request;
  request.start.position = from;
  request.goal.position = to;
  return planner.plan(request);
}

TEST(DexrovSite, HasWhatTheStudyHad) {
  std::set<std::string> models;
  for (const TriangleMesh& mesh : site().visible()) models.insert(modelOf(mesh.name));
  for (const char* name : {"seabed", "vessel", "testing_panel", "wreck", "mooring_block",
                           "mooring_chain", "manifold", "rock_1", "rock_40", "pole_1"})
    EXPECT_EQ(models.count(name), 1u) << name;
  std::set<std::string> of_panel;
  for (const TriangleMesh& mesh : site().solid())
    if (modelOf(mesh.name) == "testing_panel") of_panel.insert(mesh.name);
  EXPECT_EQ(of_panel.count("testing_panel::body::wheel_1"), 1u) << "valves to turn";
  EXPECT_EQ(of_panel.count("testing_panel::body::lever_4"), 1u);
}

TEST(DexrovSite, TheSeabedIsUnevenAndReachesBeyondTheMap) {
  Eigen::AlignedBox3f bounds;
  Eigen::Vector3f lowest(0.0f, 0.0f, 1e9f), highest(0.0f, 0.0f, -1e9f);
  for (const TriangleMesh& mesh : site().solid()) {
    if (modelOf(mesh.name) != "seabed") continue;
    bounds = mesh.bounds();
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      const auto cell = siteMap(0.05).cellAt(vertex.head<2>().cast<double>());
      if (cell && vertex.z() < lowest.z()) lowest = vertex;
      if (cell && vertex.z() > highest.z()) highest = vertex;
    }
  }
  EXPECT_LT(bounds.min().x(), -2.65f - 2.0f);
  EXPECT_LT(bounds.min().y(), -12.9f - 2.0f);
  EXPECT_GT(bounds.max().x(), 15.65f + 2.0f);
  EXPECT_GT(bounds.max().y(), 5.2f + 2.0f);
  EXPECT_GE(lowest.z(), 0.0f);
  EXPECT_LT(highest.z(), 2.2f) << "paths are planned from 2.4 m on";
  EXPECT_GT(highest.z() - lowest.z(), 1.0f);
}

TEST(DexrovSite, BothEndsOfThePlanAreFree) {
  for (const Vector3d& end : {kStart, kGoal})
    if (const auto surface = site().nearest(end, 1.0))
      ADD_FAILURE() << surface->name << " is " << surface->distance << " m from an end";
}

TEST(DexrovSite, TheStraightLineIsBlockedBySeveralThings) {
  const std::set<std::string> models = modelsBetween(site(), kStart, kGoal, 0.3);
  EXPECT_GE(models.size(), 3u);
  EXPECT_EQ(models.count("wreck"), 1u);
}

TEST(DexrovSite, AtTheDepthOfTheSurveyOnlyTheChainIsAnObstacle) {
  const GridGeometry map = siteMap(0.1);
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      const Eigen::Vector2d centre = map.centre({column, row});
      const auto surface = site().nearest({centre.x(), centre.y(), kSurveyDepth}, 0.4);
      if (surface) {
        ASSERT_EQ(modelOf(surface->name), "mooring_chain") << centre.transpose();
      }
    }
}

TEST(DexrovSite, VehiclesOfBothRadiiFindAPath) {
  for (const double radius : {0.3, 0.4}) {
    const OccupancyGrid map = test::occupiedAt(site(), siteMap(0.1), {kPlanningDepth}, radius);
    const Plan report = route(map, kStart, kGoal);
    EXPECT_EQ(report.status, Status::FOUND) << report.message;
    EXPECT_GT(report.length_m, 1.1 * (kGoal - kStart).norm());
  }
}

TEST(DexrovSite, ThePassageThroughTheWreckIsWideEnoughForOneVehicle) {
  const Vector3d south(5.65, -7.1, kPlanningDepth), north(3.8, -2.9, kPlanningDepth);
  const GridGeometry around(80, 110, 0.05, {3.0, -7.8, 0.0});
  const auto length = [&](double radius) {
    return route(test::occupiedAt(site(), around, {kPlanningDepth}, radius), south, north).length_m;
  };
  const double through = length(0.4);
  EXPECT_GT(through, 0.0) << "no path";
  EXPECT_LT(through, 5.5);
  EXPECT_EQ(length(0.65), 0.0) << "the passage is narrow";
}

// The study's three kernels, on what a perfect survey would map.
TEST(DexrovSite, KernelsGiveVisiblyDifferentMapsAndPaths) {
  const OccupancyGrid map =
      test::occupiedAt(site(), siteMap(0.05), {2.45, 2.7, 2.95, 3.2, 3.35}, 0.03);
  std::vector<double> lengths;
  for (const int kernel : {1, 3, 5, 7}) {
    const Plan report = route(map, kStart, kGoal, 0.3, kernel);
    ASSERT_EQ(report.status, Status::FOUND) << "kernel " << kernel << ": " << report.message;
    lengths.push_back(report.length_m);
  }
  EXPECT_GT(lengths[1], lengths[0] + 0.5) << "kernel 3 closes a passage";
  EXPECT_GT(lengths[3], lengths[0] + 3.0) << "kernel 7 closes more";
  EXPECT_NE(lengths[2], lengths[3]);
}

TEST(DexrovSite, ACameraThatLooksAheadAndDownSeesTheSeabed) {
  DepthCameraOptions options;
  options.pitch = 1.0;
  const DepthCamera camera(site(), options);
  Eigen::Isometry3d vehicle(Eigen::Translation3d(2.0, -11.0, kSurveyDepth));
  std::vector<float> points;
  camera.render(vehicle * camera.baseFromOptical(), 0, points);
  std::size_t measured = 0;
  for (std::size_t i = 0; i < points.size(); i += 3) measured += !std::isnan(points[i]);
  EXPECT_GT(3.0 * measured / points.size(), 0.9);
}

TEST(ForestMaze, APathLeadsThroughMazeAndGrove) {
  const Vector3d from(1.5, 1.5, 1.5), to(58.0, 28.0, 1.5);
  EXPECT_GE(modelsBetween(forestMaze(), from, to, 0.4).size(), 2u);
  const OccupancyGrid map = test::occupiedAt(forestMaze(), GridGeometry(300, 150, 0.2), {1.5}, 0.4);
  const Plan report = route(map, from, to);
  EXPECT_EQ(report.status, Status::FOUND) << report.message;
  EXPECT_GT(report.length_m, 1.2 * (to - from).norm());
}

TEST(ForestMaze, AboveItsTreesIsNothing) {
  for (double x = 0.0; x <= 60.0; x += 0.5)
    for (double y = 0.0; y <= 30.0; y += 0.5)
      ASSERT_FALSE(forestMaze().nearest({x, y, 10.0}, 1.0)) << x << ", " << y;
}

TEST(RescueCourse, EveryPlaceOfTheTourIsClearByAMetre) {
  for (const Vector3d& place : kTour)
    if (const auto surface = rescueCourse().nearest(place, 1.0))
      ADD_FAILURE() << surface->name << " is " << surface->distance << " m from "
                    << place.transpose();
}

// A vehicle that only flies straight touches something twice out and home.
TEST(RescueCourse, TheFirstLegAndTheLastAreBlockedTwice) {
  const auto blocking = [](std::size_t leg) {
    std::set<std::string> names;
    for (double share = 0.0; share <= 1.0; share += 0.002)
      if (const auto surface =
              rescueCourse().nearest(kTour[leg] + share * (kTour[leg + 1] - kTour[leg]), 0.3))
        names.emplace(surface->name);
    return names.size();
  };
  EXPECT_GE(blocking(0), 2u);
  EXPECT_GE(blocking(kTour.size() - 2), 2u);
}

// L*: what the reports of flights call the shortest tour.
TEST(RescueCourse, TheShortestTourIsFrom108To116Metres) {
  const OccupancyGrid slice =
      test::occupiedAt(rescueCourse(), GridGeometry(640, 380, 0.1, {-4.0, -18.0, 0.0}), {1.5}, 0.6);
  double length = 0.0;
  for (std::size_t leg = 0; leg + 1 < kTour.size(); ++leg) {
    const Plan plan = route(slice, kTour[leg], kTour[leg + 1], 0.0, 1, "anya");
    ASSERT_EQ(plan.status, Status::FOUND) << "leg " << leg << ": " << plan.message;
    length += plan.length_m;
  }
  EXPECT_GE(length, 108.0);
  EXPECT_LE(length, 116.0);
  RecordProperty("L_star_cm", static_cast<int>(std::lround(100.0 * length)));
}

TEST(RescueCourse, TheGroundIsUnderAllOfIt) {
  for (double x = -8.0; x <= 58.0; x += 2.0)
    for (double y = -20.0; y <= 22.0; y += 2.0)
      ASSERT_TRUE(rescueCourse().nearest({x, y, 0.0}, 1e-3)) << x << ", " << y;
}

// Doors of 0.8 m: a disc of 0.38 m passes, one of 0.42 m does not.
TEST(Office, EachRoomIsReachedFromTheCorridorByItsDoor) {
  const World world = readWorld("worlds/office.sdf");
  const GridGeometry geometry(600, 440, 0.025, {-0.5, -0.5, 0.0});
  const Vector3d corridor(7.0, 5.0, 0.2);
  const OccupancyGrid passable = test::occupiedAt(world, geometry, {0.2}, 0.38);
  const OccupancyGrid closed = test::occupiedAt(world, geometry, {0.2}, 0.42);
  for (const Vector3d& room :
       {Vector3d(2.0, 3.2, 0.2), Vector3d(7.0, 2.0, 0.2), Vector3d(11.8, 2.3, 0.2),
        Vector3d(2.0, 7.2, 0.2), Vector3d(4.6, 6.8, 0.2), Vector3d(11.0, 7.5, 0.2)}) {
    EXPECT_EQ(route(passable, corridor, room).status, Status::FOUND) << room.transpose();
    EXPECT_EQ(route(closed, corridor, room).status, Status::UNREACHABLE) << room.transpose();
  }
}

TEST(Worlds, AreSmall) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator("worlds"))
    if (entry.is_regular_file()) bytes += entry.file_size();
  EXPECT_LT(bytes, 500'000u);  // of which the panel's markers and their site have 42'000
}

}  // namespace
}  // namespace grid_path_planner::simulation
