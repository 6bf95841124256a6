#include "grid_path_planner/simulation/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/BVH>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "simulation/closest_point.h"

namespace grid_path_planner::simulation {

using base::InputError;

namespace {

constexpr float kFarthest = 1e6f;  // m; beyond, a float's steps are longer than 0.06 m

struct Facet {
  Eigen::Vector3d a, b, c;
  std::uint32_t mesh;
};

Eigen::AlignedBox3d bounding_box(const Facet& facet) {  // the name by which Eigen finds it
  Eigen::AlignedBox3d box(facet.a);
  return box.extend(facet.b).extend(facet.c);
}

// The minimizer for Eigen's BVH: holds the nearest facet so far and prunes volumes beyond it.
class Nearest {
 public:
  using Scalar = double;

  Nearest(const Eigen::Vector3d& from, double reach) : from_(from), best_(reach * reach) {}

  double minimumOnVolume(const Eigen::AlignedBox3d& box) const {
    const double distance = box.squaredExteriorDistance(from_);
    return distance < best_ ? distance : std::numeric_limits<double>::max();
  }

  double minimumOnObject(const Facet& facet) {
    const Eigen::Vector3d point = closestPointOnTriangle(from_, facet.a, facet.b, facet.c);
    const double distance = (point - from_).squaredNorm();
    if (distance < best_) {
      best_ = distance;
      point_ = point;
      facet_ = &facet;
    }
    return best_;
  }

  const Facet* facet() const { return facet_; }
  const Eigen::Vector3d& point() const { return point_; }
  double distance() const { return std::sqrt(best_); }

 private:
  const Eigen::Vector3d from_;
  double best_;
  Eigen::Vector3d point_ = Eigen::Vector3d::Zero();
  const Facet* facet_ = nullptr;
};

void checkMesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InputError(mesh.name + ": a mesh without triangles");
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    if (!(vertex.cwiseAbs().maxCoeff() <= kFarthest) || !vertex.allFinite())
      throw InputError(mesh.name + ": vertices must lie within 1e6 m of the origin, got " +
                       std::to_string(vertex.x()) + ", " + std::to_string(vertex.y()) + ", " +
                       std::to_string(vertex.z()));
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= mesh.vertices.size())
        throw InputError(mesh.name + ": a triangle has corner " + std::to_string(corner) + " of " +
                         std::to_string(mesh.vertices.size()) + " vertices");
}

std::vector<Facet> facetsOf(const std::vector<TriangleMesh>& meshes) {
  std::vector<Facet> facets;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (const auto& [a, b, c] : meshes[i].triangles) {
      const auto& vertices = meshes[i].vertices;
      facets.push_back({vertices[a].cast<double>(), vertices[b].cast<double>(),
                        vertices[c].cast<double>(), static_cast<std::uint32_t>(i)});
    }
  return facets;
}

}  // namespace

class World::SurfaceTree {
 public:
  explicit SurfaceTree(const std::vector<Facet>& facets) : tree_(facets.begin(), facets.end()) {}

  Nearest nearest(const Eigen::Vector3d& from, double reach) const {
    Nearest best(from, reach);
    Eigen::BVMinimize(tree_, best);
    return best;
  }

 private:
  Eigen::KdBVH<double, 3, Facet> tree_;
};

World::World(std::vector<TriangleMesh> solid, std::vector<TriangleMesh> visible)
    : solid_(std::move(solid)), visible_(std::move(visible)) {
  for (const TriangleMesh& mesh : solid_) checkMesh(mesh);
  for (const TriangleMesh& mesh : visible_) checkMesh(mesh);
  tree_ = std::make_unique<SurfaceTree>(facetsOf(solid_));
}

World::World(std::vector<TriangleMesh> meshes) : World(meshes, meshes) {}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

std::optional<NearestSurface> World::nearest(const Eigen::Vector3d& from, double reach) const {
  const Nearest best = tree_->nearest(from, reach);
  if (best.facet() == nullptr) return std::nullopt;
  return NearestSurface{best.distance(), best.point(), solid_[best.facet()->mesh].name};
}

}  // namespace grid_path_planner::simulation
