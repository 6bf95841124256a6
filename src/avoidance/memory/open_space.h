// Where the vehicle may be: what of the memory is seen, and how far its points are.
//
//   space.refresh(memory, d_safe, band);             // after every change of the memory
//   const bool may_enter = space.seen(point) && space.clear(point, d_safe);
//
// `seen` judges voxels: all whose centres lie within d_safe of the centre of the point's voxel were seen.
// `clear` and `nearest` judge the remembered points themselves.
#pragma once

#include <Eigen/Core>
#include <type_traits>
#include <vector>

#include "avoidance/memory/frame_sight.h"
#include "avoidance/memory/voxel_memory.h"

namespace grid_path_planner::avoidance {

using Points = std::vector<Eigen::Vector3d>;

class OpenSpace {
 public:
  OpenSpace();

  void refresh(const VoxelMemory& memory, double d_safe, const HeightBand& band);

  const Window& window() const { return window_; }
  bool inside(const Eigen::Vector3d& point) const { return window_.contains(voxelAt(point)); }
  bool seen(int slot) const { return seen_.get(slot); }
  bool seen(const Eigen::Vector3d& point) const {
    const Voxel voxel = voxelAt(point);
    return window_.contains(voxel) && seen_.get(slotOf(voxel));
  }
  bool observed(int slot) const { return all_seen_.get(slot); }  // the voxel itself
  // Whether a point may be nearer than d_safe + kRoom somewhere in the voxel.
  bool crowded(int slot) const { return crowded_.get(slot); }

  // To the nearest remembered point; `reach` where none is nearer. Where one is nearer than `enough`, to
  // any such point.
  double nearest(const Eigen::Vector3d& from, double reach, double enough = 0.0) const;
  // Whether no remembered point is nearer to the segment than `radius` <= d_safe + kRoom.
  bool clear(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) const;
  bool clear(const Eigen::Vector3d& point, double radius) const {
    return clear(point, point, radius);
  }
  // To the centre of the nearest voxel that was not seen; `reach` where none is nearer.
  double nearestUnseen(const Eigen::Vector3d& from, double reach) const;

  // Calls action(point) for all points within `radius` of `from`, and for some beyond. One that returns
  // bool ends it by false, after the points of a cell.
  template <class Action>
  void forPoints(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                 const Action& action) const;
  // Points of voxels that became occupied in the last frames after they had been free, away from all that
  // was there before: something moves.
  const std::vector<Eigen::Vector3f>& appeared() const { return appeared_; }

  static constexpr double kRoom = 0.3;  // m

 private:
  void collectPoints(const VoxelMemory& memory, const HeightBand& band);
  bool pieceClear(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) const;

  Window window_;
  SlotBits all_seen_, seen_, crowded_;
  std::vector<int> cell_begins_;         // of the points of each cell of 4 x 4 x 4 voxels
  std::vector<int> counted_;             // the next of these
  std::vector<Eigen::Vector3f> points_;  // cell by cell
  std::vector<Eigen::Vector3f> found_;   // in the order of their slots
  std::vector<int> found_cells_;
  std::vector<Eigen::Vector3f> appeared_;
};

constexpr double kClosedPlace =
    0.5;                       // m about a place that was given up, in which searches are closed
constexpr int kCellShift = 2;  // voxels are gathered in cells of 4 x 4 x 4

inline int cellOf(int x, int y, int z) {
  return ((z & (kRingZ - 1)) >> kCellShift) << 10 | ((y & (kRingY - 1)) >> kCellShift) << 5 |
         ((x & (kRingX - 1)) >> kCellShift);
}

template <class Action>
void OpenSpace::forPoints(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                          const Action& action) const {
  const Voxel low = voxelAt((from.cwiseMin(to).array() - radius).matrix());
  const Voxel high = voxelAt((from.cwiseMax(to).array() + radius).matrix());
  constexpr int kStep = 1 << kCellShift;
  const auto begin = [](int index) { return index & ~(kStep - 1); };
  for (int z = begin(low.z); z <= high.z; z += kStep)
    for (int y = begin(low.y); y <= high.y; y += kStep)
      for (int x = begin(low.x); x <= high.x; x += kStep) {
        const int cell = cellOf(x, y, z);
        bool go_on = true;
        for (int i = cell_begins_[cell]; i < cell_begins_[cell + 1]; ++i)
          if constexpr (std::is_same_v<decltype(action(points_[i])), bool>)
            go_on = action(points_[i]);
          else
            action(points_[i]);
        if (!go_on) return;
      }
}

}  // namespace grid_path_planner::avoidance
