// Named triangle meshes, of which the simulated world consists, and the shapes of SDF as meshes.
//
//   const TriangleMesh post = cylinderMesh("post", 0.1, 2.0).moved(pose);
//
// Guaranteed: every triangle's corners are in range; moving keeps names, triangles and colours. Curved
// shapes are inscribed polyhedra whose facets stay within 2 mm of the shape up to a radius of 4 m,
// within 1/2000 of the radius beyond. Not guaranteed: closed surfaces or an order of corners;
// a surface has no inside.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace grid_path_planner::simulation {

struct TriangleMesh {
  std::string name;
  std::vector<Eigen::Vector3f> vertices;                // m
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of vertices
  Eigen::Vector3f colour = {0.7f, 0.7f, 0.7f};          // diffuse red, green, blue, 0 to 1

  // The mesh transformed by `pose`.
  TriangleMesh moved(const Eigen::Isometry3d& pose) const;
  Eigen::AlignedBox3f bounds() const;
};

// Shapes about the origin, as SDF defines them; lengths in metres. Throw InputError naming the mesh
// for lengths that are not positive and finite, and for a normal of length zero.
TriangleMesh boxMesh(const std::string& name, const Eigen::Vector3d& size);
TriangleMesh cylinderMesh(const std::string& name, double radius, double length);  // along z
TriangleMesh sphereMesh(const std::string& name, double radius);
// A rectangle of `size`, not an endless plane.
TriangleMesh planeMesh(const std::string& name, const Eigen::Vector3d& normal,
                       const Eigen::Vector2d& size);

}  // namespace grid_path_planner::simulation
