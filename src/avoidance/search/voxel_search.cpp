#include "avoidance/search/voxel_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNearCost = 1.7;
constexpr double kNearRoom = 0.2;   // m beyond the distance kept, in which it costs more
constexpr double kVertical = 2.0;   // cost of a metre of height
constexpr double kEscape = 1.0;     // m about a start that is itself too near
constexpr int kSides = kReach - 4;  // voxels from the centre to where a far goal is given up

struct Step {
  int x, y, z;
  float length;  // m, height weighted
};

std::array<Step, 26> makeSteps() {
  std::array<Step, 26> steps{};
  int count = 0;
  const auto add = [&](int x, int y, int z) {
    const double length = kVoxel * std::sqrt(x * x + y * y + kVertical * kVertical * z * z);
    steps[count++] = {x, y, z, static_cast<float>(length)};
  };
  for (const int z : {0, -1, 1})  // the level ones first
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (x != 0 || y != 0 || z != 0) add(x, y, z);
  return steps;
}

const std::array<Step, 26>& steps() {
  static const std::array<Step, 26> all = makeSteps();
  return all;
}

}  // namespace

VoxelSearch::VoxelSearch() : nodes_(kSlots, Node{0.0f, 0, 0, 0, 0}) {}

void VoxelSearch::begin(const OpenSpace& space, const VoxelQuery& query) {
  space_ = &space;
  query_ = &query;
  start_ = voxelAt(query.start);
  goal_ = voxelAt(query.goal);
  if (query.flat) start_.z = goal_.z;
  start_room_ = space.nearest(query.start, query.distance);
  if (++count_ == 0) {
    std::fill(nodes_.begin(), nodes_.end(), Node{0.0f, 0, 0, 0, 0});
    count_ = 1;
  }
  open_.clear();
}

VoxelSearch::Node& VoxelSearch::nodeAt(int slot) {
  Node& node = nodes_[slot];
  if (node.query != count_) node = {std::numeric_limits<float>::infinity(), count_, 0, 0, 0};
  return node;
}

// A start that is too near is left where distances grow.
VoxelSearch::Room VoxelSearch::judge(const Vector3d& centre, int slot) const {
  for (const Vector3d& closed : *query_->closed)
    if ((centre - closed).squaredNorm() < kClosedPlace * kClosedPlace) return Room::CLOSED;
  if (!space_->crowded(slot)) return Room::FREE;
  const double away = (centre - query_->start).norm();
  const bool escapes = start_room_ < query_->distance && away < kEscape;
  const double asked =
      escapes ? std::min(query_->distance, start_room_ + 0.2 * away - 0.05) : query_->distance;
  const double room = space_->nearest(centre, query_->distance + kNearRoom, asked);
  if (room < asked) return Room::CLOSED;
  return room < query_->distance + kNearRoom ? Room::NEAR : Room::FREE;
}

VoxelSearch::Room VoxelSearch::roomAt(const Voxel& voxel) {
  const int slot = slotOf(voxel);
  Node& node = nodeAt(slot);
  if (node.room == static_cast<std::uint8_t>(Room::UNKNOWN)) {
    const Vector3d centre = centreOf(voxel);
    const bool fenced = centre.z() < query_->z_min || centre.z() > query_->z_max;
    const bool inside = space_->window().contains(voxel);
    node.room = static_cast<std::uint8_t>(inside && !fenced ? judge(centre, slot) : Room::CLOSED);
  }
  return static_cast<Room>(node.room);
}

// Of a metre there; infinite where it is closed.
double VoxelSearch::weight(const Voxel& voxel) {
  const Room room = roomAt(voxel);
  if (room == Room::CLOSED) return kInfinite;
  const double unseen = space_->seen(slotOf(voxel)) ? 1.0 : query_->unseen_cost;
  return room == Room::NEAR ? kNearCost * unseen : unseen;
}

// The length of the shortest path over a grid of level diagonals, at an angle to it in height.
double VoxelSearch::heuristic(const Voxel& voxel) const {
  const double x = std::abs(voxel.x - goal_.x), y = std::abs(voxel.y - goal_.y);
  const double level = std::max(x, y) + (M_SQRT2 - 1.0) * std::min(x, y);
  if (query_->flat) return kVoxel * level;
  const double z = kVertical * std::abs(voxel.z - goal_.z);
  return kVoxel * std::sqrt(level * level + z * z);
}

bool VoxelSearch::atGoal(const Voxel& voxel) const {
  if (!space_->window().contains(goal_)) {
    const Voxel& middle = space_->window().centre;
    return std::abs(voxel.x - middle.x) >= kSides || std::abs(voxel.y - middle.y) >= kSides;
  }
  Vector3d off = centreOf(voxel) - query_->goal;
  if (query_->flat) off.z() = 0.0;
  return off.norm() <= std::max(query_->goal_radius, 0.5 * kVoxel * M_SQRT2);
}

void VoxelSearch::expand(const Voxel& voxel) {
  const float g = nodeAt(slotOf(voxel)).g;
  const int count = query_->flat ? 8 : 26;
  for (int i = 0; i < count; ++i) {
    const Step& step = steps()[i];
    const Voxel next{voxel.x + step.x, voxel.y + step.y, voxel.z + step.z};
    const int slot = slotOf(next);
    Node& node = nodeAt(slot);
    // Nothing weighs less than 1, and most of what is around was reached cheaper: asked before the points are.
    if (node.done || g + step.length >= node.g) continue;
    const double weighted = weight(next);
    if (weighted == kInfinite) continue;
    const auto reached = static_cast<float>(g + step.length * weighted);
    if (reached >= node.g) continue;
    const auto total = static_cast<float>(reached + heuristic(next));
    if (total >= query_->most_cost) continue;
    node.g = reached;
    node.from = static_cast<std::uint8_t>(i);
    open_.push_back({total, slot});
    std::push_heap(open_.begin(), open_.end(), std::greater<Entry>());
  }
}

// The slot of the goal, or -1.
int VoxelSearch::run(VoxelPath& path) {
  nodeAt(slotOf(start_)).g = 0.0f;
  open_.push_back({static_cast<float>(heuristic(start_)), slotOf(start_)});
  while (!open_.empty()) {
    const int slot = open_.front().second;
    std::pop_heap(open_.begin(), open_.end(), std::greater<Entry>());
    open_.pop_back();
    Node& node = nodeAt(slot);
    if (node.done) continue;
    node.done = 1;
    const Voxel voxel = space_->window().voxelOf(slot);
    if (atGoal(voxel)) return slot;
    if (++path.expanded >= query_->most_nodes) return -1;
    expand(voxel);
  }
  path.exhausted = true;
  return -1;
}

void VoxelSearch::trace(int slot, VoxelPath& path) {
  costs_.clear();
  Voxel voxel = space_->window().voxelOf(slot);
  while (!(voxel == start_)) {
    const Node& node = nodeAt(slotOf(voxel));
    path.points.push_back(centreOf(voxel));
    if (query_->flat) path.points.back().z() = query_->goal.z();
    costs_.push_back(node.g);
    const Step& step = steps()[node.from];
    voxel = {voxel.x - step.x, voxel.y - step.y, voxel.z - step.z};
  }
  path.points.push_back(query_->start);
  costs_.push_back(0.0);
  std::reverse(path.points.begin(), path.points.end());
  std::reverse(costs_.begin(), costs_.end());
}

// The line is as near to points as its voxels say, but never nearer than the distance kept.
double VoxelSearch::costOfLine(const Vector3d& from, const Vector3d& to) {
  const bool escapes = start_room_ < query_->distance && (from - query_->start).norm() < kEscape;
  if (!space_->clear(from, to, escapes ? std::max(0.0, start_room_ - 0.05) : query_->distance))
    return kInfinite;
  Vector3d line = to - from;
  const int samples = 1 + static_cast<int>(line.norm() / kVoxel);
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Voxel voxel = voxelAt(from + line * ((i + 0.5) / samples));
    sum += space_->window().contains(voxel) ? weight(voxel) : kInfinite;
  }
  line.z() *= kVertical;
  return line.norm() * sum / samples;
}

void VoxelSearch::pullTaut(VoxelPath& path) {
  const std::vector<Vector3d> all = std::move(path.points);
  path.points = {all.front()};
  path.cost = 0.0;
  std::size_t from = 0;
  while (from + 1 < all.size()) {
    std::size_t to = from + 1;
    double cost = costs_[to] - costs_[from];
    for (std::size_t next = to + 1; next < all.size(); ++next) {
      const double line = costOfLine(all[from], all[next]);
      if (!(line <= costs_[next] - costs_[from] + 1e-3)) break;
      to = next;
      cost = line;
    }
    path.points.push_back(all[to]);
    path.cost += cost;
    from = to;
  }
}

VoxelPath VoxelSearch::search(const OpenSpace& space, const VoxelQuery& query) {
  begin(space, query);
  VoxelPath path;
  if (!space.window().contains(start_)) return path;
  const int reached = run(path);
  if (reached < 0) return path;
  trace(reached, path);
  pullTaut(path);
  if (path.points.size() == 1) path.points.push_back(query.goal);
  return path;
}

double VoxelSearch::lineCost(const OpenSpace& space, const Vector3d& from, const Vector3d& to,
                             const VoxelQuery& query) {
  space_ = &space;
  query_ = &query;
  return costOfLine(from, to);
}

}  // namespace grid_path_planner::avoidance
