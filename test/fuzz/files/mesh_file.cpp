#include "simulation/mesh_file.h"

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

// The first byte says which ending the file has.
std::vector<std::string> seedsOfMeshes() {
  return {
      "ov 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n",
      "ssolid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid a\n",
      "d<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"><library_geometries><geometry id=\"g\">"
      "<mesh><source id=\"p\"><float_array id=\"a\" count=\"9\">0 0 0 1 0 0 0 1 0</float_array>"
      "<technique_common><accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" "
      "type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>"
      "</accessor></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
      "source=\"#p\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" "
      "source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
      "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node>"
      "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
      "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>"};
}

// assimp 5.2 ends its process where an array has no count. Worlds are read in a child, whose end is a sentence
// (WorldBombs); here it would end the search for others.
bool hasUncountedArray(const std::string& text) {
  const std::string tag = "<float_array";
  for (std::size_t at = text.find(tag); at != std::string::npos; at = text.find(tag, at + 1))
    if (text.substr(at, text.find('>', at) - at).find(" count=") == std::string::npos) return true;
  return false;
}

FUZZ_TARGET(mesh_file, seedsOfMeshes) {
  if (input.empty() || (input[0] == 'd' && hasUncountedArray(input))) return;
  const char* name = input[0] == 'd' ? "fuzz.dae" : input[0] == 's' ? "fuzz.stl" : "fuzz.obj";
  mayRefuse([&] { simulation::readMesh(fileOf(name, input.substr(1))); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
