// The surfaces of a world file, in this process: whatever libsdformat and Assimp do happens here. Users
// include simulation/world.h, whose readWorld() has a process of its own for it.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/simulation/triangle_mesh.h"

namespace grid_path_planner::simulation {

struct WorldMeshes {
  std::vector<TriangleMesh> solid;
  std::vector<TriangleMesh> visible;
};

// See readWorld(). Throws InputError.
WorldMeshes readWorldMeshes(const std::string& file);

}  // namespace grid_path_planner::simulation
