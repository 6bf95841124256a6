// What becomes of a world that libsdformat has read. Users include world_meshes.h.
#pragma once

#include <functional>
#include <sdf/sdf.hh>
#include <string>

#include "simulation/world_meshes.h"

namespace grid_path_planner::simulation {

using ReadOfMesh = std::function<TriangleMesh(const std::string& file)>;

// The surfaces of the first world of `root`, which stood in `file`; each mesh file is read once, by
// `read_mesh`. Throws InputError.
WorldMeshes meshesOfWorld(const sdf::Root& root, const std::string& file,
                          const ReadOfMesh& read_mesh);

}  // namespace grid_path_planner::simulation
