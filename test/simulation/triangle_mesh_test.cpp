#include "grid_path_planner/simulation/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/error_text.h"

namespace grid_path_planner::simulation {

using base::InputError;

namespace {

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.vertices[b] - mesh.vertices[a])
                     .cross(mesh.vertices[c] - mesh.vertices[a])
                     .cast<double>()
                     .norm();
  return sum;
}

TEST(TriangleMesh, ShapesHaveTheirSizesAndAreas) {
  const TriangleMesh box = boxMesh("box", {1.0, 2.0, 3.0});
  EXPECT_TRUE(box.bounds().isApprox(Eigen::AlignedBox3f(Eigen::Vector3f(-0.5f, -1.0f, -1.5f),
                                                        Eigen::Vector3f(0.5f, 1.0f, 1.5f))));
  EXPECT_NEAR(area(box), 22.0, 1e-6);
  const TriangleMesh cylinder = cylinderMesh("cylinder", 0.5, 2.0);
  EXPECT_FLOAT_EQ(cylinder.bounds().min().z(), -1.0f);
  EXPECT_FLOAT_EQ(cylinder.bounds().max().z(), 1.0f);
  EXPECT_NEAR(area(cylinder), 2.5 * M_PI, 0.05);
  EXPECT_NEAR(area(sphereMesh("sphere", 1.0)), 4.0 * M_PI, 0.1);
  EXPECT_NEAR(area(planeMesh("plane", Eigen::Vector3d::UnitX(), {2.0, 3.0})), 6.0, 1e-6);
}

TEST(TriangleMesh, FacetsStayNearTheShape) {
  for (const double radius : {0.01, 0.1, 1.0, 4.0, 50.0}) {
    const double allowed = std::max(0.002, 0.0005 * radius) * 1.0001;
    const TriangleMesh sphere = sphereMesh("sphere", radius);
    for (const auto& [a, b, c] : sphere.triangles) {
      const Eigen::Vector3d middle =
          (sphere.vertices[a] + sphere.vertices[b] + sphere.vertices[c]).cast<double>() / 3.0;
      ASSERT_NEAR(middle.norm(), radius, allowed);
    }
  }
}

TEST(TriangleMesh, APlaneLiesAcrossItsNormal) {
  const Eigen::Vector3d normal(1.0, 2.0, -3.0);
  for (const Eigen::Vector3f& vertex : planeMesh("plane", normal, {2.0, 3.0}).vertices)
    EXPECT_NEAR(vertex.cast<double>().dot(normal), 0.0, 1e-5);
}

TEST(TriangleMesh, IsMovedByAPose) {
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  const Eigen::AlignedBox3f box = boxMesh("box", {4.0, 2.0, 1.0}).moved(pose).bounds();
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3f(0.0f, 0.0f, 2.5f), 1e-6f));
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3f(2.0f, 4.0f, 3.5f), 1e-6f));
}

TEST(TriangleMesh, RefusesLengthsThatAreNone) {
  for (const double bad : {0.0, -1.0, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(boxMesh("box", {1.0, 1.0, bad}), InputError);
    EXPECT_THROW(cylinderMesh("cylinder", bad, 1.0), InputError);
    EXPECT_THROW(cylinderMesh("cylinder", 1.0, bad), InputError);
    EXPECT_THROW(sphereMesh("sphere", bad), InputError);
    EXPECT_THROW(planeMesh("plane", Eigen::Vector3d::UnitZ(), {1.0, bad}), InputError);
  }
  EXPECT_EQ(test::errorText([] { sphereMesh("buoy", -1.0); }),
            "buoy: the radius of a sphere must be a positive number of metres, got -1");
  EXPECT_THROW(planeMesh("plane", Eigen::Vector3d::Zero(), {1.0, 1.0}), InputError);
}

}  // namespace
}  // namespace grid_path_planner::simulation
