#include "simulation/mesh_bytes.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::simulation {

using base::InputError;

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Vertex = std::array<float, 3>;
static_assert(sizeof(Vertex) == sizeof(Eigen::Vector3f) && sizeof(Triangle) == 12);

void putNumber(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void putMeshes(std::string& bytes, const std::vector<TriangleMesh>& meshes) {
  putNumber(bytes, meshes.size());
  for (const TriangleMesh& mesh : meshes) {
    putNumber(bytes, mesh.name.size());
    putNumber(bytes, mesh.vertices.size());
    putNumber(bytes, mesh.triangles.size());
    bytes += mesh.name;
    bytes.append(reinterpret_cast<const char*>(mesh.vertices.data()),
                 mesh.vertices.size() * sizeof(Vertex));
    bytes.append(reinterpret_cast<const char*>(mesh.triangles.data()),
                 mesh.triangles.size() * sizeof(Triangle));
    bytes.append(reinterpret_cast<const char*>(mesh.colour.data()), sizeof(Vertex));
  }
}

class MeshReader {
 public:
  explicit MeshReader(const std::string& bytes) : bytes_(bytes) {}

  std::vector<TriangleMesh> meshes() {
    std::vector<TriangleMesh> meshes;
    for (std::uint64_t left = number(); left > 0; --left) meshes.push_back(mesh());
    return meshes;
  }
  void checkEnd() const {
    if (at_ != bytes_.size()) throw InputError("the meshes of a world go on after their end");
  }

 private:
  TriangleMesh mesh() {
    const std::uint64_t letters = number(), vertices = number(), triangles = number();
    TriangleMesh mesh;
    const char* name = take(letters, 1);
    mesh.name.assign(name, letters);
    const char* points = take(vertices, sizeof(Vertex));
    mesh.vertices.resize(vertices);
    for (Eigen::Vector3f& vertex : mesh.vertices) {
      std::memcpy(vertex.data(), points, sizeof(Vertex));
      points += sizeof(Vertex);
    }
    const char* corners = take(triangles, sizeof(Triangle));
    mesh.triangles.resize(triangles);
    if (triangles > 0) std::memcpy(mesh.triangles.data(), corners, triangles * sizeof(Triangle));
    std::memcpy(mesh.colour.data(), take(1, sizeof(Vertex)), sizeof(Vertex));
    return mesh;
  }
  std::uint64_t number() {
    std::uint64_t number;
    std::memcpy(&number, take(1, sizeof number), sizeof number);
    return number;
  }
  const char* take(std::uint64_t count, std::size_t size) {
    if (count > (bytes_.size() - at_) / size) throw InputError("the meshes of a world are cut");
    const char* begin = bytes_.data() + at_;
    at_ += count * size;
    return begin;
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::string bytesOf(const WorldMeshes& meshes) {
  std::string bytes;
  putMeshes(bytes, meshes.solid);
  putMeshes(bytes, meshes.visible);
  return bytes;
}

WorldMeshes worldMeshesFrom(const std::string& bytes) {
  MeshReader reader(bytes);
  WorldMeshes meshes;
  meshes.solid = reader.meshes();
  meshes.visible = reader.meshes();
  reader.checkEnd();
  return meshes;
}

}  // namespace grid_path_planner::simulation
