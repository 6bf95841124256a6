// What was seen, voxel by voxel, in a window that travels with the vehicle.
//
//   memory.moveTo(sensor_position);
//   memory.beginFrame(milliseconds);
//   memory.hit(point);                       // every measured point; then
//   memory.cross(slot);                      // every voxel that a ray passed
//   memory.forget(before);
//
// A voxel is unseen, free or occupied. Two points within 0.5 s make it occupied, one is noise. A hit beats
// the rays that pass in its frame; passed in 3 of 5 frames without a hit between them, an occupied voxel
// is free. An occupied voxel holds the mean of its newest points, so that distances are to points, not
// to boxes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "avoidance/memory/voxel_window.h"

namespace grid_path_planner::avoidance {

class VoxelMemory {
 public:
  VoxelMemory();

  // What leaves the window is forgotten.
  void moveTo(const Eigen::Vector3d& centre);
  const Window& window() const { return window_; }
  void clear();

  void beginFrame(std::int32_t milliseconds);
  void hit(const Eigen::Vector3d& point);
  // Of a voxel inside the window.
  void cross(int slot);
  // The ball is seen free, but for what is occupied.
  void clearBall(const Eigen::Vector3d& centre, double radius);
  // What was seen of the ball is as if seen now.
  void keepBall(const Eigen::Vector3d& centre, double radius);
  // What was seen last before `milliseconds` is unseen.
  void forget(std::int32_t milliseconds);

  bool seen(int slot) const { return seen_.get(slot); }
  bool occupied(int slot) const { return occupied_.get(slot); }
  const SlotBits& seenBits() const { return seen_; }
  const SlotBits& occupiedBits() const { return occupied_; }
  // Of an occupied voxel.
  Eigen::Vector3d point(const Voxel& voxel) const;
  std::int32_t seenAt(int slot) const { return seen_at_[slot]; }
  // Whether an occupied voxel was seen free at most `frames` frames before it became occupied, and that
  // is no longer ago: something moves there.
  bool appeared(int slot, int frames) const {
    const std::uint16_t at = details_[slot].appeared;
    return at != 0 && static_cast<std::uint16_t>(frame_ - at) < frames;
  }

 private:
  struct Detail {
    std::int32_t point_at = kNever;     // ms, of the last point
    std::uint16_t x = 0, y = 0, z = 0;  // the mean of the points, in 1/65536 of the voxel
    std::uint16_t frame = 0;            // of the newest hit or passage
    std::uint16_t appeared = 0;         // frame in which it became occupied after it had been free
    std::uint8_t points = 0;            // in the mean, at most kMean
    // In which of the newest frames it was passed, as bits, the newest is bit 0; kHit: hit in that frame.
    std::uint8_t passed = 0;
  };
  static constexpr std::int32_t kNever = -1000000;

  void reset(int slot);
  void average(Detail& detail, const Voxel& voxel, const Eigen::Vector3d& point);
  void moveAxis(int axis, int target);
  template <class Action>
  void forBall(const Eigen::Vector3d& centre, double radius, const Action& action) const;

  Window window_;
  bool placed_ = false;
  std::int32_t now_ = 0;     // ms
  std::uint16_t frame_ = 0;  // counts frames
  SlotBits seen_, occupied_;
  std::vector<std::int32_t> seen_at_;  // ms
  std::vector<Detail> details_;
};

}  // namespace grid_path_planner::avoidance
