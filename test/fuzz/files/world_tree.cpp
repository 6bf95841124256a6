// What becomes of a world that libsdformat has read, without its reading, which takes half a second: one
// world, whose values are those of the input.
#include <array>
#include <utility>

#include "fuzz/files/fuzz_bytes.h"
#include "fuzz/fuzz_target.h"
#include "grid_path_planner/simulation/world.h"
#include "simulation/mesh_bytes.h"
#include "simulation/world_walk.h"

namespace grid_path_planner::fuzz {
namespace {

using simulation::TriangleMesh;

constexpr char kWorld[] =
    "<?xml version='1.0'?><sdf version='1.6'><world name='w'>"
    "<model name='a'><link name='l'>"
    "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision>"
    "<collision name='d'><geometry><plane><normal>0 0 1</normal><size>6 8</size></plane></geometry>"
    "</collision><visual name='v'><geometry><sphere><radius>3</radius></sphere></geometry></visual>"
    "</link></model><model name='b'><link name='l'>"
    "<visual "
    "name='v'><geometry><cylinder><radius>2</radius><length>4</length></cylinder></geometry>"
    "</visual></link><link name='m'><collision name='c'><geometry>"
    "<mesh><uri>fuzz_tree.obj</uri></mesh></geometry></collision>"
    "<collision name='d'><geometry><empty/></geometry></collision></link></model>"
    "</world></sdf>";

const std::string& worldFile() {
  static const std::string file = fileOf("fuzz_tree.sdf", kWorld);
  return file;
}

sdf::Root& world() {
  static sdf::Root root = [] {
    fileOf("fuzz_tree.obj", "");
    sdf::Root read;
    mustHold(read.Load(worldFile()).empty(), "the world is one");
    return read;
  }();
  return root;
}

// As change() below takes them: numbers of two bytes.
std::string numbers(int count, char value) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += std::string{'\x01', value};
  return bytes;
}

std::string shapeOf(sdf::GeometryType type) {
  constexpr char kZero = '\x80', kTwo = '\x90';
  return std::string(1, '\0') + numbers(6, kZero) + static_cast<char>(type) + numbers(11, kTwo) +
         std::string(1, '\0') + numbers(3, kTwo) + '\x01';
}

// A world of the six shapes, as its elements say or all of one kind; and any bytes.
std::vector<std::string> seedsOfWorldTrees() {
  using Type = sdf::GeometryType;
  const std::string pose = numbers(6, '\x84');
  const auto world = [&](const std::array<Type, 6>& types) {
    std::string bytes = pose + pose;
    for (int i = 0; i < 3; ++i) bytes += shapeOf(types[i]);
    bytes += pose + pose + shapeOf(types[3]) + pose + shapeOf(types[4]) + shapeOf(types[5]);
    return bytes + numbers(9, '\x98');
  };
  std::string all;
  for (int i = 0; i < 300; ++i) all += static_cast<char>(i * 37 % 251);
  return {world({Type::BOX, Type::PLANE, Type::SPHERE, Type::CYLINDER, Type::BOX, Type::EMPTY}),
          world({Type::BOX, Type::BOX, Type::BOX, Type::BOX, Type::MESH, Type::EMPTY}), all, ""};
}

ignition::math::Vector3d vectorFrom(Bytes& bytes) {
  const double x = bytes.number(), y = bytes.number(), z = bytes.number();
  return {x, y, z};
}

ignition::math::Pose3d poseFrom(Bytes& bytes) {
  const ignition::math::Vector3d position = vectorFrom(bytes), turn = vectorFrom(bytes);
  return {position, ignition::math::Quaterniond(turn)};
}

const char* uriFrom(Bytes& bytes) {
  const std::array<const char*, 5> uris = {"fuzz_tree.obj", "", "model://x", "/dev/zero", "http:"};
  return uris.at(bytes.byte() % uris.size());
}

// Of any kind, whatever the element was.
void change(sdf::Geometry& geometry, Bytes& bytes) {
  geometry.SetType(static_cast<sdf::GeometryType>(bytes.byte() % 10));
  sdf::Box box;
  box.SetSize(vectorFrom(bytes));
  geometry.SetBoxShape(box);
  sdf::Cylinder cylinder;
  cylinder.SetRadius(bytes.number());
  cylinder.SetLength(bytes.number());
  geometry.SetCylinderShape(cylinder);
  sdf::Sphere sphere;
  sphere.SetRadius(bytes.number());
  geometry.SetSphereShape(sphere);
  sdf::Plane plane;
  plane.SetNormal(vectorFrom(bytes));
  plane.SetSize({bytes.number(), bytes.number()});
  geometry.SetPlaneShape(plane);
  sdf::Mesh mesh;
  mesh.SetFilePath(worldFile());
  mesh.SetUri(uriFrom(bytes));
  mesh.SetScale(vectorFrom(bytes));
  if (bytes.byte() % 8 == 0) mesh.SetSubmesh(bytes.name());
  geometry.SetMeshShape(mesh);
}

// Older libraries let one change nothing of what they have read.
template <class Part>
Part& changeable(const Part* part) {
  return const_cast<Part&>(*part);
}

template <class Shape>
void changeShape(const Shape* given, Bytes& bytes) {
  Shape& shape = changeable(given);
  shape.SetName(bytes.name());
  shape.SetRawPose(poseFrom(bytes));
  sdf::Geometry geometry = *shape.Geom();
  change(geometry, bytes);
  shape.SetGeom(geometry);
}

void changeLink(const sdf::Link* given, Bytes& bytes) {
  sdf::Link& link = changeable(given);
  link.SetRawPose(poseFrom(bytes));
  for (std::size_t i = 0; i < link.CollisionCount(); ++i)
    changeShape(link.CollisionByIndex(i), bytes);
  for (std::size_t i = 0; i < link.VisualCount(); ++i) changeShape(link.VisualByIndex(i), bytes);
}

TriangleMesh meshFrom(Bytes& bytes) {
  TriangleMesh mesh{"mesh", {}, {{0, 1, 2}}};
  for (int i = 0; i < 3; ++i) {
    const ignition::math::Vector3d at = vectorFrom(bytes);
    mesh.vertices.emplace_back(at.X(), at.Y(), at.Z());
  }
  return mesh;
}

FUZZ_TARGET(world_tree, seedsOfWorldTrees) {
  Bytes bytes(input);
  const sdf::World& tree = *world().WorldByIndex(0);
  for (std::size_t i = 0; i < tree.ModelCount(); ++i) {
    sdf::Model& model = changeable(tree.ModelByIndex(i));
    model.SetRawPose(poseFrom(bytes));
    for (std::size_t k = 0; k < model.LinkCount(); ++k) changeLink(model.LinkByIndex(k), bytes);
  }
  mayRefuse([&] {
    simulation::WorldMeshes meshes =
        simulation::worldMeshesFrom(simulation::bytesOf(simulation::meshesOfWorld(
            world(), worldFile(), [&](const std::string&) { return meshFrom(bytes); })));
    simulation::World(std::move(meshes.solid), std::move(meshes.visible))
        .nearest({0.1, 0.2, 0.3}, 10.0);
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
