#include "avoidance/steering/vantage.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "avoidance/steering/steering.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

constexpr double kSlope = 0.52;      // height by distance that a camera sees for certain
constexpr double kPicture = 0.5;     // rad beside its middle that a camera sees for certain
constexpr double kLeastRange = 0.5;  // m
constexpr double kRounding = 1e-9;   // m
constexpr double kThin = 0.1;        // m about a line of sight
constexpr double kTurnStep = M_PI / 6.0;

// The voxels for which the place does not count as seen, as OpenSpace judges: about its voxel's centre.
std::vector<Vector3d> unseenAbout(const OpenSpace& space, const Vector3d& place, double radius) {
  const Vector3d middle = centreOf(voxelAt(place));
  const Voxel low = voxelAt((middle.array() - radius).matrix());
  const Voxel high = voxelAt((middle.array() + radius).matrix());
  std::vector<Vector3d> unseen;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const Vector3d centre = centreOf({x, y, z});
        if ((centre - middle).norm() <= radius + kRounding && !space.observed(slotOf(x, y, z)))
          unseen.push_back(centre);
      }
  return unseen;
}

// In view of a camera that turns to it.
bool isInView(const OpenSpace& space, const Vector3d& voxel, const Vector3d& from) {
  const Vector3d direction = voxel - from;
  const double level = direction.head<2>().norm();
  if (direction.norm() < kLeastRange || std::abs(direction.z()) > kSlope * level) return false;
  const Vector3d before = from + direction * std::max(0.0, 1.0 - 0.3 / direction.norm());
  return space.clear(from, before, kThin);
}

// How many of the voxels are in view.
int inView(const OpenSpace& space, const std::vector<Vector3d>& voxels, const Vector3d& from) {
  return static_cast<int>(std::count_if(voxels.begin(), voxels.end(), [&](const Vector3d& voxel) {
    return isInView(space, voxel, from);
  }));
}

bool isOpenLine(const KeptRoom& room, const Vector3d& from, const Vector3d& to) {
  const int samples = 1 + static_cast<int>((to - from).norm() / 0.1);
  return !firstClosed(room, samples, [&](int i) -> Vector3d {
    return from + (to - from) * (static_cast<double>(i) / samples);
  });
}

// The best place that is reached straight.
std::optional<Vector3d> straightVantage(const OpenSpace& space, const KeptRoom& room,
                                        const Vector3d& vehicle, const Vector3d& place,
                                        const std::vector<Vector3d>& unseen, int& most) {
  std::optional<Vector3d> best;
  const Vector3d direction = place - vehicle;
  const double ahead = std::atan2(direction.y(), direction.x());
  for (const double metres : {0.3, 0.6, 0.9, 1.2, 1.6, 2.0, 2.5})
    for (int turn = 0; turn < 12; ++turn) {
      const double angle = ahead + M_PI + (turn % 2 == 0 ? -1 : 1) * ((turn + 1) / 2) * kTurnStep;
      const Vector3d from = vehicle + metres * Vector3d(std::cos(angle), std::sin(angle), 0.0);
      if (!isOpenLine(room, vehicle, from)) continue;
      const int seen = inView(space, unseen, from);
      if (seen <= most) continue;
      most = seen;
      best = from;
      if (most == static_cast<int>(unseen.size())) return best;
    }
  return best;
}

}  // namespace

std::vector<Vector3d> unseenAside(const OpenSpace& space, const Vector3d& vehicle, double yaw,
                                  const Vector3d& place, double d_safe) {
  std::vector<Vector3d> aside;
  for (const Vector3d& voxel : unseenAbout(space, place, d_safe)) {
    const Vector3d direction = voxel - vehicle;
    const double turn = angleDifference(yaw, std::atan2(direction.y(), direction.x()));
    if (std::abs(turn) > kPicture && isInView(space, voxel, vehicle)) aside.push_back(voxel);
  }
  return aside;
}

std::vector<Vector3d> pathToVantage(const OpenSpace& space, const KeptRoom& room,
                                    const Vector3d& vehicle, const Vector3d& place, double d_safe,
                                    const std::vector<Vector3d>& track) {
  const std::vector<Vector3d> unseen = unseenAbout(space, place, d_safe);
  const int all = static_cast<int>(unseen.size());
  int most = inView(space, unseen, vehicle);
  const auto straight = straightVantage(space, room, vehicle, place, unseen, most);
  std::vector<Vector3d> path = {vehicle}, best;
  if (straight) best = {vehicle, *straight};
  for (std::size_t i = track.size(); i-- > 0 && most < all;) {
    if (!isOpenLine(room, path.back(), track[i])) break;
    path.push_back(track[i]);
    const int seen = inView(space, unseen, track[i]);
    if (seen <= most) continue;
    most = seen;
    best = path;
  }
  return best;
}

}  // namespace grid_path_planner::avoidance
