// What the process that reads a world does, without that process.
#include <utility>

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/simulation/world.h"
#include "simulation/mesh_bytes.h"
#include "simulation/world_meshes.h"

namespace grid_path_planner::fuzz {
namespace {

std::string worldWith(const std::string& shape) {
  return "<?xml version='1.0'?><sdf version='1.6'><world name='w'><model name='m'><static>true"
         "</static><pose>1 2 3 0 0 0.5</pose><link name='l'><pose>0 0 1 0 0 0</pose>"
         "<collision name='c'><geometry>" +
         shape + "</geometry></collision></link></model></world></sdf>";
}

std::vector<std::string> seedsOfWorlds() {
  return {worldWith("<box><size>1 2 3</size></box>"),
          worldWith("<cylinder><radius>2</radius><length>4</length></cylinder>"),
          worldWith("<sphere><radius>3</radius></sphere>"),
          worldWith("<plane><normal>0 0 1</normal><size>6 8</size></plane>"),
          worldWith("<mesh><uri>fuzz_mesh.obj</uri><scale>1 2 -1</scale></mesh>"),
          "<sdf version='1.7'><world name='w'><frame name='f'><pose>5 0 0 0 0 0</pose></frame>"
          "<model name='m'><pose relative_to='f'>0 7 0 0 0 0</pose><link name='l'>"
          "<visual name='v'><geometry><box><size>1 1 1</size></box></geometry></visual></link>"
          "</model></world></sdf>",
          "<sdf version='W1.6'><world name='w'></world></sdf>"};
}

FUZZ_TARGET(world_file, seedsOfWorlds) {
  static const std::string mesh =
      fileOf("fuzz_mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 3 4\n");
  const std::string file = fileOf("fuzz.sdf", input);
  mayRefuse([&] {
    simulation::WorldMeshes meshes =
        simulation::worldMeshesFrom(simulation::bytesOf(simulation::readWorldMeshes(file)));
    simulation::World(std::move(meshes.solid), std::move(meshes.visible))
        .nearest({0.1, 0.2, 0.3}, 10.0);
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
