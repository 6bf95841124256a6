#include "avoidance/memory/voxel_memory.h"

#include <algorithm>
#include <cstdlib>

namespace grid_path_planner::avoidance {
namespace {

constexpr std::int32_t kTwoPoints = 500;  // ms between the points that make a voxel occupied
constexpr std::int32_t kRecently = 500;   // ms since a voxel was seen free
constexpr int kMean = 16;                 // points
constexpr unsigned kFiveFrames = 0x1f;
constexpr unsigned kHit = 0x80;
constexpr int kPassedFrames = 3;

int countBits(unsigned bits) {
  return __builtin_popcount(bits);
}

std::uint16_t shareOf(double coordinate, int index) {
  const double share = coordinate * (1.0 / kVoxel) - index;
  return static_cast<std::uint16_t>(std::clamp(share * 65536.0, 0.0, 65535.0));
}

}  // namespace

VoxelMemory::VoxelMemory() : seen_at_(kSlots, 0), details_(kSlots) {}

void VoxelMemory::clear() {
  placed_ = false;
  seen_.fill(false);
  occupied_.fill(false);
  details_.assign(details_.size(), Detail{});
}

void VoxelMemory::reset(int slot) {
  seen_.clear(slot);
  occupied_.clear(slot);
  details_[slot] = Detail{};
}

void VoxelMemory::moveTo(const Eigen::Vector3d& centre) {
  const Voxel target = voxelAt(centre);
  const bool far = std::abs(target.x - window_.centre.x) > kReach ||
                   std::abs(target.y - window_.centre.y) > kReach ||
                   std::abs(target.z - window_.centre.z) > kReachZ;
  if (!placed_ || far) {
    clear();
    window_.centre = target;
    placed_ = true;
    return;
  }
  moveAxis(0, target.x);
  moveAxis(1, target.y);
  moveAxis(2, target.z);
}

// Layer by layer: what was the far side of the window is forgotten.
void VoxelMemory::moveAxis(int axis, int target) {
  int* const centres[] = {&window_.centre.x, &window_.centre.y, &window_.centre.z};
  const int reach = axis == 2 ? kReachZ : kReach;
  int& centre = *centres[axis];
  while (centre != target) {
    const int direction = target > centre ? 1 : -1;
    const int leaving = centre - direction * reach;
    for (int a = 0; a < kRingX; ++a)
      for (int b = 0; b < (axis == 2 ? kRingY : kRingZ); ++b)
        reset(axis == 0   ? slotOf(leaving, a, b)
              : axis == 1 ? slotOf(a, leaving, b)
                          : slotOf(a, b, leaving));
    centre += direction;
  }
}

void VoxelMemory::beginFrame(std::int32_t milliseconds) {
  now_ = milliseconds;
  if (++frame_ == 0) frame_ = 1;
}

void VoxelMemory::average(Detail& detail, const Voxel& voxel, const Eigen::Vector3d& point) {
  if (detail.points < kMean) ++detail.points;
  const auto mean = [&](std::uint16_t& value, double coordinate, int index) {
    const int difference = static_cast<int>(shareOf(coordinate, index)) - value;
    // By a constant where most points are, which takes no division.
    const int part = detail.points == kMean ? difference / kMean : difference / detail.points;
    value = static_cast<std::uint16_t>(value + part);
  };
  mean(detail.x, point.x(), voxel.x);
  mean(detail.y, point.y(), voxel.y);
  mean(detail.z, point.z(), voxel.z);
}

void VoxelMemory::hit(const Eigen::Vector3d& point) {
  const Voxel voxel = voxelAt(point);
  if (!window_.contains(voxel)) return;
  const int slot = slotOf(voxel);
  Detail& detail = details_[slot];
  const bool second = now_ - detail.point_at <= kTwoPoints;
  if (!second && !occupied_.get(slot)) detail.points = 0;
  average(detail, voxel, point);
  detail.point_at = now_;
  detail.frame = frame_;
  detail.passed = kHit;
  if (!second && !occupied_.get(slot)) return;
  if (!occupied_.get(slot)) {
    detail.appeared = seen_.get(slot) && now_ - seen_at_[slot] <= kRecently ? frame_ : 0;
    occupied_.set(slot);
    seen_.set(slot);
  }
  seen_at_[slot] = now_;
}

void VoxelMemory::cross(int slot) {
  Detail& detail = details_[slot];
  const std::uint16_t since = static_cast<std::uint16_t>(frame_ - detail.frame);
  if (since == 0 && (detail.passed & kHit) != 0) return;
  const unsigned before = since < 5 ? static_cast<unsigned>(detail.passed) << since : 0u;
  detail.passed = static_cast<std::uint8_t>((before & kFiveFrames) | 1u);
  detail.frame = frame_;
  if (occupied_.get(slot)) {
    if (countBits(detail.passed) < kPassedFrames) return;
    occupied_.clear(slot);
  }
  seen_.set(slot);
  seen_at_[slot] = now_;
}

template <class Action>
void VoxelMemory::forBall(const Eigen::Vector3d& centre, double radius,
                          const Action& action) const {
  const Voxel low = voxelAt(centre - Eigen::Vector3d::Constant(radius));
  const Voxel high = voxelAt(centre + Eigen::Vector3d::Constant(radius));
  const Voxel& middle = window_.centre;
  const int z_end = std::min(high.z, middle.z + kReachZ);
  const int y_end = std::min(high.y, middle.y + kReach);
  const int x_end = std::min(high.x, middle.x + kReach);
  for (int z = std::max(low.z, middle.z - kReachZ); z <= z_end; ++z)
    for (int y = std::max(low.y, middle.y - kReach); y <= y_end; ++y)
      for (int x = std::max(low.x, middle.x - kReach); x <= x_end; ++x)
        if ((centreOf({x, y, z}) - centre).squaredNorm() <= radius * radius)
          action(slotOf(x, y, z));
}

void VoxelMemory::clearBall(const Eigen::Vector3d& centre, double radius) {
  forBall(centre, radius, [this](int slot) {
    if (occupied_.get(slot)) return;
    seen_.set(slot);
    seen_at_[slot] = now_;
  });
}

void VoxelMemory::keepBall(const Eigen::Vector3d& centre, double radius) {
  forBall(centre, radius, [this](int slot) {
    if (seen_.get(slot)) seen_at_[slot] = now_;
  });
}

void VoxelMemory::forget(std::int32_t milliseconds) {
  for (int word = 0; word < kSlots / 64; ++word) {
    std::uint64_t bits = seen_.words()[word];
    if (bits == 0) continue;
    const std::int32_t* times = &seen_at_[static_cast<std::size_t>(word) * 64];
    std::uint64_t keep = 0;
    for (int bit = 0; bit < 64; ++bit)
      keep |= static_cast<std::uint64_t>(times[bit] >= milliseconds) << bit;
    seen_.words()[word] &= keep;
    occupied_.words()[word] &= keep;
  }
}

Eigen::Vector3d VoxelMemory::point(const Voxel& voxel) const {
  const Detail& detail = details_[slotOf(voxel)];
  const Eigen::Vector3d share((detail.x + 0.5) / 65536.0, (detail.y + 0.5) / 65536.0,
                              (detail.z + 0.5) / 65536.0);
  return kVoxel * (Eigen::Vector3d(voxel.x, voxel.y, voxel.z) + share);
}

}  // namespace grid_path_planner::avoidance
