#include "simulation/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::simulation {

using base::InputError;

namespace {

// Assimp passes on what stands in a file, whatever that is.
void checkIndices(const aiFace& face, const aiMesh& part, const std::string& name) {
  const unsigned *const begin = face.mIndices, *const end = begin + face.mNumIndices;
  if (std::any_of(begin, end, [&](unsigned i) { return i >= part.mNumVertices; }))
    throw InputError(name, "has a surface between points that are not there");
}

void append(const aiMesh& part, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i)
    mesh.vertices.emplace_back(part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z);
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;
    checkIndices(face, part, mesh.name);
    mesh.triangles.push_back(
        {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

}  // namespace

TriangleMesh readMesh(const std::string& file) {
  const base::RegularFile regular(file);  // Assimp would wait for a pipe
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene =
      importer.ReadFile(file, aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                  aiProcess_JoinIdenticalVertices);
  if (scene == nullptr)
    throw InputError(file, std::string("not a mesh: ") + importer.GetErrorString());
  return meshOfScene(file, *scene);
}

TriangleMesh meshOfScene(const std::string& name, const aiScene& scene) {
  TriangleMesh mesh{name, {}, {}};
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) append(*scene.mMeshes[i], mesh);
  if (mesh.triangles.empty()) throw InputError(name, "has no surface");
  return mesh;
}

}  // namespace grid_path_planner::simulation
