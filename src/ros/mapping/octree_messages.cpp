#include "ros/mapping/octree_messages.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace grid_path_planner::nodes {

using mapping::VoxelColors;

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

enum class Kind { FREE, OCCUPIED };

// Calls visit(centre, depth, size) for every leaf of the kind.
template <class Visit>
void forEachLeaf(const octomap::OcTree& tree, Kind kind, const HeightRange& heights, Visit visit) {
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (tree.isNodeOccupied(*leaf) != (kind == Kind::OCCUPIED)) continue;
    const double half = leaf.getSize() / 2.0;
    if (leaf.getZ() + half <= heights.min_z || leaf.getZ() - half >= heights.max_z) continue;
    visit(leaf.getCoordinate(), leaf.getDepth(), leaf.getSize());
  }
}

std_msgs::ColorRGBA color(double r, double g, double b, double a) {
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(r);
  color.g = static_cast<float>(g);
  color.b = static_cast<float>(b);
  color.a = static_cast<float>(a);
  return color;
}

// `hue` from 0 to 1: red, yellow, green, cyan, blue, magenta and back to red.
std_msgs::ColorRGBA rainbow(double hue) {
  const auto part = [hue](double middle) {
    const double away = std::abs(std::remainder(hue - middle, 1.0));
    return std::clamp(2.0 - 6.0 * away, 0.0, 1.0);
  };
  return color(part(0.0), part(1.0 / 3.0), part(2.0 / 3.0), 1.0);
}

geometry_msgs::Point pointOf(const octomap::point3d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = p.z();
  return point;
}

// A marker for each depth of the tree, filled by add().
class CubeLists {
 public:
  void add(const octomap::point3d& centre, unsigned depth, double size) {
    Marker& marker = markers_.at(depth);
    marker.scale.x = marker.scale.y = marker.scale.z = size;
    marker.points.push_back(pointOf(centre));
  }
  void addColored(const octomap::point3d& centre, unsigned depth, double size,
                  const std_msgs::ColorRGBA& color) {
    add(centre, depth, size);
    markers_.at(depth).colors.push_back(color);
  }

  MarkerArray array(const std_msgs::ColorRGBA& color) {
    MarkerArray array;
    for (Marker& marker : markers_) {
      marker.ns = "map";
      marker.id = static_cast<int>(array.markers.size());
      marker.type = Marker::CUBE_LIST;
      marker.action = marker.points.empty() ? Marker::DELETE : Marker::ADD;
      marker.pose.orientation.w = 1.0;
      marker.color = color;
      array.markers.push_back(std::move(marker));
    }
    return array;
  }

 private:
  std::array<Marker, 17> markers_;
};

}  // namespace

MarkerArray occupiedMarkers(const octomap::OcTree& tree, const HeightRange& heights,
                            const VoxelColors& colors) {
  double x, y, lowest, highest;
  tree.getMetricMin(x, y, lowest);
  tree.getMetricMax(x, y, highest);
  CubeLists cubes;
  forEachLeaf(
      tree, Kind::OCCUPIED, heights,
      [&](const octomap::point3d& centre, unsigned depth, double size) {
        if (!colors.height_map) return cubes.add(centre, depth, size);
        const double height = std::clamp((centre.z() - lowest) / (highest - lowest), 0.0, 1.0);
        cubes.addColored(centre, depth, size, rainbow((1.0 - height) * colors.color_factor));
      });
  return cubes.array(color(colors.r, colors.g, colors.b, colors.a));
}

MarkerArray freeMarkers(const octomap::OcTree& tree, const HeightRange& heights,
                        const VoxelColors& colors) {
  CubeLists cubes;
  forEachLeaf(tree, Kind::FREE, heights,
              [&](const octomap::point3d& centre, unsigned depth, double size) {
                cubes.add(centre, depth, size);
              });
  return cubes.array(color(colors.free_r, colors.free_g, colors.free_b, colors.free_a));
}

sensor_msgs::PointCloud2 occupiedCentres(const octomap::OcTree& tree, const HeightRange& heights) {
  std::vector<octomap::point3d> centres;
  forEachLeaf(tree, Kind::OCCUPIED, heights,
              [&](const octomap::point3d& centre, unsigned, double) { centres.push_back(centre); });
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(centres.size());
  if (centres.empty()) return cloud;  // an iterator asks for the first byte
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
  for (const octomap::point3d& centre : centres) {
    x[0] = centre.x();
    x[1] = centre.y();
    x[2] = centre.z();
    ++x;
  }
  return cloud;
}

}  // namespace grid_path_planner::nodes
