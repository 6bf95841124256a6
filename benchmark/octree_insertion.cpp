// How much faster OctreeMap takes a scan than octomap::OcTree::insertPointCloud with its defaults.
//
//   grid_path_planner_octree_insertion [--world FILE.sdf] [--height Z] [--graph FILE.graph]
//                                      [--repetitions N]
//
// Depth frames of 320x240 along a path through a coded scene, and through a world given as SDF at
// a height in it, at 0.05 m; and the scans of an OctoMap scan graph (its spherical_scan.graph, say)
// at 0.05 and 0.1 m. Both get scan after scan in turn, in one thread; the CPU time is until the
// octree is up to date, of ours also the bricks. After every scan the trees are compared node by
// node: key, depth and the bits of the log odds. Prints the medians of the repetitions; exits with
// 1 if a tree differs. "lazy" is insertPointCloud with lazy_eval and one updateInnerOccupancy after
// the last scan: a tree that is right only then, and is not pruned.
//
// What lost, in the time of a depth frame on the machine where this was made: 16^3 tiles of marks
// instead of one window, with guard bits for their borders (1.6 times the window's); GCC's vector
// `mask ? a : b`, which becomes branches (1.4). AVX2 would save another 5 to 10 %. A camera that is
// held before a wall, with rays of 0.7 m, gains least: there the time is each ray's beginning.
#include <octomap/OcTree.h>
#include <octomap/ScanGraph.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "grid_path_planner/mapping/octree_map.h"
#include "grid_path_planner/simulation/depth_camera.h"
#include "grid_path_planner/simulation/world.h"

namespace {

using namespace grid_path_planner::mapping;
using namespace grid_path_planner::simulation;

struct Series {
  std::string name;
  double resolution;  // m
  std::vector<Scan> scans;
};

TriangleMesh placed(const TriangleMesh& mesh, double x, double y, double z, double yaw) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(x, y, z));
  pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  return mesh.moved(pose);
}

// Ground with rocks, posts and walls on it, 24 x 24 m.
World codedWorld() {
  std::vector<TriangleMesh> meshes = {
      placed(planeMesh("ground", Eigen::Vector3d(0.05, 0.03, 1.0), {24.0, 24.0}), 0, 0, 0, 0)};
  for (int i = 0; i < 60; ++i) {
    const double x = 11.0 * std::sin(2.4 * i), y = 11.0 * std::cos(3.7 * i), turn = i;
    const std::string name = "thing" + std::to_string(i);
    if (i % 3 == 0) meshes.push_back(placed(sphereMesh(name, 0.3 + 0.01 * i), x, y, 0.0, 0.0));
    if (i % 3 == 1) meshes.push_back(placed(cylinderMesh(name, 0.15, 4.0), x, y, 1.0, 0.0));
    if (i % 3 == 2) meshes.push_back(placed(boxMesh(name, {2.0, 0.3, 2.0}), x, y, 0.5, turn));
  }
  return World(std::move(meshes));
}

// What a vehicle sees that drives round the middle of the world, 5 cm and a little turn a frame.
std::vector<Scan> depthFrames(const World& world, double height, int count) {
  Eigen::AlignedBox3f box;
  for (const TriangleMesh& mesh : world.visible()) box.extend(mesh.bounds());
  DepthCameraOptions options;
  options.pitch = 0.35;
  const DepthCamera camera(world, options);
  std::vector<Scan> scans;
  std::vector<float> points;
  for (int frame = 0; frame < count; ++frame) {
    const double angle = 0.0125 * frame, radius = 4.0;
    Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
    base.translate(Eigen::Vector3d(box.center().x() + radius * std::cos(angle),
                                   box.center().y() + radius * std::sin(angle), height));
    base.rotate(Eigen::AngleAxisd(angle + M_PI / 2.0, Eigen::Vector3d::UnitZ()));
    const Eigen::Isometry3d optical = base * camera.baseFromOptical();
    camera.render(optical, static_cast<std::uint64_t>(frame), points);
    const auto point = [](const Eigen::Vector3f& p) {
      return octomap::point3d(p.x(), p.y(), p.z());
    };
    Scan scan;
    scan.origin = point(optical.translation().cast<float>());
    for (std::size_t i = 0; i < points.size(); i += 3) {
      const Eigen::Vector3d seen(points[i], points[i + 1], points[i + 2]);
      if (seen.allFinite()) scan.hits.push_back(point((optical * seen).cast<float>()));
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

std::vector<Scan> graphScans(const std::string& file) {
  octomap::ScanGraph graph;
  if (!graph.readBinary(file)) std::exit(2);
  std::vector<Scan> scans;
  for (const octomap::ScanNode* node : graph) {
    octomap::Pointcloud cloud(*node->scan);
    cloud.transform(node->pose);
    scans.push_back({node->pose.trans(), {cloud.begin(), cloud.end()}, {}});
  }
  return scans;
}

bool sameTrees(const octomap::OcTree& a, const octomap::OcTree& b) {
  if (a.size() != b.size() || a.calcNumNodes() != a.size()) return false;
  auto other = b.begin_tree();
  for (auto node = a.begin_tree(); node != a.end_tree(); ++node, ++other) {
    const float value = node->getLogOdds(), expected = other->getLogOdds();
    if (node.getKey() != other.getKey() || node.getDepth() != other.getDepth() ||
        std::memcmp(&value, &expected, sizeof value) != 0)
      return false;
  }
  return true;
}

// CPU time: others may be at work on the machine.
template <class Action>
double seconds(const Action& action) {
  const std::clock_t begin = std::clock();
  action();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

struct Times {
  double theirs = 0.0, lazy = 0.0, ours = 0.0;  // s a scan
  double ratio() const { return theirs / ours; }
};

void setClamping(octomap::OcTree& tree, const OctreeOptions& options) {
  tree.setClampingThresMin(options.min);
  tree.setClampingThresMax(options.max);
}

octomap::Pointcloud cloudOf(const Scan& scan) {
  octomap::Pointcloud cloud;
  for (const octomap::point3d& point : scan.hits) cloud.push_back(point);
  return cloud;
}

double lazySeconds(const Series& series, const OctreeOptions& options) {
  octomap::OcTree tree(series.resolution);
  setClamping(tree, options);
  double sum = 0.0;
  for (const Scan& scan : series.scans) {
    const octomap::Pointcloud cloud = cloudOf(scan);
    sum += seconds([&] { tree.insertPointCloud(cloud, scan.origin, -1.0, true); });
  }
  return sum + seconds([&] { tree.updateInnerOccupancy(); });
}

// Takes the series once into fresh trees; false where they differ.
bool measure(const Series& series, Times& times) {
  OctreeOptions options;
  options.resolution = series.resolution;
  OctreeMap ours(options);
  octomap::OcTree theirs(series.resolution);
  setClamping(theirs, options);
  for (const Scan& scan : series.scans) {
    const octomap::Pointcloud cloud = cloudOf(scan);
    const auto take_theirs = [&] { theirs.insertPointCloud(cloud, scan.origin); };
    const auto take_ours = [&] { ours.insert(scan); };
    const bool ours_first =
        (&scan - series.scans.data()) % 2 == 1;  // who is second finds warmer caches
    if (ours_first) times.ours += seconds(take_ours);
    times.theirs += seconds(take_theirs);
    if (!ours_first) times.ours += seconds(take_ours);
    if (!sameTrees(ours.tree(), theirs)) return false;
  }
  const auto count = static_cast<double>(series.scans.size());
  times = {times.theirs / count, lazySeconds(series, options) / count, times.ours / count};
  return true;
}

bool report(const Series& series, int repetitions) {
  std::vector<Times> runs;
  for (int i = 0; i < repetitions; ++i) {
    runs.emplace_back();
    if (measure(series, runs.back())) continue;
    std::printf("%s at %.2f m: THE TREES DIFFER\n", series.name.c_str(), series.resolution);
    return false;
  }
  std::sort(runs.begin(), runs.end(),
            [](const Times& a, const Times& b) { return a.ratio() < b.ratio(); });
  std::size_t points = 0;
  for (const Scan& scan : series.scans) points += scan.hits.size();
  const Times& median = runs[runs.size() / 2];
  std::printf("%-16s %5.2f %6zu %9zu %12.2f %10.2f %10.2f %7.1f %6.1f-%.1f %10.1f\n",
              series.name.c_str(), series.resolution, series.scans.size(),
              points / series.scans.size(), 1e3 * median.theirs, 1e3 * median.lazy,
              1e3 * median.ours, median.ratio(), runs.front().ratio(), runs.back().ratio(),
              median.lazy / median.ours);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  std::string world, graph;
  int repetitions = 5;
  double height = 4.2;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--world")) world = argv[i + 1];
    if (!std::strcmp(argv[i], "--height")) height = std::atof(argv[i + 1]);
    if (!std::strcmp(argv[i], "--graph")) graph = argv[i + 1];
    if (!std::strcmp(argv[i], "--repetitions")) repetitions = std::atoi(argv[i + 1]);
  }
  std::vector<Series> all = {{"depth frames", 0.05, depthFrames(codedWorld(), 2.5, 40)}};
  if (!world.empty())
    all.push_back({"world's frames", 0.05, depthFrames(readWorld(world), height, 40)});
  if (!graph.empty())
    for (const double resolution : {0.05, 0.1})
      all.push_back({"scan graph", resolution, graphScans(graph)});
  std::printf("%-16s %5s %6s %9s %12s %10s %10s %7s %10s %10s\n", "scans", "m", "number", "points",
              "octomap ms", "lazy ms", "ours ms", "ratio", "least-most", "lazy/ours");
  bool same = true;
  for (const Series& series : all) same &= report(series, repetitions);
  return same ? 0 : 1;
}
