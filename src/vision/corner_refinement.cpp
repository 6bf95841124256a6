#include "vision/corner_refinement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace grid_path_planner::vision {
namespace {

using Eigen::Vector2d;

constexpr int kCellsAcross = 8;         // of a tag, its black border included
constexpr double kBlur = 1.5;           // pixels, to where a neighbouring cell's edge is seen
constexpr double kShortestReach = 1.5;  // pixels, half a profile
constexpr double kLongestReach = 5.0;
constexpr double kSampleStep = 0.25;  // pixels along a profile
constexpr double kFirst =
    0.06;  // of a side, where the first profile is; the last one symmetrically
constexpr double kLeastContrast = 5.0;  // of 255
constexpr double kFarthestMove = 3.0;   // pixels, of a corner by the refinement
constexpr int kRounds = 4;

struct Line {
  Vector2d point;
  Vector2d direction;  // of length 1
};

// Bilinear; none outside the image.
std::optional<double> brightnessAt(const GreyImage& image, const Vector2d& at) {
  const int column = static_cast<int>(std::floor(at.x())),
            row = static_cast<int>(std::floor(at.y()));
  if (column < 0 || row < 0 || column + 1 >= image.width || row + 1 >= image.height)
    return std::nullopt;
  const double x = at.x() - column, y = at.y() - row;
  return (1.0 - y) * ((1.0 - x) * image.at(column, row) + x * image.at(column + 1, row)) +
         y * ((1.0 - x) * image.at(column, row + 1) + x * image.at(column + 1, row + 1));
}

// Where along `normal` from `centre` dark becomes bright: the mean of the positions, weighted with the slope.
std::optional<double> edgeAlong(const GreyImage& image, const Vector2d& centre,
                                const Vector2d& normal, double reach) {
  double weights = 0.0, sum = 0.0;
  std::optional<double> before;
  for (double s = -reach; s <= reach; s += kSampleStep) {
    const std::optional<double> here = brightnessAt(image, centre + s * normal);
    if (!here) return std::nullopt;
    if (before) {
      weights += *here - *before;
      sum += (*here - *before) * (s - 0.5 * kSampleStep);
    }
    before = here;
  }
  if (weights < kLeastContrast || std::abs(sum) > reach * weights) return std::nullopt;
  return sum / weights;
}

// The line with the least sum of squared distances to the points.
Line lineThrough(const std::vector<Vector2d>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& point : points) mean += point / static_cast<double>(points.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Vector2d& point : points) {
    const Vector2d d = point - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  return {mean, {std::cos(angle), std::sin(angle)}};
}

// The side from `a` to `b`, whose outside is to the left of it in an image.
std::optional<Line> sideBetween(const GreyImage& image, const Vector2d& a, const Vector2d& b) {
  const double length = (b - a).norm();
  if (!(length > kCellsAcross)) return std::nullopt;
  const Vector2d along = (b - a) / length, outwards(along.y(), -along.x());
  const double reach = std::clamp(length / kCellsAcross - kBlur, kShortestReach, kLongestReach);
  const int profiles = std::max(8, static_cast<int>(length));
  std::vector<Vector2d> points;
  for (int i = 0; i < profiles; ++i) {
    const double share = kFirst + (1.0 - 2.0 * kFirst) * i / (profiles - 1);
    const Vector2d centre = a + share * (b - a);
    if (const auto edge = edgeAlong(image, centre, outwards, reach))
      points.push_back(centre + *edge * outwards);
  }
  if (2 * static_cast<int>(points.size()) < profiles) return std::nullopt;
  return lineThrough(points);
}

std::optional<Vector2d> intersection(const Line& a, const Line& b) {
  const auto cross = [](const Vector2d& u, const Vector2d& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const double sine = cross(a.direction, b.direction);
  if (std::abs(sine) < 0.05) return std::nullopt;
  return a.point + a.direction * (cross(b.point - a.point, b.direction) / sine);
}

std::optional<PixelCorners> onceRefined(const GreyImage& image, const PixelCorners& corners) {
  std::array<std::optional<Line>, 4> sides;
  for (int i = 0; i < 4; ++i) sides[i] = sideBetween(image, corners[i], corners[(i + 1) % 4]);
  PixelCorners result;
  for (int i = 0; i < 4; ++i) {
    const auto &before = sides[(i + 3) % 4], &after = sides[i];
    const auto corner = before && after ? intersection(*before, *after) : std::nullopt;
    if (!corner) return std::nullopt;
    result[i] = *corner;
  }
  return result;
}

}  // namespace

PixelCorners refinedCorners(const GreyImage& image, const PixelCorners& corners) {
  PixelCorners result = corners;
  for (int round = 0; round < kRounds; ++round) {
    const auto next = onceRefined(image, result);
    if (!next) return corners;
    for (int i = 0; i < 4; ++i)
      if ((corners[i] - (*next)[i]).norm() > kFarthestMove) return corners;
    result = *next;
  }
  return result;
}

}  // namespace grid_path_planner::vision
