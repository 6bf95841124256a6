#include "avoidance/memory/frame_sight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "avoidance/memory/ray_voxels.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kHalfDiagonal = 0.5 * kVoxel * 1.7320508075688772;
constexpr double kBesideCentre = 0.06;     // m from a voxel's centre
constexpr double kPinholeTolerance = 1.5;  // pixels
constexpr double kLargestPinhole = 1e6;    // pixels
constexpr double kPixelsOfVoxel = 3.0;
constexpr float kAgrees = 0.3F;  // m
constexpr int kPinholeSamples = 200;

Vector3f pointOf(const Frame& frame, std::size_t pixel) {
  return Vector3f(&frame.points[3 * pixel]);
}

// A near point that none of the pixels around agrees with: a voxel there fills many pixels, so that
// anything real shows in two of them.
bool isAlone(const Frame& frame, std::size_t pixel) {
  const float depth = frame.points[3 * pixel + 2];
  if (frame.pinhole->fx * kVoxel < kPixelsOfVoxel * depth) return false;
  const int column = static_cast<int>(pixel) % frame.width;
  const int row = static_cast<int>(pixel) / frame.width;
  for (int r = std::max(0, row - 1); r <= std::min(frame.height - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(frame.width - 1, column + 1); ++c) {
      const std::size_t other = static_cast<std::size_t>(r) * frame.width + c;
      if (other != pixel && std::abs(frame.points[3 * other + 2] - depth) < kAgrees) return false;
    }
  return true;
}

// Of a coordinate above -1.5; std::lround is a call and took a sixteenth of a frame's time.
int nearestPixel(double coordinate) {
  return static_cast<int>(coordinate + 1.5) - 1;
}

// A plane through the origin of the sensor, by its normal inwards.
using Planes = std::array<Vector3d, 4>;

Planes sidesOf(const Frame& frame) {
  const Pinhole& p = *frame.pinhole;
  const double left = (-0.5 - p.cx) / p.fx, right = (frame.width - 0.5 - p.cx) / p.fx;
  const double top = (-0.5 - p.cy) / p.fy, bottom = (frame.height - 0.5 - p.cy) / p.fy;
  return {Vector3d(1.0, 0.0, -left), Vector3d(-1.0, 0.0, right), Vector3d(0.0, 1.0, -top),
          Vector3d(0.0, -1.0, bottom)};
}

// The part of 0 .. count - 1 in which offset + i * slope >= 0.
void clip(double offset, double slope, double& low, double& high) {
  if (std::abs(slope) < 1e-12) {
    if (offset < 0.0) high = -1.0;  // none
    return;
  }
  const double root = -offset / slope;
  if (slope > 0.0)
    low = std::max(low, root);
  else
    high = std::min(high, root);
}

}  // namespace

void FrameSight::see(const Frame& frame, const PilotOptions& options, const HeightBand& band,
                     VoxelMemory& memory) {
  hits(frame, options, band, memory);
  const bool picture = frame.organised() && frame.pinhole.has_value();
  pinhole_disagrees_ = picture && !pinholeFits(frame);
  if (picture && !pinhole_disagrees_) {
    fillDepths(frame, options);
    crossPicture(frame, options, memory);
  } else {
    crossRays(frame, options, memory);
  }
}

// Of some points all over the picture, nine in ten must be seen where they are.
bool FrameSight::pinholeFits(const Frame& frame) const {
  const Pinhole& p = *frame.pinhole;
  if (!(p.fx > 0.0 && p.fy > 0.0)) return false;
  for (const double pixels : {p.fx, p.fy, p.cx, p.cy})
    if (!(std::abs(pixels) < kLargestPinhole)) return false;
  const std::size_t step = std::max<std::size_t>(1, frame.pixels() / kPinholeSamples);
  int points = 0, fitting = 0;
  for (std::size_t pixel = 0; pixel < frame.pixels(); pixel += step) {
    const Vector3f point = pointOf(frame, pixel);
    if (!point.allFinite() || point.z() <= 0.05f) continue;
    const double column = p.cx + p.fx * point.x() / point.z();
    const double row = p.cy + p.fy * point.y() / point.z();
    ++points;
    fitting += std::abs(column - static_cast<double>(pixel % frame.width)) < kPinholeTolerance &&
               std::abs(row - static_cast<double>(pixel / frame.width)) < kPinholeTolerance;
  }
  return fitting * 10 >= points * 9;
}

void FrameSight::hits(const Frame& frame, const PilotOptions& options, const HeightBand& band,
                      VoxelMemory& memory) {
  const bool picture = frame.organised() && frame.pinhole.has_value();
  const auto nearest = static_cast<float>(options.range_min * options.range_min);
  const auto farthest = static_cast<float>(options.range_max * options.range_max);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel) {
    const Vector3f point = pointOf(frame, pixel);
    const float range = point.squaredNorm();
    if (!(range >= nearest && range <= farthest)) continue;
    if (picture && isAlone(frame, pixel)) continue;
    const Vector3d in_map = frame.map_from_sensor * point.cast<double>();
    if (in_map.z() >= band.low && in_map.z() <= band.high) memory.hit(in_map);
  }
}

void FrameSight::fillDepths(const Frame& frame, const PilotOptions& options) {
  depths_.assign(frame.pixels(), 0.0f);
  const auto nearest = static_cast<float>(options.range_min);
  const auto farthest = static_cast<float>(options.range_max);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel) {
    const Vector3f point = pointOf(frame, pixel);
    const float range = point.norm();
    if (std::isfinite(range) && range >= nearest)
      depths_[pixel] = point.z() * std::min(1.0f, farthest / range);
  }
  ranges_.assign(frame.pixels(), 0.0f);
  if (options.no_return_clears > 0.0)
    fillNoReturns(frame, std::min(options.no_return_clears, options.range_max));
}

// A pixel clears without return where its 3 x 3 all hold nothing; outside the picture is nothing.
void FrameSight::fillNoReturns(const Frame& frame, double clears) {
  const int width = frame.width, height = frame.height;
  const auto measured = [&](int row, int column) {
    return column >= 0 && column < width &&
           std::isfinite(frame.points[3 * (static_cast<std::size_t>(row) * width + column)]);
  };
  found_.assign(frame.pixels(), 0);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      found_[static_cast<std::size_t>(row) * width + column] =
          measured(row, column - 1) || measured(row, column) || measured(row, column + 1);
  const auto found = [&](int row, int column) {
    return row >= 0 && row < height && found_[static_cast<std::size_t>(row) * width + column] != 0;
  };
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      if (!found(row - 1, column) && !found(row, column) && !found(row + 1, column))
        ranges_[static_cast<std::size_t>(row) * width + column] = static_cast<float>(clears);
}

// Row by row along x, of each only the voxels whose centres are inside the picture.
void FrameSight::crossPicture(const Frame& frame, const PilotOptions& options,
                              VoxelMemory& memory) const {
  const Eigen::Isometry3d sensor_from_map = frame.map_from_sensor.inverse();
  const Planes sides = sidesOf(frame);
  const Vector3d along = kVoxel * sensor_from_map.linear().col(0);
  const int reach = std::min(kReach, static_cast<int>(std::ceil(options.range_max / kVoxel)));
  const int reach_z = std::min(kReachZ, reach);
  const Voxel& middle = memory.window().centre;
  for (int z = middle.z - reach_z; z <= middle.z + reach_z; ++z)
    for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
      const Voxel from{middle.x - reach, y, z};
      const Vector3d first = sensor_from_map * centreOf(from);
      double low = 0.0, high = 2.0 * reach;
      for (const Vector3d& side : sides) clip(side.dot(first), side.dot(along), low, high);
      clip(first.z() - options.range_min, along.z(), low, high);
      if (!(low <= high)) continue;  // low may be inf, where a camera sees next to nothing
      const int begin = static_cast<int>(std::ceil(low));
      const int count = static_cast<int>(std::floor(high)) - begin + 1;
      if (count > 0)
        crossRow(frame, first + begin * along, along, {from.x + begin, y, z}, count, memory);
    }
}

bool FrameSight::rayPasses(const Frame& frame, double column, double row,
                           const Vector3d& centre) const {
  const int c = nearestPixel(column), r = nearestPixel(row);
  if (c < 0 || c >= frame.width || r < 0 || r >= frame.height) return false;
  const std::size_t pixel = static_cast<std::size_t>(r) * frame.width + c;
  if (centre.z() + kHalfDiagonal < depths_[pixel]) return true;
  const double range = ranges_[pixel];
  return range > 0.0 && centre.squaredNorm() < range * range;
}

// The ray through the centre; where that pixel holds nothing, one of four rays beside it.
bool FrameSight::anyRayPasses(const Frame& frame, const Vector3d& centre) const {
  const Pinhole& p = *frame.pinhole;
  const double inverse = 1.0 / centre.z();
  const double column = p.cx + p.fx * centre.x() * inverse;
  const double row = p.cy + p.fy * centre.y() * inverse;
  if (rayPasses(frame, column, row, centre)) return true;
  const double aside = kBesideCentre * p.fx * inverse;
  const int c = nearestPixel(column), r = nearestPixel(row);
  const bool outside = c < 0 || c >= frame.width || r < 0 || r >= frame.height;
  if (outside || aside < 1.0 || depths_[static_cast<std::size_t>(r) * frame.width + c] != 0.0f)
    return false;
  return rayPasses(frame, column - aside, row, centre) ||
         rayPasses(frame, column + aside, row, centre) ||
         rayPasses(frame, column, row - aside, centre) ||
         rayPasses(frame, column, row + aside, centre);
}

void FrameSight::crossRow(const Frame& frame, const Vector3d& first, const Vector3d& along,
                          const Voxel& from, int count, VoxelMemory& memory) const {
  for (int i = 0; i < count; ++i)
    if (anyRayPasses(frame, first + i * along)) memory.cross(slotOf(from.x + i, from.y, from.z));
}

void FrameSight::crossRays(const Frame& frame, const PilotOptions& options, VoxelMemory& memory) {
  const auto endOf = [&](std::size_t pixel) {
    const Vector3d point = pointOf(frame, pixel).cast<double>();
    const double share = std::min(1.0, options.range_max / point.norm());
    return Vector3d(frame.map_from_sensor * (point * share));
  };
  rays_.clear();
  rays_.reserve(frame.pixels());  // or bits of ray_ends_ stay where memory fails
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel) {
    const float range = pointOf(frame, pixel).norm();
    if (!(std::isfinite(range) && range >= options.range_min)) continue;
    const Voxel end = voxelAt(endOf(pixel));
    if (!memory.window().contains(end) || ray_ends_.get(slotOf(end))) continue;
    ray_ends_.set(slotOf(end));
    rays_.push_back(pixel);
  }
  const Vector3d origin = frame.map_from_sensor.translation();
  for (const std::size_t pixel : rays_) {
    const Vector3d end = endOf(pixel);
    ray_ends_.clear(slotOf(voxelAt(end)));
    forVoxelsOfRay(origin, end, [&](int slot) { memory.cross(slot); });
  }
}

}  // namespace grid_path_planner::avoidance
