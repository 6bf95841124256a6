// Meshes from files of any format that Assimp reads: OBJ, STL, COLLADA and others.
#pragma once

#include <string>

#include "grid_path_planner/simulation/triangle_mesh.h"

struct aiScene;

namespace grid_path_planner::simulation {

// All surfaces of the file as one mesh with the file's name, in the file's own axes. Throws
// InputError naming the file where it is missing, damaged, or without a surface.
TriangleMesh readMesh(const std::string& file);

// All surfaces of what Assimp has read, with this name. Throws InputError where there is none, and for
// a surface between points that are not there.
TriangleMesh meshOfScene(const std::string& name, const aiScene& scene);

}  // namespace grid_path_planner::simulation
