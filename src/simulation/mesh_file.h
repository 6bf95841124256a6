// Meshes from files of any format that Assimp reads: OBJ, STL, COLLADA and others.
#pragma once

#include <string>

#include "grid_path_planner/simulation/triangle_mesh.h"

namespace grid_path_planner::simulation {

// All surfaces of the file as one mesh with the file's name, in the file's own axes. Throws
// InputError naming the file where it is missing, damaged, or without a surface.
TriangleMesh readMesh(const std::string& file);

}  // namespace grid_path_planner::simulation
