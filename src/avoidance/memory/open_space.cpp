#include "avoidance/memory/open_space.h"

#include <algorithm>
#include <cmath>

#include "avoidance/memory/dilation.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kCells = kSlots >> (3 * kCellShift);
constexpr double kPiece = 1.0;        // m of a segment that are looked at together
constexpr double kDiagonal = 0.3465;  // m, of a voxel
constexpr int kAppearedFrames = 10;

double squaredDistanceToSegment(const Vector3d& point, const Vector3d& from,
                                const Vector3d& segment, double squared_length) {
  const Vector3d off = point - from;
  if (squared_length < 1e-18) return off.squaredNorm();
  const double share = std::clamp(off.dot(segment) / squared_length, 0.0, 1.0);
  return (off - share * segment).squaredNorm();
}

// Rows outside the band count as seen.
void openOutsideBand(const HeightBand& band, const Window& window, SlotBits& bits) {
  constexpr int kWordsOfLayer = kRingX * kRingY / 64;
  for (int z = window.centre.z - kReachZ; z <= window.centre.z + kReachZ; ++z) {
    const double low = z * kVoxel, high = low + kVoxel;
    if (high > band.low && low < band.high) continue;
    auto* layer = &bits.words()[static_cast<std::size_t>(z & (kRingZ - 1)) * kWordsOfLayer];
    std::fill_n(layer, kWordsOfLayer, ~std::uint64_t{0});
  }
}

// Whether no voxel beside this one has been occupied for longer: not the noise of a surface.
bool isDetached(const VoxelMemory& memory, const Voxel& voxel) {
  for (int z = voxel.z - 1; z <= voxel.z + 1; ++z)
    for (int y = voxel.y - 1; y <= voxel.y + 1; ++y)
      for (int x = voxel.x - 1; x <= voxel.x + 1; ++x) {
        const int slot = slotOf(x, y, z);
        if (memory.occupied(slot) && !memory.appeared(slot, kAppearedFrames)) return false;
      }
  return true;
}

}  // namespace

OpenSpace::OpenSpace() : cell_begins_(kCells + 1, 0) {}

void OpenSpace::refresh(const VoxelMemory& memory, double d_safe, const HeightBand& band) {
  window_ = memory.window();
  all_seen_ = memory.seenBits();
  openOutsideBand(band, window_, all_seen_);
  erode(all_seen_, d_safe, seen_);
  dilate(memory.occupiedBits(), d_safe + kRoom + kDiagonal, crowded_);
  collectPoints(memory, band);
}

// A counting sort by cell. Until there is room for all points, those of before stay as they are.
void OpenSpace::collectPoints(const VoxelMemory& memory, const HeightBand& band) {
  found_.clear();
  found_cells_.clear();
  appeared_.clear();
  counted_.assign(kCells + 1, 0);
  const std::vector<std::uint64_t>& words = memory.occupiedBits().words();
  for (int word = 0; word < kSlots / 64; ++word)
    for (std::uint64_t bits = words[word]; bits != 0; bits &= bits - 1) {
      const int slot = word * 64 + __builtin_ctzll(bits);
      const Voxel voxel = window_.voxelOf(slot);
      const Vector3f point = memory.point(voxel).cast<float>();
      if (point.z() < band.low || point.z() > band.high) continue;
      const int cell = cellOf(voxel.x, voxel.y, voxel.z);
      found_.push_back(point);
      found_cells_.push_back(cell);
      ++counted_[cell + 1];
      if (memory.appeared(slot, kAppearedFrames) && isDetached(memory, voxel))
        appeared_.push_back(point);
    }
  for (int cell = 0; cell < kCells; ++cell) counted_[cell + 1] += counted_[cell];
  points_.resize(found_.size());
  for (std::size_t i = found_.size(); i-- > 0;)
    points_[--counted_[found_cells_[i] + 1]] = found_[i];
  // Each begin was moved one cell on, and each end down to its begin.
  for (int cell = 0; cell < kCells; ++cell) counted_[cell] = counted_[cell + 1];
  counted_[kCells] = static_cast<int>(found_.size());
  counted_.swap(cell_begins_);
}

double OpenSpace::nearest(const Vector3d& from, double reach, double enough) const {
  double least = reach * reach;
  const double squared_enough = enough > 0.0 ? enough * enough : 0.0;
  forPoints(from, from, reach, [&](const Vector3f& point) {
    least = std::min(least, (point.cast<double>() - from).squaredNorm());
    return least >= squared_enough;
  });
  return std::sqrt(least);
}

bool OpenSpace::pieceClear(const Vector3d& from, const Vector3d& to, double radius) const {
  const Vector3d segment = to - from;
  const int samples = 1 + static_cast<int>(segment.norm() / kVoxel);
  bool any = false;
  for (int i = 0; i <= samples && !any; ++i)
    any = crowded_.get(slotOf(voxelAt(from + segment * (static_cast<double>(i) / samples))));
  if (!any) return true;
  const double squared_length = segment.squaredNorm(), squared_radius = radius * radius;
  bool clear = true;
  forPoints(from, to, radius, [&](const Vector3f& point) {
    clear = clear && squaredDistanceToSegment(point.cast<double>(), from, segment,
                                              squared_length) >= squared_radius;
  });
  return clear;
}

bool OpenSpace::clear(const Vector3d& from, const Vector3d& to, double radius) const {
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kPiece)));
  const Vector3d segment = (to - from) / pieces;
  for (int i = 0; i < pieces; ++i)
    if (!pieceClear(from + i * segment, from + (i + 1) * segment, radius)) return false;
  return true;
}

double OpenSpace::nearestUnseen(const Vector3d& from, double reach) const {
  const Voxel low = voxelAt((from.array() - reach).matrix());
  const Voxel high = voxelAt((from.array() + reach).matrix());
  double least = reach * reach;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (!all_seen_.get(slotOf(x, y, z)))
          least = std::min(least, (centreOf({x, y, z}) - from).squaredNorm());
  return std::sqrt(least);
}

}  // namespace grid_path_planner::avoidance
