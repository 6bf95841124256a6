#include "simulation/world_meshes.h"

#include <filesystem>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/plain_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"
#include "simulation/mesh_file.h"
#include "simulation/resource_path.h"
#include "simulation/sdf_file.h"
#include "simulation/world_walk.h"

namespace grid_path_planner::simulation {

using base::checkPlainText;
using base::InputError;

namespace {

// Names are said and published where the vehicle runs into something.
constexpr std::size_t kLongestName = 256;       // bytes, of a model, link or shape
constexpr std::size_t kLongestWhole = 1024;     // with those that it is part of
constexpr std::size_t kLongestSentence = 4000;  // about a world

Eigen::Vector3d vectorOf(const ignition::math::Vector3d& v) {
  return {v.X(), v.Y(), v.Z()};
}

std::string folderOf(const std::string& file) {
  const std::string folder = std::filesystem::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
}

// The meshes of one world, gathered from model to model.
class WorldReader {
 public:
  WorldReader(std::string file, const ReadOfMesh& read_mesh)
      : file_(std::move(file)), folder_(folderOf(file_)), read_mesh_(read_mesh) {}

  WorldMeshes read(const sdf::Root& root) {
    const sdf::World* world = root.WorldByIndex(0);
    if (world == nullptr) throw InputError(file_, "has no <world>");
    try {
      for (std::size_t i = 0; i < world->ModelCount(); ++i)
        addModel(*world->ModelByIndex(i), Eigen::Isometry3d::Identity(), "");
      if (solid_.empty()) throw InputError("its world is empty");
      return {std::move(solid_), std::move(visible_)};
    } catch (const InputError& error) {
      throw InputError(file_, error.what());
    }
  }

 private:
  // Where `thing` (model, link, collision or visual) is, given where its parent is.
  template <class Thing>
  Eigen::Isometry3d poseOf(const Thing& thing, const Eigen::Isometry3d& parent,
                           const std::string& name) const {
    ignition::math::Pose3d pose;
    const sdf::Errors errors = thing.SemanticPose().Resolve(pose);
    if (!errors.empty()) throw InputError(name, errors.front().Message());
    const ignition::math::Quaterniond& turn = pose.Rot();
    return parent * Eigen::Translation3d(vectorOf(pose.Pos())) *
           Eigen::Quaterniond(turn.W(), turn.X(), turn.Y(), turn.Z());
  }

  void addModel(const sdf::Model& model, const Eigen::Isometry3d& parent,
                const std::string& prefix) {
    checkPlainText("the name of a model", model.Name(), kLongestName);
    const std::string name = prefix + model.Name();
    const Eigen::Isometry3d pose = poseOf(model, parent, name);
    for (std::size_t i = 0; i < model.LinkCount(); ++i)
      addLink(*model.LinkByIndex(i), pose, name + "::");
    for (std::size_t i = 0; i < model.ModelCount(); ++i)
      addModel(*model.ModelByIndex(i), pose, name + "::");
  }

  void addLink(const sdf::Link& link, const Eigen::Isometry3d& parent, const std::string& prefix) {
    checkPlainText("the name of a link", link.Name(), kLongestName);
    const std::string name = prefix + link.Name() + "::";
    const Eigen::Isometry3d pose = poseOf(link, parent, prefix + link.Name());
    std::vector<TriangleMesh> collisions;
    std::vector<TriangleMesh> visuals;
    for (std::size_t i = 0; i < link.CollisionCount(); ++i)
      addShape(*link.CollisionByIndex(i), pose, name, collisions);
    for (std::size_t i = 0; i < link.VisualCount(); ++i)
      addShape(*link.VisualByIndex(i), pose, name, visuals);
    const auto& touched = collisions.empty() ? visuals : collisions;
    const auto& seen = visuals.empty() ? collisions : visuals;
    solid_.insert(solid_.end(), touched.begin(), touched.end());
    visible_.insert(visible_.end(), seen.begin(), seen.end());
  }

  template <class Shape>  // collision or visual
  void addShape(const Shape& shape, const Eigen::Isometry3d& parent, const std::string& prefix,
                std::vector<TriangleMesh>& meshes) {
    checkPlainText("the name of a shape", shape.Name(), kLongestName);
    const std::string name = prefix + shape.Name();
    checkPlainText("the name of a shape with its models' and its link's", name, kLongestWhole);
    const sdf::Geometry* geometry = shape.Geom();
    const std::string kind = kindOf(geometry);
    if (kind == "empty") return;
    meshes.push_back(meshOf(name, kind, *geometry).moved(poseOf(shape, parent, name)));
    if constexpr (std::is_same_v<Shape, sdf::Visual>) paint(shape, meshes.back());
  }

  // With the <diffuse> of the visual's <material>, if it has one that is a colour.
  static void paint(const sdf::Visual& visual, TriangleMesh& mesh) {
    const sdf::Material* material = visual.Material();
    if (material == nullptr || !material->Element() || !material->Element()->HasElement("diffuse"))
      return;
    const ignition::math::Color& diffuse = material->Diffuse();
    const Eigen::Vector3f colour(diffuse.R(), diffuse.G(), diffuse.B());
    if (colour.allFinite()) mesh.colour = colour.cwiseMax(0.0f).cwiseMin(1.0f);
  }

  // The name of the element inside <geometry>; libsdformat's own list of kinds depends on its age.
  static std::string kindOf(const sdf::Geometry* geometry) {
    if (geometry == nullptr || !geometry->Element()) return "empty";
    const sdf::ElementPtr element = geometry->Element()->GetFirstElement();
    return element ? element->GetName() : "empty";
  }

  TriangleMesh meshOf(const std::string& name, const std::string& kind,
                      const sdf::Geometry& geometry) {
    switch (geometry.Type()) {
      case sdf::GeometryType::BOX:
        return boxMesh(name, vectorOf(geometry.BoxShape()->Size()));
      case sdf::GeometryType::CYLINDER:
        return cylinderMesh(name, geometry.CylinderShape()->Radius(),
                            geometry.CylinderShape()->Length());
      case sdf::GeometryType::SPHERE:
        return sphereMesh(name, geometry.SphereShape()->Radius());
      case sdf::GeometryType::PLANE:
        return planeMesh(name, vectorOf(geometry.PlaneShape()->Normal()),
                         {geometry.PlaneShape()->Size().X(), geometry.PlaneShape()->Size().Y()});
      case sdf::GeometryType::MESH:
        return fileMesh(name, *geometry.MeshShape());
      default:
        throw InputError(name + ": a <" + kind +
                         "> is not read, only box, cylinder, sphere, plane and mesh");
    }
  }

  TriangleMesh fileMesh(const std::string& name, const sdf::Mesh& shape) {
    if (!shape.Submesh().empty())
      throw InputError(name + ": a <submesh> is not read, only whole meshes");
    const std::string path = resourcePath(shape.Uri(), folderOf(shape.FilePath()), folder_);
    if (path.empty()) throw InputError(name + ": there is no mesh " + shape.Uri());
    auto known = meshes_.find(path);
    if (known == meshes_.end()) known = meshes_.emplace(path, read_mesh_(path)).first;
    TriangleMesh mesh = known->second;
    mesh.name = name;
    const Eigen::Vector3f scale = vectorOf(shape.Scale()).cast<float>();
    for (Eigen::Vector3f& vertex : mesh.vertices) vertex = vertex.cwiseProduct(scale);
    return mesh;
  }

  const std::string file_;
  const std::string folder_;
  const ReadOfMesh& read_mesh_;
  std::vector<TriangleMesh> solid_;
  std::vector<TriangleMesh> visible_;
  std::map<std::string, TriangleMesh> meshes_;  // by their files, each of which is read once
};

WorldMeshes readUnchecked(const std::string& file) {
  const base::RegularFile regular(file);  // libsdformat would wait for a pipe
  const std::string folder = folderOf(file);
  const sdf::Root root =
      loadSdf(file, [&](const std::string& uri) { return resourcePath(uri, folder, folder); });
  return meshesOfWorld(root, file, readMesh);
}

}  // namespace

WorldMeshes meshesOfWorld(const sdf::Root& root, const std::string& file,
                          const ReadOfMesh& read_mesh) {
  return WorldReader(file, read_mesh).read(root);
}

// Sentences of libraries and about names, files and values quote what stands in a world.
WorldMeshes readWorldMeshes(const std::string& file) {
  try {
    return readUnchecked(file);
  } catch (const InputError& error) {
    throw InputError(base::cleanedText(error.what(), kLongestSentence));
  }
}

}  // namespace grid_path_planner::simulation
