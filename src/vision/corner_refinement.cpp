#include "vision/corner_refinement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace grid_path_planner::vision {
namespace {

using Eigen::Vector2d;

constexpr int kCellsAcross = 8;  // of a tag, its black border included

// Half of a profile, in pixels: what is left of the tag's cell, within limits.
struct Reach {
  double beside;  // of a cell: to where the edge of the neighbouring one is seen
  double shortest, longest;
};
// The first finds the side from where OpenCV has it. The second is no longer than what a pixel blurs: a longer one sees
// the next cells of a tag that is seen from aside, and blotches beside the edge, which err alike in each image.
constexpr Reach kWide{1.5, 1.5, 5.0}, kNarrow{0.75, 1.0, 1.25};

constexpr double kSampleStep = 0.25;  // pixels along a profile
constexpr double kFirst =
    0.06;  // of a side, where the first profile is; the last one symmetrically
constexpr double kLeastContrast = 5.0;  // of 255
constexpr double kFarthestMove = 3.0;   // pixels, of a corner by the refinement
constexpr int kWideRounds = 3, kRounds = 15;
constexpr double kSettled = 0.002;  // pixels, of all corners in a round: no further rounds
constexpr int kTrims = 5;
constexpr double kNear = 0.1;         // pixels from a line: never too far
constexpr double kFarFromMost = 4.0;  // times the median distance: too far

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

double distance(const Vector2d& point, const Line& line) {
  const Vector2d d = point - line.point;
  return std::abs(d.x() * line.direction.y() - d.y() * line.direction.x());
}

// Without the points that lie farther from it than most: where something hides a part of the side.
std::optional<Line> lineThroughMost(std::vector<Vector2d> points, std::size_t fewest) {
  for (int round = 0; round < kTrims && points.size() >= fewest; ++round) {
    const Line line = lineThrough(points);
    std::vector<double> distances;
    for (const Vector2d& point : points) distances.push_back(distance(point, line));
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    const double limit = std::max(kNear, kFarFromMost * *middle);
    const auto last = std::remove_if(points.begin(), points.end(), [&](const Vector2d& point) {
      return distance(point, line) > limit;
    });
    if (last == points.end()) return line;
    points.erase(last, points.end());
  }
  if (points.size() < fewest) return std::nullopt;
  return lineThrough(points);
}

// The side from corner i to the next one, whose outside is to the left of it in an image.
std::optional<Line> sideOf(const GreyImage& image, const PixelCorners& corners, int i,
                           const Reach& limits) {
  const Vector2d &a = corners[i], &b = corners[(i + 1) % 4];
  const double length = (b - a).norm();
  if (!(length > kCellsAcross)) return std::nullopt;
  const Vector2d along = (b - a) / length, outwards(along.y(), -along.x());
  // Seen from aside, cells are narrower across the side than along it.
  const double depth = std::min(std::abs(outwards.dot(corners[(i + 3) % 4] - a)),
                                std::abs(outwards.dot(corners[(i + 2) % 4] - b)));
  const double reach =
      std::clamp(depth / kCellsAcross - limits.beside, limits.shortest, limits.longest);
  const int profiles = std::max(8, static_cast<int>(length));
  std::vector<Vector2d> points;
  for (int i = 0; i < profiles; ++i) {
    const double share = kFirst + (1.0 - 2.0 * kFirst) * i / (profiles - 1);
    const Vector2d centre = a + share * (b - a);
    if (const auto edge = edgeAlong(image, centre, outwards, reach))
      points.push_back(centre + *edge * outwards);
  }
  return lineThroughMost(std::move(points), static_cast<std::size_t>(profiles / 2));
}

std::optional<Vector2d> intersection(const Line& a, const Line& b) {
  const auto cross = [](const Vector2d& u, const Vector2d& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const double sine = cross(a.direction, b.direction);
  if (std::abs(sine) < 0.05) return std::nullopt;
  return a.point + a.direction * (cross(b.point - a.point, b.direction) / sine);
}

std::optional<PixelCorners> onceRefined(const GreyImage& image, const PixelCorners& corners,
                                        const Reach& limits) {
  std::array<std::optional<Line>, 4> sides;
  for (int i = 0; i < 4; ++i) sides[i] = sideOf(image, corners, i, limits);
  PixelCorners result;
  for (int i = 0; i < 4; ++i) {
    const auto &before = sides[(i + 3) % 4], &after = sides[i];
    const auto corner = before && after ? intersection(*before, *after) : std::nullopt;
    if (!corner) return std::nullopt;
    result[i] = *corner;
  }
  return result;
}

double farthestMove(const PixelCorners& from, const PixelCorners& to) {
  double farthest = 0.0;
  for (int i = 0; i < 4; ++i) farthest = std::max(farthest, (from[i] - to[i]).norm());
  return farthest;
}

}  // namespace

std::optional<PixelCorners> refinedCorners(const GreyImage& image, const PixelCorners& corners) {
  PixelCorners result = corners;
  for (int round = 0; round < kRounds; ++round) {
    const auto next = onceRefined(image, result, round < kWideRounds ? kWide : kNarrow);
    if (!next || farthestMove(corners, *next) > kFarthestMove) return std::nullopt;
    const bool settled = round > kWideRounds && farthestMove(result, *next) < kSettled;
    result = *next;
    if (settled) break;
  }
  return result;
}

}  // namespace grid_path_planner::vision
