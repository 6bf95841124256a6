#include "grid_path_planner/simulation/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/error_text.h"

namespace grid_path_planner::simulation {

using base::InputError;

namespace {

using Eigen::Vector3d;

World ball() {
  return World({sphereMesh("ball", 1.0)});
}

TEST(World, NearestPointOfABall) {
  const World world = ball();
  const auto surface = world.nearest({3.0, 0.0, 0.0}, 10.0);
  ASSERT_TRUE(surface);
  EXPECT_NEAR(surface->distance, 2.0, 0.003);
  EXPECT_TRUE(surface->point.isApprox(Vector3d::UnitX(), 0.05)) << surface->point.transpose();
  EXPECT_EQ(surface->name, "ball");
}

TEST(World, NothingWithinReachIsNothing) {
  EXPECT_FALSE(ball().nearest({3.0, 0.0, 0.0}, 1.9));
  EXPECT_FALSE(World({}).nearest(Vector3d::Zero(), 1e9));
}

TEST(World, SurfacesHaveNoInside) {
  const auto surface = ball().nearest({0.9, 0.0, 0.0}, 1.0);
  ASSERT_TRUE(surface);
  EXPECT_NEAR(surface->distance, 0.1, 0.003);
}

TEST(World, OnlySolidSurfacesAreNear) {
  const World world({boxMesh("solid", {1.0, 1.0, 1.0})}, {boxMesh("visible", {5.0, 5.0, 5.0})});
  EXPECT_EQ(world.nearest({9.0, 0.0, 0.0}, 100.0)->name, "solid");
}

// Triangles of every shape, needles and points among them, against a search over all of them by
// samples: never farther than a sample, and the point lies on its triangle.
TEST(WorldLaw, NearestIsNoFartherThanAnyPointOfAnySurface) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-5.0f, 5.0f);
  const auto point = [&] {
    return Eigen::Vector3f(coordinate(random), coordinate(random), coordinate(random));
  };
  for (int round = 0; round < 60; ++round) {
    std::vector<TriangleMesh> meshes;
    for (int i = 0; i < 1 + round; ++i) {
      TriangleMesh mesh{"triangle", {point(), point(), point()}, {{0, 1, 2}}};
      if (i % 5 == 1) mesh.vertices[2] = mesh.vertices[1];
      if (i % 5 == 2) mesh.vertices[1] = mesh.vertices[2] = mesh.vertices[0];
      if (i % 5 == 3) mesh.vertices[2] = 0.5f * (mesh.vertices[0] + mesh.vertices[1]);
      meshes.push_back(mesh);
    }
    const World world(meshes);
    const Vector3d from = point().cast<double>();
    const auto surface = world.nearest(from, 100.0);
    ASSERT_TRUE(surface);
    EXPECT_NEAR((surface->point - from).norm(), surface->distance, 1e-9);
    double least = 1e9;
    for (const TriangleMesh& mesh : meshes)
      for (double u = 0.0; u <= 1.0; u += 0.05)
        for (double v = 0.0; u + v <= 1.0 + 1e-9; v += 0.05) {
          const Vector3d sample = (1.0 - u - v) * mesh.vertices[0].cast<double>() +
                                  u * mesh.vertices[1].cast<double>() +
                                  v * mesh.vertices[2].cast<double>();
          least = std::min(least, (sample - from).norm());
        }
    EXPECT_LE(surface->distance, least + 1e-6) << "round " << round;
    EXPECT_GE(surface->distance, least - 0.6) << "no such surface, round " << round;
  }
}

TEST(World, RefusesDamagedMeshes) {
  TriangleMesh mesh = boxMesh("crate", {1.0, 1.0, 1.0});
  mesh.vertices[3].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(test::errorText([&] { World{{mesh}}; }).find("crate: vertices must"), 0u);
  mesh.vertices[3].y() = 2e6f;
  EXPECT_THROW(World({mesh}), InputError);
  mesh = boxMesh("crate", {1.0, 1.0, 1.0});
  mesh.triangles[2][1] = 8;
  EXPECT_EQ(test::errorText([&] { World{{mesh}}; }),
            "crate: a triangle has corner 8 of 8 vertices");
  mesh.triangles.clear();
  EXPECT_THROW(World({mesh}), InputError);
}

}  // namespace
}  // namespace grid_path_planner::simulation
