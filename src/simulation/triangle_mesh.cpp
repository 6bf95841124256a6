#include "grid_path_planner/simulation/triangle_mesh.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::simulation {

using base::decimalText;
using base::InputError;

namespace {

void checkLength(const std::string& name, const char* what, double length) {
  if (!(length > 0.0 && std::isfinite(length)))
    throw InputError(name + ": " + what + " must be a positive number of metres, got " +
                     decimalText(length));
}

// How far the facets of a shape with this radius may be off.
double allowedError(double radius) {
  return std::max(0.002, 0.0005 * radius);
}

// Corners of a circle's polygon whose sides stay as near as `sagitta` to the circle.
int circleCorners(double radius, double sagitta) {
  const double half_angle = std::acos(std::max(0.5, 1.0 - sagitta / radius));
  return std::max(12, static_cast<int>(std::ceil(M_PI / half_angle)));
}

// A ring of `corners` vertices about the z axis.
void addRing(TriangleMesh& mesh, int corners, double radius, double z) {
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    mesh.vertices.push_back(
        Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z).cast<float>());
  }
}

// The band between the ring that begins at vertex `lower` and the one right after it.
void addBand(TriangleMesh& mesh, std::uint32_t lower, std::uint32_t corners) {
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t a = lower + i;
    const std::uint32_t b = lower + (i + 1) % corners;
    mesh.triangles.push_back({a, b, b + corners});
    mesh.triangles.push_back({a, b + corners, a + corners});
  }
}

// The fan from a ring to a tip on the z axis.
void addTip(TriangleMesh& mesh, std::uint32_t ring, std::uint32_t corners, double z) {
  const auto tip = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.0f, 0.0f, static_cast<float>(z));
  for (std::uint32_t i = 0; i < corners; ++i)
    mesh.triangles.push_back({tip, ring + i, ring + (i + 1) % corners});
}

}  // namespace

TriangleMesh TriangleMesh::moved(const Eigen::Isometry3d& pose) const {
  TriangleMesh result = *this;
  for (Eigen::Vector3f& vertex : result.vertices)
    vertex = (pose * vertex.cast<double>()).cast<float>();
  return result;
}

Eigen::AlignedBox3f TriangleMesh::bounds() const {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : vertices) box.extend(vertex);
  return box;
}

TriangleMesh boxMesh(const std::string& name, const Eigen::Vector3d& size) {
  for (int axis = 0; axis < 3; ++axis) checkLength(name, "the size of a box", size[axis]);
  TriangleMesh mesh{name, {}, {}};
  for (unsigned corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back(
        (0.5 * Eigen::Vector3d(corner & 1 ? size.x() : -size.x(), corner & 2 ? size.y() : -size.y(),
                               corner & 4 ? size.z() : -size.z()))
            .cast<float>());
  for (const auto& [a, b, c, d] : std::array<std::array<std::uint32_t, 4>, 6>{
           {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

TriangleMesh cylinderMesh(const std::string& name, double radius, double length) {
  checkLength(name, "the radius of a cylinder", radius);
  checkLength(name, "the length of a cylinder", length);
  const int corners = circleCorners(radius, allowedError(radius));
  TriangleMesh mesh{name, {}, {}};
  addRing(mesh, corners, radius, -0.5 * length);
  addRing(mesh, corners, radius, 0.5 * length);
  addBand(mesh, 0, corners);
  addTip(mesh, 0, corners, -0.5 * length);
  addTip(mesh, corners, corners, 0.5 * length);
  return mesh;
}

TriangleMesh sphereMesh(const std::string& name, double radius) {
  checkLength(name, "the radius of a sphere", radius);
  const int corners =
      circleCorners(radius, 0.5 * allowedError(radius));  // curved in two directions
  const int rings = corners / 2;
  TriangleMesh mesh{name, {}, {}};
  for (int ring = 0; ring < rings; ++ring) {
    const double latitude = M_PI * ((ring + 1.0) / (rings + 1.0) - 0.5);
    addRing(mesh, corners, radius * std::cos(latitude), radius * std::sin(latitude));
    if (ring > 0) addBand(mesh, (ring - 1) * corners, corners);
  }
  addTip(mesh, 0, corners, -radius);
  addTip(mesh, (rings - 1) * corners, corners, radius);
  return mesh;
}

TriangleMesh planeMesh(const std::string& name, const Eigen::Vector3d& normal,
                       const Eigen::Vector2d& size) {
  checkLength(name, "the size of a plane", size.x());
  checkLength(name, "the size of a plane", size.y());
  checkLength(name, "the normal of a plane", normal.norm());
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
  TriangleMesh mesh{name, {}, {{0, 1, 2}, {0, 2, 3}}};
  for (const auto& [x, y] :
       std::array<std::array<double, 2>, 4>{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}})
    mesh.vertices.push_back(
        (turn * Eigen::Vector3d(x * size.x(), y * size.y(), 0.0)).cast<float>());
  return mesh;
}

}  // namespace grid_path_planner::simulation
