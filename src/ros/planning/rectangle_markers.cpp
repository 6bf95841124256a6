#include "ros/planning/rectangle_markers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grid_path_planner::nodes {

using grid::CellRect;
using grid::GridGeometry;

namespace {

using visualization_msgs::Marker;

constexpr double kGoldenPart = 0.6180339887498949;  // spreads hues evenly however many there are
constexpr double kLineWidth = 0.12;                 // cells
constexpr double kGap = 0.5 * kLineWidth;           // cells between an outline and its neighbour's
// Under what is at height 0, such as a path.
constexpr double kFillHeight = -0.06;     // cells
constexpr double kOutlineHeight = -0.04;  // cells
constexpr double kNumberHeight = -0.02;   // cells
constexpr float kFillOpacity = 0.45F;
constexpr double kLargestDigits = 0.6;  // of a rectangle's height; digits are 0.6 as wide as high

std_msgs::ColorRGBA colour(std::size_t number, float brightness, float opacity) {
  const double hue = 6.0 * std::fmod(static_cast<double>(number) * kGoldenPart, 1.0);
  const auto channel = [&](double at) {  // 1 near its own hue, 0 on the other half of the circle
    const double away = std::abs(std::remainder(hue - at, 6.0));
    return brightness * static_cast<float>(0.35 + 0.65 * std::clamp(2.0 - away, 0.0, 1.0));
  };
  std_msgs::ColorRGBA colour;
  colour.r = channel(0.0);
  colour.g = channel(2.0);
  colour.b = channel(4.0);
  colour.a = opacity;
  return colour;
}

class MarkerMaker {
 public:
  MarkerMaker(const GridGeometry& geometry, const std::string& frame_id, const ros::Time& stamp)
      : geometry_(geometry), frame_id_(frame_id), stamp_(stamp) {}

  // `height` in cells.
  Marker marker(const char* name, int type, double height) const {
    Marker marker;
    marker.header.frame_id = frame_id_;
    marker.header.stamp = stamp_;
    marker.ns = name;
    marker.type = type;
    marker.pose.position.z = metres(height);
    marker.pose.orientation.w = 1.0;
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
    marker.color.a = 1.0F;
    return marker;
  }

  // The corners of a rectangle made smaller by `inset` cells, anticlockwise.
  std::array<geometry_msgs::Point, 4> corners(const CellRect& rect, double inset) const {
    const double left = rect.column + inset, right = rect.column + rect.width - inset;
    const double bottom = rect.row + inset, top = rect.row + rect.height - inset;
    return {point({left, bottom}), point({right, bottom}), point({right, top}), point({left, top})};
  }
  geometry_msgs::Point point(const Eigen::Vector2d& cells, double height = 0.0) const {
    const Eigen::Vector2d world = geometry_.worldFromGrid(cells);
    geometry_msgs::Point point;
    point.x = world.x();
    point.y = world.y();
    point.z = metres(height);
    return point;
  }

  double metres(double cells) const { return cells * geometry_.resolution(); }

 private:
  const GridGeometry& geometry_;
  const std::string& frame_id_;
  const ros::Time& stamp_;
};

// Points that all have the same colour.
template <class Corners, std::size_t count>
void add(const Corners& corners, const std::array<std::size_t, count>& order,
         const std_msgs::ColorRGBA& colour, Marker& marker) {
  for (const std::size_t corner : order) marker.points.push_back(corners[corner]);
  marker.colors.insert(marker.colors.end(), count, colour);
}

// As large as the rectangle allows.
Marker numberOf(const MarkerMaker& maker, const CellRect& rect, std::size_t number) {
  Marker marker = maker.marker("numbers", Marker::TEXT_VIEW_FACING, kNumberHeight);
  marker.id = static_cast<std::int32_t>(number);
  marker.text = std::to_string(number + 1);  // as in pictures, and as published
  marker.pose.position =
      maker.point({rect.column + 0.5 * rect.width, rect.row + 0.5 * rect.height}, kNumberHeight);
  const double by_width = rect.width / (kLargestDigits * static_cast<double>(marker.text.size()));
  marker.scale.z = maker.metres(kLargestDigits * std::min<double>(rect.height, by_width));
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray rectangleMarkers(const GridGeometry& geometry,
                                                 const std::vector<CellRect>& rectangles,
                                                 const std::string& frame_id,
                                                 const ros::Time& stamp) {
  const MarkerMaker maker(geometry, frame_id, stamp);
  Marker before = maker.marker("", Marker::CUBE, 0.0);
  before.action = Marker::DELETEALL;
  Marker fills = maker.marker("rectangles", Marker::TRIANGLE_LIST, kFillHeight);
  Marker outlines = maker.marker("outlines", Marker::LINE_LIST, kOutlineHeight);
  outlines.scale.x = maker.metres(kLineWidth);
  visualization_msgs::MarkerArray numbers;
  const std::size_t shown = std::min(rectangles.size(), kMostShownRectangles);
  for (std::size_t i = 0; i < shown; ++i) {
    if (rectangles[i].empty()) continue;
    const auto corners = maker.corners(rectangles[i], kGap);
    add(corners, std::array<std::size_t, 6>{0, 1, 2, 0, 2, 3}, colour(i, 1.0F, kFillOpacity),
        fills);
    add(corners, std::array<std::size_t, 8>{0, 1, 1, 2, 2, 3, 3, 0}, colour(i, 0.55F, 1.0F),
        outlines);
    if (i < kMostNumberedRectangles) numbers.markers.push_back(numberOf(maker, rectangles[i], i));
  }
  visualization_msgs::MarkerArray array;
  array.markers.push_back(std::move(before));
  if (fills.points.empty()) return array;  // rviz complains of lists without points
  array.markers.push_back(std::move(fills));
  array.markers.push_back(std::move(outlines));
  array.markers.insert(array.markers.end(), numbers.markers.begin(), numbers.markers.end());
  return array;
}

}  // namespace grid_path_planner::nodes
