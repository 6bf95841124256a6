// What becomes of a mesh that Assimp has read, without Assimp's readers: a hundred times as many inputs a
// second, and scenes that no reader of today makes.
#include <assimp/scene.h>

#include "fuzz/files/fuzz_bytes.h"
#include "fuzz/fuzz_target.h"
#include "simulation/mesh_file.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfScenes() {
  const std::string points =
      "\x03\x01\x80\x01\x80\x01\x80\x01\x88\x01\x80\x01\x80\x01\x80\x01\x88\x01\x80";
  return {"\x01" + points + "\x01\x03" + std::string("\x00\x01\x02", 3), "\x02", ""};
}

// The scene deletes what it holds.
aiMesh* meshOf(Bytes& bytes) {
  auto* mesh = new aiMesh;
  mesh->mNumVertices = bytes.byte() % 16;
  mesh->mVertices = new aiVector3D[mesh->mNumVertices + 1];
  for (unsigned i = 0; i < mesh->mNumVertices; ++i)
    for (unsigned axis = 0; axis < 3; ++axis)
      mesh->mVertices[i][axis] = static_cast<ai_real>(bytes.number());
  mesh->mNumFaces = bytes.byte() % 16;
  mesh->mFaces = new aiFace[mesh->mNumFaces + 1];
  for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
    aiFace& face = mesh->mFaces[i];
    face.mNumIndices = bytes.byte() % 5;
    face.mIndices = new unsigned[face.mNumIndices + 1];
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const unsigned index = bytes.byte();
      face.mIndices[k] = index == 255 ? 0xffffffffU : index;
    }
  }
  return mesh;
}

FUZZ_TARGET(mesh_scene, seedsOfScenes) {
  Bytes bytes(input);
  aiScene scene;
  scene.mNumMeshes = bytes.byte() % 4;
  scene.mMeshes = new aiMesh*[scene.mNumMeshes + 1];
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) scene.mMeshes[i] = meshOf(bytes);
  mayRefuse([&] {
    const simulation::TriangleMesh mesh = simulation::meshOfScene("scene", scene);
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t index : triangle)
        mustHold(index < mesh.vertices.size(), "a triangle is between points of its mesh");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
