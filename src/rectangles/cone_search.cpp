#include "cone_search.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner {
namespace {

constexpr double kTie = 1e-12;  // relative: sums of the same lengths in another order

constexpr MeshPoint kAxes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

bool upright(int side) {  // a side, not an axis
  return side % 2 == 0;
}

// In the quarter, the axis it begins with included, the one it ends with not.
bool fromFirstAxis(MeshPoint d, int quarter) {
  switch (quarter) {
    case 0:
      return d.x > 0 && d.y >= 0;
    case 1:
      return d.y > 0 && d.x <= 0;
    case 2:
      return d.x < 0 && d.y <= 0;
    default:
      return d.y < 0 && d.x >= 0;
  }
}

// The other way round.
bool fromLastAxis(MeshPoint d, int quarter) {
  switch (quarter) {
    case 0:
      return d.y > 0 && d.x >= 0;
    case 1:
      return d.x < 0 && d.y >= 0;
    case 2:
      return d.y < 0 && d.x <= 0;
    default:
      return d.x > 0 && d.y <= 0;
  }
}

std::int64_t dot(MeshPoint a, MeshPoint b) {
  return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y;
}

double length(double x, double y) {
  return std::sqrt(x * x + y * y);
}

}  // namespace

inline double ConeSearch::distance(MeshPoint a, MeshPoint b) const {
  return length(double(a.x) - b.x, double(a.y) - b.y);
}

std::size_t ConeSearch::bytes() const {
  return roots_.size() * sizeof(Root) + corners_.size() * sizeof(Known) +
         block_queries_.size() * sizeof(std::uint32_t) +
         nodes_.size() * (sizeof(Node) + sizeof(Entry) + sizeof(std::uint32_t));
}

void ConeSearch::push(double f, const Node& node) {
  std::uint32_t place = static_cast<std::uint32_t>(nodes_.size());
  if (unused_.empty()) {
    nodes_.push_back(node);
  } else {
    place = unused_.back();
    unused_.pop_back();
    nodes_[place] = node;
  }
  heap_.push_back({f, place});
  std::push_heap(heap_.begin(), heap_.end());
  ++counts_->generated;
}

ConeSearch::Node ConeSearch::pop() {
  std::pop_heap(heap_.begin(), heap_.end());
  const std::uint32_t place = heap_.back().node;
  heap_.pop_back();
  unused_.push_back(place);
  return nodes_[place];
}

// The most promising of the successors need not pass through the open list.
inline void ConeSearch::offer(double f, const Node& node) {
  if (f >= best_) return;
  if (has_next_ && f >= next_f_) return push(f, node);
  if (has_next_) push(next_f_, next_);
  has_next_ = true;
  next_f_ = f;
  next_ = node;
}

void ConeSearch::see(std::int32_t root) {
  const double length = roots_[root].g + distance(roots_[root].at, goal_.at);
  if (length >= best_) return;
  best_ = length;
  best_root_ = root;
}

inline bool ConeSearch::sees(const Node& node) const {
  const MeshPoint towards = goal_.at - roots_[node.root].at;
  return cross(node.left, towards) <= 0 && cross(node.right, towards) >= 0;
}

// The least length of a way through the cone to the goal: straight, or round an end of what it sees
// of the border; a goal on the root's side of the border's line is as far as its mirror image.
double ConeSearch::promise(const Node& node, MeshPoint on_border, int side) const {
  const Root& root = roots_[node.root];
  MeshPoint goal = goal_.at;
  if (upright(side)) {
    if ((goal.x < on_border.x) == (root.at.x < on_border.x)) goal.x = 2 * on_border.x - goal.x;
  } else {
    if ((goal.y < on_border.y) == (root.at.y < on_border.y)) goal.y = 2 * on_border.y - goal.y;
  }
  const MeshPoint towards = goal - root.at;
  MeshPoint ray;
  if (cross(node.left, towards) > 0) {
    ray = node.left;
  } else if (cross(node.right, towards) < 0) {
    ray = node.right;
  } else {
    return root.g + length(towards.x, towards.y);
  }
  const double share = upright(side) ? (double(on_border.x) - root.at.x) / ray.x
                                     : (double(on_border.y) - root.at.y) / ray.y;
  const double x = share * ray.x, y = share * ray.y;
  return root.g + length(x, y) + length(towards.x - x, towards.y - y);
}

// A root at the corner for an arrival from `parent`, -1 where a better or wider one was there.
std::int32_t ConeSearch::relax(std::int32_t parent, std::uint32_t corner, Turn sense) {
  const Root& from = roots_[parent];
  const MeshPoint at = mesh_->corner(corner).at;
  const double g = from.g + distance(from.at, at);
  if (g + distance(at, goal_.at) >= best_) return -1;
  Known& known = corners_[corner];
  if (known.query == query_) {
    Root& root = roots_[known.root];
    if (g > root.g * (1.0 + kTie)) return -1;
    if (g >= root.g * (1.0 - kTie)) {
      std::int32_t& widest = root.widest[sense];
      if (widest >= 0) {
        const std::int64_t side = cross(at - roots_[widest].at, at - from.at);
        if (sense == Turn::ANTICLOCKWISE ? side >= 0 : side <= 0) return -1;
      }
      widest = parent;
      return known.root;
    }
    root.beaten = true;
    ++counts_->reopened;
  }
  known = {query_, static_cast<std::int32_t>(roots_.size())};
  Root root{at, g, parent, {-1, -1}, false};
  root.widest[sense] = parent;
  roots_.push_back(root);
  return known.root;
}

// Round the corner, if a way from the root can turn tautly there.
void ConeSearch::turn(std::int32_t parent, std::uint32_t corner, Turn sense) {
  const RectangleMesh::Corner& place = mesh_->corner(corner);
  const MeshPoint arrival = place.at - roots_[parent].at;
  const bool left = sense == Turn::ANTICLOCKWISE;
  const int quarter = (place.quarter + (left ? 3 : 1)) % 4;
  if (!(left ? fromFirstAxis(arrival, quarter) : fromLastAxis(arrival, quarter))) return;
  const std::int32_t root = relax(parent, corner, sense);
  if (root < 0) return;
  Node node{arrival, kAxes[(quarter + 1) % 4], root, place.rectangle[sense], (quarter + 3) % 4, 4};
  if (!left) {
    node.right = kAxes[quarter];
    node.left = arrival;
  }
  if (node.rectangle == goal_.rectangle) {
    if (sees(node)) see(root);
    return;
  }
  offer(roots_[root].g + distance(place.at, goal_.at), node);
}

// Through a border; `right` and `left` are where its ends lie of the cone's rays: to the left of
// the right ray above 0, to the right of the left ray below 0.
inline void ConeSearch::pass(const Node& node, const RectangleMesh::Border& border, int side,
                             std::int64_t right, std::int64_t left) {
  if (block_queries_[border.block] != query_ || border.to == start_.rectangle) return;
  const MeshPoint root = roots_[node.root].at;
  Node onwards{right > 0 ? border.right - root : node.right,
               left < 0 ? border.left - root : node.left,
               node.root,
               border.to,
               (side + 3) % 4,
               3};
  if (left <= 0 && border.left_corner != RectangleMesh::kNone)
    turn(node.root, border.left_corner, Turn::ANTICLOCKWISE);
  if (right >= 0 && border.right_corner != RectangleMesh::kNone)
    turn(node.root, border.right_corner, Turn::CLOCKWISE);
  if (border.to == goal_.rectangle) {
    if (sees(onwards)) see(node.root);
    return;
  }
  offer(promise(onwards, border.right, side), onwards);
}

// A root on the line of a side meets the borders there at their nearer ends.
void ConeSearch::alongLeft(const Node& node, int side) {
  const RectangleMesh::Rectangle& rect = mesh_->rectangle(node.rectangle);
  const MeshPoint root = roots_[node.root].at;
  for (std::uint32_t i = rect.first[side]; i < rect.first[side + 1]; ++i) {
    const RectangleMesh::Border& border = mesh_->border(i);
    if (border.left_corner == RectangleMesh::kNone || dot(node.left, border.left - root) <= 0 ||
        block_queries_[border.block] != query_)
      continue;
    turn(node.root, border.left_corner, Turn::ANTICLOCKWISE);
  }
}

void ConeSearch::alongRight(const Node& node, int side) {
  const RectangleMesh::Rectangle& rect = mesh_->rectangle(node.rectangle);
  const MeshPoint root = roots_[node.root].at;
  for (std::uint32_t i = rect.first[side]; i < rect.first[side + 1]; ++i) {
    const RectangleMesh::Border& border = mesh_->border(i);
    if (border.right_corner == RectangleMesh::kNone || dot(node.right, border.right - root) <= 0 ||
        block_queries_[border.block] != query_)
      continue;
    turn(node.root, border.right_corner, Turn::CLOCKWISE);
  }
}

void ConeSearch::lookAlongWalls(const Node& node) {
  const RectangleMesh::Rectangle& rect = mesh_->rectangle(node.rectangle);
  const MeshPoint root = roots_[node.root].at;
  const int right_side = node.side, left_side = (node.side + node.sides - 1) % 4;
  const auto onLine = [&](int side) {
    const MeshPoint end = rect.end(side);
    return upright(side) ? end.x == root.x : end.y == root.y;
  };
  const auto parallel = [](MeshPoint ray, int side) {
    return (upright(side) ? ray.x : ray.y) == 0;
  };
  if (onLine(right_side) && parallel(node.right, right_side)) alongRight(node, right_side);
  if (onLine(left_side) && parallel(node.left, left_side)) alongLeft(node, left_side);
}

void ConeSearch::expand(const Node& node) {
  lookAlongWalls(node);
  const RectangleMesh::Rectangle& rect = mesh_->rectangle(node.rectangle);
  const MeshPoint root = roots_[node.root].at;
  // 1. The side through which the right ray leaves.
  int side = node.side, left = node.sides;
  MeshPoint end = rect.end(side);
  while (cross(node.right, end - root) <= 0) {
    if (--left == 0) return;
    side = (side + 1) % 4;
    end = rect.end(side);
  }
  // 2. The first border of which the cone sees something.
  std::uint32_t i = rect.first[side];
  while (i < rect.first[side + 1] && cross(node.right, mesh_->border(i).left - root) <= 0) ++i;
  // 3. All up to the left ray.
  for (;;) {
    for (; i < rect.first[side + 1]; ++i) {
      const RectangleMesh::Border& border = mesh_->border(i);
      const MeshPoint right_end = border.right - root;
      if (cross(node.left, right_end) >= 0) return;
      pass(node, border, side, cross(node.right, right_end), cross(node.left, border.left - root));
    }
    if (cross(node.left, rect.end(side) - root) >= 0 || --left == 0) return;
    side = (side + 1) % 4;
    i = rect.first[side];
  }
}

// The start lies inside its rectangle and sees all its borders.
void ConeSearch::leaveStart() {
  const RectangleMesh::Rectangle& rect = mesh_->rectangle(start_.rectangle);
  for (int side = 0; side < 4; ++side)
    for (std::uint32_t i = rect.first[side]; i < rect.first[side + 1]; ++i) {
      const Node all{{}, {}, 0, start_.rectangle, 0, 4};
      pass(all, mesh_->border(i), side, 1, -1);
    }
  if (has_next_) push(next_f_, next_);
  has_next_ = false;
}

void ConeSearch::begin(const RectangleMesh& mesh, End start, End goal, Statistics& counts) {
  mesh_ = &mesh;
  counts_ = &counts;
  start_ = start;
  goal_ = goal;
  best_ = std::numeric_limits<double>::infinity();
  best_root_ = -1;
  has_next_ = false;
  roots_.clear();
  nodes_.clear();
  unused_.clear();
  heap_.clear();
  if (++query_ == 0 || corners_.size() != mesh.corners() ||
      block_queries_.size() != mesh.blocks()) {
    query_ = 1;
    corners_.assign(mesh.corners(), Known());
    block_queries_.assign(mesh.blocks(), 0);
  }
  roots_.push_back({start.at, 0.0, -1, {-1, -1}, false});
}

ConeSearch::Answer ConeSearch::run(const RectangleMesh& mesh, End start, End goal,
                                   const StopToken& stop, Statistics& counts,
                                   std::vector<std::uint32_t>* expanded) {
  begin(mesh, start, goal, counts);
  Answer answer;

  // 1. Where a way may lead, and what the start sees.
  if (!mesh.blocksBetween(start.rectangle, goal.rectangle, blocks_)) return answer;
  for (const std::uint32_t block : blocks_) block_queries_[block] = query_;
  if (start.rectangle == goal.rectangle)
    see(0);
  else
    leaveStart();

  // 2. The most promising cone or turn, until none can lead to a shorter way.
  StopPoll poll(stop, 64);
  while (!heap_.empty() && heap_.front().f < best_) {
    counts.peak_open = std::max(counts.peak_open, heap_.size());
    Node node = pop();
    if (roots_[node.root].beaten) continue;
    for (;;) {
      const StopReason reason = poll.ask();
      if (reason != StopReason::NONE) {
        answer.status = Stopped(reason).status();
        return answer;
      }
      ++counts.expanded;
      if (expanded) expanded->push_back(node.rectangle);
      expand(node);
      if (!has_next_) break;
      has_next_ = false;
      if (!heap_.empty() && next_f_ > heap_.front().f) {
        push(next_f_, next_);
        break;
      }
      node = next_;
    }
  }
  if (best_root_ < 0) return answer;

  // 3. The way back over the roots.
  answer.status = Status::FOUND;
  answer.length = best_;
  answer.points.push_back(goal.at);
  for (std::int32_t at = best_root_; at >= 0; at = roots_[at].parent)
    answer.points.push_back(roots_[at].at);
  std::reverse(answer.points.begin(), answer.points.end());
  return answer;
}

}  // namespace grid_path_planner
