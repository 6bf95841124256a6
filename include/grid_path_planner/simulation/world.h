// The static world of a simulated vehicle: solid surfaces, and surfaces visible to its camera.
//
//   const auto world = std::make_shared<const World>(readWorld("worlds/dexrov_site.sdf"));
//   if (const auto surface = world->nearest(position, 0.3))
//     std::cout << surface->name << " is " << surface->distance << " m away\n";
//
// A world is built once, from meshes in the map frame, and then constant: any number of cameras and
// vehicles may share it, from several threads. Guaranteed: the same meshes in the same order give
// the same answers, bit for bit. Surfaces are thin: they have two sides and no inside.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/simulation/triangle_mesh.h"

namespace grid_path_planner::simulation {

// The point of a world's solid surfaces that is nearest to some other point.
struct NearestSurface {
  double distance = 0.0;  // m
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::string_view name = {};  // of its mesh; lives as long as the world
};

class World {
 public:
  // `solid` is what can be touched, `visible` what cameras see. Throws InputError naming the mesh
  // for a vertex that is not finite, beyond 1e6 m, or missing, and for a mesh without triangles.
  World(std::vector<TriangleMesh> solid, std::vector<TriangleMesh> visible);
  // All of it both.
  explicit World(std::vector<TriangleMesh> meshes);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  const std::vector<TriangleMesh>& solid() const { return solid_; }
  const std::vector<TriangleMesh>& visible() const { return visible_; }

  // Nearest point of the solid surfaces, if one is nearer than `reach` metres.
  std::optional<NearestSurface> nearest(const Eigen::Vector3d& from, double reach) const;

 private:
  class SurfaceTree;

  std::vector<TriangleMesh> solid_;
  std::vector<TriangleMesh> visible_;
  std::unique_ptr<const SurfaceTree> tree_;
};

// The world of an SDF file, the same that Gazebo opens. Read are the first <world> of the file, its
// models, nested and included ones too, with their links, collisions and visuals: <box>, <cylinder>, <sphere>, <plane> (as large as its <size>) and
// <mesh> (whatever Assimp reads, with <scale>). A link's collisions are what can be touched, its
// visuals what is seen; where it has only one kind, that is both. A mesh is called
// model::link::collision, as in Gazebo. Everything stands still, <static> or not. Of a visual's material the
// <diffuse> colour is read; lights, sensors, joints, plugins and physics are passed over.
//
// Meshes and included models are found by file:// or plain names relative to the file that names
// them, and by model:// next to the world file and in the folders of GAZEBO_MODEL_PATH and
// SDF_PATH.
//
// Throws InputError naming the file, with libsdformat's own words (and line, where it gives one)
// for what it does not accept, and with the name of the collision or visual for a geometry of
// another kind, for a mesh that is missing or damaged, and for a world without anything in it.
//
// The file and all that it names are read by a program of this package in a process of its own, which
// may take no more than `limits` and is killed where it does: what libsdformat and Assimp make of a
// damaged or hostile file is a sentence of InputError. That process prints libsdformat's warnings on
// the standard error. Several threads may read worlds at the same time.
World readWorld(const std::string& file, const base::ReadLimits& limits = {});

}  // namespace grid_path_planner::simulation
