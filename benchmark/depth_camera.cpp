// What a simulated depth camera costs.
//
//   grid_path_planner_depth_camera [WORLD.sdf [FRAMES]]
//
// Renders a 320x240 camera that turns once about itself in the middle of a world, and prints the
// CPU time of a frame and the share of one core that it takes at 10 Hz.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "grid_path_planner/simulation/depth_camera.h"
#include "grid_path_planner/simulation/world.h"

namespace {

using namespace grid_path_planner::simulation;

double cpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Eigen::AlignedBox3f boundsOf(const World& world) {
  Eigen::AlignedBox3f box;
  for (const TriangleMesh& mesh : world.visible()) box.extend(mesh.bounds());
  return box;
}

std::size_t trianglesOf(const World& world) {
  std::size_t count = 0;
  for (const TriangleMesh& mesh : world.visible()) count += mesh.triangles.size();
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  const World world = readWorld(argc > 1 ? argv[1] : "worlds/dexrov_site.sdf");
  const int frames = argc > 2 ? std::atoi(argv[2]) : 200;
  DepthCameraOptions options;
  options.pitch = 0.5;
  const double before = cpuSeconds();
  const DepthCamera camera(world, options);
  std::printf("%zu triangles, prepared in %.1f ms\n", trianglesOf(world),
              1e3 * (cpuSeconds() - before));
  Eigen::Isometry3d vehicle = Eigen::Isometry3d::Identity();
  vehicle.translate(boundsOf(world).center().cast<double>());
  std::vector<float> points;
  std::size_t measured = 0;
  const double begin = cpuSeconds();
  for (int frame = 0; frame < frames; ++frame) {
    vehicle.rotate(Eigen::AngleAxisd(2.0 * M_PI / frames, Eigen::Vector3d::UnitZ()));
    camera.render(vehicle * camera.baseFromOptical(), frame, points);
    for (std::size_t i = 0; i < points.size(); i += 3) measured += points[i] == points[i];
  }
  const double frame_s = (cpuSeconds() - begin) / frames;
  std::printf(
      "%dx%d pixels, %.0f %% of them measured: %.2f ms a frame, %.1f %% of a core at %g Hz\n",
      options.width, options.height,
      300.0 * static_cast<double>(measured) / static_cast<double>(points.size()) / frames,
      1e3 * frame_s, 100.0 * frame_s * options.rate, options.rate);
  return 0;
}
