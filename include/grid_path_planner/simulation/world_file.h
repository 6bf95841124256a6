// Worlds from SDF files, the same ones that Gazebo opens.
//
//   const World world = readWorld("worlds/dexrov_site.sdf");
//
// Read are the first <world> of the file, its models, nested and included ones too, with their
// links, collisions and visuals: <box>, <cylinder>, <sphere>, <plane> (as large as its <size>) and
// <mesh> (whatever Assimp reads, with <scale>). A link's collisions are what can be touched, its
// visuals what is seen; where it has only one kind, that is both. A mesh is called
// model::link::collision, as in Gazebo. Everything stands still, <static> or not. Lights, sensors,
// joints, plugins, materials and physics are passed over.
//
// Meshes and included models are found by file:// or plain names relative to the file that names
// them, and by model:// next to the world file and in the folders of GAZEBO_MODEL_PATH and
// SDF_PATH.
#pragma once

#include <string>

#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::simulation {

// Throws InputError naming the file, with libsdformat's own words (and line, where it gives one)
// for what it does not accept, and with the name of the collision or visual for a geometry of
// another kind, for a mesh that is missing or damaged, and for a world without anything in it.
//
// libsdformat's warnings go to std::cerr. It is not safe to use libsdformat in another thread
// meanwhile: where it finds files and where it writes are settings of the whole process.
World readWorld(const std::string& file);

}  // namespace grid_path_planner::simulation
