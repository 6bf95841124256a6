// Meshes as bytes, from one process to another of the same machine and version.
#pragma once

#include <string>

#include "simulation/world_meshes.h"

namespace grid_path_planner::simulation {

std::string bytesOf(const WorldMeshes& meshes);

// Throws InputError where they are cut or hold more than their numbers say.
WorldMeshes worldMeshesFrom(const std::string& bytes);

}  // namespace grid_path_planner::simulation
