#include <utility>

#include "base/child_process.h"
#include "grid_path_planner/simulation/world.h"
#include "simulation/mesh_bytes.h"
#include "simulation/read_world_main.h"

namespace grid_path_planner::simulation {

using base::InputError, base::ReadLimits;

namespace {

// A facet of what can be touched, in the tree that finds the nearest one, while that is built.
constexpr std::size_t kBytesOfFacet = 400;

std::size_t bytesOfTree(const WorldMeshes& meshes) {
  std::size_t facets = 0;
  for (const TriangleMesh& mesh : meshes.solid) facets += mesh.triangles.size();
  return facets * kBytesOfFacet;
}

World worldWithin(const std::string& file, ReadLimits& limits) {
  const std::string answer = base::answerOfChild("read_world", file, limits);
  limits.take(file, answer.size());
  WorldMeshes meshes = worldMeshesFrom(answer);
  limits.take(file, bytesOfTree(meshes));
  limits.goOn(file);
  try {
    return World(std::move(meshes.solid), std::move(meshes.visible));
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
}

}  // namespace

int readWorldMain(int argc, char** argv) {
  return base::childMain(argc, argv,
                         [](const std::string& file) { return bytesOf(readWorldMeshes(file)); });
}

World readWorld(const std::string& file, const ReadLimits& limits) {
  return base::readWithin(file, limits,
                          [&](ReadLimits& within) { return worldWithin(file, within); });
}

}  // namespace grid_path_planner::simulation
