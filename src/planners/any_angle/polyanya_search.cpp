#include "planners/any_angle/polyanya_search.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::planners {

using base::Statistics;
using base::Status;
using base::Stopped;
using base::StopPoll;
using base::StopReason;
using base::StopToken;

namespace {

// A cone that nothing splits is not put back into the open list at every border, but it may not run
// away from more promising ones either.
constexpr int kBordersUnjudged = 32;

// Sides with more borders than these are bisected.
constexpr std::uint32_t kFewBorders = 8;

constexpr double kTie = 1e-12;  // relative: sums of the same lengths in another order

double lengthOf(double x, double y) {
  return std::sqrt(x * x + y * y);
}

double distance(MeshPoint a, MeshPoint b) {
  return lengthOf(double(a.x) - b.x, double(a.y) - b.y);
}

}  // namespace

std::size_t PolyanyaSearch::bytes() const {
  return roots_.size() * sizeof(Root) + corners_.size() * sizeof(Known) +
         block_queries_.size() * sizeof(std::uint32_t) + open_.bytes();
}

void PolyanyaSearch::push(double f, const Node& node) {
  open_.push(f, node);
  ++counts_->generated;
}

// The most promising of the successors need not pass through the open list.
inline void PolyanyaSearch::keepBestSuccessor(double f, const Node& node) {
  if (f >= incumbent_) return;
  if (has_next_ && f >= next_f_) return push(f, node);
  if (has_next_) push(next_f_, next_);
  has_next_ = true;
  next_f_ = f;
  next_ = node;
}

void PolyanyaSearch::updateIncumbent(std::int32_t root) {
  const double length = roots_[root].g + distance(roots_[root].at, goal_.at);
  if (length >= incumbent_) return;
  incumbent_ = length;
  incumbent_root_ = root;
}

// Where a point lies of a ray, so many columns and lines from the root: east of it above 0.
template <class Ray>
inline std::int64_t eastOf(const Ray& ray, std::int64_t columns, std::int64_t lines) {
  return columns * ray.lines - ray.columns * lines;
}

// The least length of a way through the cone and out of the far side of its rectangle to the goal:
// straight, or round an end of what it sees of that side; a goal on the root's side of the far line
// is as far as its mirror image.
double PolyanyaSearch::fValue(const Node& cone) const {
  const Root& root = roots_[cone.root];
  const PolyanyaMesh::Rectangle& rect = mesh_->rectangle(cone.place);
  const std::int64_t far = rect.line[cone.heading];
  const std::int64_t lines = std::abs(far - root.at.y), beyond = std::abs(far - goal_.at.y);
  const std::int64_t columns = std::int64_t{goal_.at.x} - root.at.x;
  double crossing;  // columns from the root, on the far line
  const Ray west = cone.ray[Direction::WEST], east = cone.ray[Direction::EAST];
  const auto along = [lines](Ray ray) { return double(ray.columns) * lines / ray.lines; };
  bool bends = true;
  if (eastOf(west, columns, lines + beyond) < 0) {
    crossing = along(west);
  } else if (eastOf(east, columns, lines + beyond) > 0) {
    crossing = along(east);
  } else {
    crossing = double(columns) * lines / double(lines + beyond);
    bends = false;
  }
  const double first = double(rect.west) - root.at.x, last = double(rect.east) - root.at.x;
  if (crossing < first) {
    crossing = first;
    bends = true;
  } else if (crossing > last) {
    crossing = last;
    bends = true;
  }
  if (!bends) return root.g + lengthOf(columns, lines + beyond);
  return root.g + lengthOf(crossing, lines) + lengthOf(columns - crossing, beyond);
}

// The length of a way that turns at the corner, none where a shorter one is known or it cannot be
// part of a shorter way to the goal.
inline std::optional<double> PolyanyaSearch::lengthTo(std::int32_t parent,
                                                      std::uint32_t corner) const {
  const Root& from = roots_[parent];
  const MeshPoint at = mesh_->corner(corner).at;
  const double g = from.g + distance(from.at, at);
  const Known& known = corners_[corner];
  if (known.query == query_ && g > roots_[known.root].g * (1.0 + kTie)) return std::nullopt;
  if (g + distance(at, goal_.at) >= incumbent_) return std::nullopt;
  return g;
}

// A root at the corner for an arrival from `parent` of length g, -1 where a wider one was there.
std::int32_t PolyanyaSearch::rootAt(std::int32_t parent, std::uint32_t corner, double g,
                                    Sense sense) {
  const MeshPoint at = mesh_->corner(corner).at;
  Known& known = corners_[corner];
  if (known.query == query_) {
    Root& root = roots_[known.root];
    if (g >= root.g * (1.0 - kTie)) {
      std::int32_t& widest = root.widest[sense];
      if (widest >= 0) {
        const std::int64_t side = cross(at - roots_[widest].at, at - roots_[parent].at);
        if (sense == ANTICLOCKWISE ? side >= 0 : side <= 0) return -1;
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

// A cone that has come to the goal's rectangle.
void PolyanyaSearch::reachGoal(const Node& cone) {
  const MeshPoint root = roots_[cone.root].at;
  const std::int64_t columns = std::int64_t{goal_.at.x} - root.x;
  const std::int64_t lines = std::abs(std::int64_t{goal_.at.y} - root.y);
  if (eastOf(cone.ray[Direction::WEST], columns, lines) >= 0 &&
      eastOf(cone.ray[Direction::EAST], columns, lines) <= 0)
    updateIncumbent(cone.root);
}

// The next corner along the line on which the root lies.
void PolyanyaSearch::flatSuccessors(std::int32_t root, std::uint32_t corner, Direction way) {
  const std::uint32_t next = mesh_->corner(corner).along[way];
  if (next == PolyanyaMesh::kNone) return;
  const MeshPoint at = mesh_->corner(next).at;
  const double f = roots_[root].g + distance(roots_[root].at, at) + distance(at, goal_.at);
  keepBestSuccessor(f, {{}, root, next, {}, static_cast<std::int8_t>(way)});
}

// Whether a taut way can turn at that end of the border, so many columns and lines from the root,
// and sees something to go on to.
inline bool PolyanyaSearch::turns(const PolyanyaMesh::Rectangle& from,
                                  const PolyanyaMesh::Border& border, Direction way,
                                  Heading heading, std::int32_t columns, std::int32_t lines) const {
  if (border.corner[way] == PolyanyaMesh::kNone) return false;
  if (!PolyanyaMesh::behind(from, border, way) &&
      (way == Direction::EAST ? columns >= 0 : columns <= 0))
    return false;
  if (border.to == goal_.rectangle || border.leads_on[way]) return true;
  // Of what lies beyond, the border that is farthest round the corner.
  const PolyanyaMesh::Rectangle& next = mesh_->rectangle(border.to);
  const std::uint32_t first = next.first[heading], end = next.first[heading + 1];
  if (first == end) return false;
  const std::int64_t limit = std::int64_t{columns} * (next.line[1] - next.line[0]);
  return way == Direction::EAST
             ? std::int64_t{mesh_->border(end - 1).east - border.east} * lines > limit
             : std::int64_t{mesh_->border(first).west - border.west} * lines < limit;
}

// Of borders in order the westernmost that reaches to the east of the ray.
inline std::uint32_t PolyanyaSearch::firstSeen(std::uint32_t first, std::uint32_t end,
                                               std::int32_t root, Ray west,
                                               std::int32_t lines) const {
  const std::int64_t limit = std::int64_t{west.columns} * lines;
  const auto unseen = [&](std::uint32_t i) {
    return std::int64_t{mesh_->border(i).east - root} * west.lines <= limit;
  };
  std::uint32_t last = end;
  while (last - first > kFewBorders) {
    const std::uint32_t middle = first + (last - first) / 2;
    if (unseen(middle))
      first = middle + 1;
    else
      last = middle;
  }
  while (first < last && unseen(first)) ++first;
  return first;
}

// Moves the cone on through at most `borders` borders, for as long as it does not part and no taut
// way turns at its ends. In `far` the borders that it meets.
inline PolyanyaSearch::Meets PolyanyaSearch::projectThroughOpenBorders(MeshPoint root, Node& cone,
                                                                       FarSide& far,
                                                                       int& borders) const {
  const Heading heading = cone.heading;
  Ray west = cone.ray[Direction::WEST], east = cone.ray[Direction::EAST];
  std::uint32_t place = cone.place, first = 0, end = 0;
  std::int32_t lines = 0;
  int left = borders;
  Meets meets = Meets::END;
  for (;; --left) {
    if (place == goal_.rectangle || left <= 0) {
      meets = place == goal_.rectangle ? Meets::GOAL : Meets::NOTHING;
      break;
    }
    const PolyanyaMesh::Rectangle& rect = mesh_->rectangle(place);
    lines = std::abs(rect.line[heading] - root.y);
    end = rect.first[heading + 1];
    first = firstSeen(rect.first[heading], end, root.x, west, lines);
    if (first == end) break;
    const PolyanyaMesh::Border& border = mesh_->border(first);
    const std::int32_t west_end = border.west - root.x, east_end = border.east - root.x;
    if (eastOf(east, west_end, lines) >= 0) break;
    if (eastOf(west, west_end, lines) >= 0) {
      if (turns(rect, border, Direction::WEST, heading, west_end, lines)) {
        meets = Meets::BORDERS;
        break;
      }
      west = {west_end, lines};
    }
    if (eastOf(east, east_end, lines) <= 0) {
      if (turns(rect, border, Direction::EAST, heading, east_end, lines) ||
          (first + 1 < end && eastOf(east, mesh_->border(first + 1).west - root.x, lines) < 0)) {
        meets = Meets::BORDERS;
        break;
      }
      east = {east_end, lines};
    }
    if (!allowed(border)) break;
    place = border.to;
  }
  cone.ray[Direction::WEST] = west;
  cone.ray[Direction::EAST] = east;
  cone.place = place;
  borders = left;
  far = {lines, first, end};
  return meets;
}

// Into the open list, but not before it parts or can turn: many end before.
void PolyanyaSearch::pushSuccessor(Node cone) {
  FarSide far;
  int borders = kBordersUnjudged;
  const Meets meets = projectThroughOpenBorders(roots_[cone.root].at, cone, far, borders);
  if (meets == Meets::GOAL) return reachGoal(cone);
  if (meets != Meets::END) keepBestSuccessor(fValue(cone), cone);
}

// A corner met along a line: round it, and on along the line.
void PolyanyaSearch::expandCorner(const Node& node) {
  const PolyanyaMesh::Corner& corner = mesh_->corner(node.place);
  const bool east = node.along == Direction::EAST;
  const bool blocked_east = corner.quarter == 0 || corner.quarter == 3;
  if (blocked_east != east && block_queries_[corner.block] == query_) {
    const bool north = corner.quarter < 2;  // towards the obstacle's rows
    const std::optional<double> g = lengthTo(node.root, node.place);
    if (!g) return;
    const std::int32_t root =
        rootAt(node.root, node.place, *g, east == north ? ANTICLOCKWISE : CLOCKWISE);
    if (root < 0) return;
    Node cone{{{-1, 0}, {0, 1}}, root, corner.rectangle[north], Heading(north), kCone};
    if (east) {
      cone.ray[Direction::WEST] = {0, 1};
      cone.ray[Direction::EAST] = {1, 0};
    }
    pushSuccessor(cone);
  }
  flatSuccessors(node.root, node.place, static_cast<Direction>(node.along));
}

// Round the corner at one end of a border, if that leads anywhere.
void PolyanyaSearch::turningSuccessors(const Node& cone, const PolyanyaMesh::Border& border,
                                       Direction way) {
  const std::uint32_t corner = border.corner[way];
  const std::optional<double> g = lengthTo(cone.root, corner);
  if (!g) return;
  const MeshPoint at = mesh_->corner(corner).at;
  const MeshPoint arrival = at - roots_[cone.root].at;
  const bool north = cone.heading == Heading::NORTHWARDS, east = way == Direction::EAST;
  Node turned = cone;
  turned.place = border.to;
  turned.ray[way] = PolyanyaMesh::behind(mesh_->rectangle(cone.place), border, way)
                        ? Ray{east ? 1 : -1, 0}
                        : Ray{0, 1};
  turned.ray[1 - way] = {arrival.x, std::abs(arrival.y)};
  FarSide far;
  int borders = kBordersUnjudged;
  const Meets meets = projectThroughOpenBorders(at, turned, far, borders);
  if (meets == Meets::END && !border.leads_on[way]) return;
  const std::int32_t root =
      rootAt(cone.root, corner, *g, east == north ? CLOCKWISE : ANTICLOCKWISE);
  if (root < 0) return;
  turned.root = root;
  if (meets == Meets::GOAL)
    reachGoal(turned);
  else if (meets != Meets::END)
    keepBestSuccessor(fValue(turned), turned);
  if (border.leads_on[way]) flatSuccessors(root, corner, way);
}

// Through a border, and round the corners at its ends.
inline PolyanyaSearch::Node PolyanyaSearch::pass(const Node& cone, std::int32_t lines,
                                                 const PolyanyaMesh::Border& border) {
  const PolyanyaMesh::Rectangle& rect = mesh_->rectangle(cone.place);
  const std::int32_t root = roots_[cone.root].at.x;
  const std::int32_t west = border.west - root, east = border.east - root;
  const std::int64_t west_end = eastOf(cone.ray[Direction::WEST], west, lines);
  const std::int64_t east_end = eastOf(cone.ray[Direction::EAST], east, lines);
  Node onwards = cone;
  onwards.place = border.to;
  if (west_end > 0) onwards.ray[Direction::WEST] = {west, lines};
  if (east_end < 0) onwards.ray[Direction::EAST] = {east, lines};
  for (const Direction way : {Direction::WEST, Direction::EAST}) {
    const bool touches = way == Direction::WEST ? west_end >= 0 : east_end <= 0;
    const std::int32_t columns = way == Direction::WEST ? west : east;
    if (touches && turns(rect, border, way, cone.heading, columns, lines))
      turningSuccessors(cone, border, way);
  }
  return onwards;
}

void PolyanyaSearch::expandCone(Node cone) {
  const MeshPoint root = roots_[cone.root].at;
  int borders = kBordersUnjudged;
  for (;;) {
    FarSide far;
    const Meets meets = projectThroughOpenBorders(root, cone, far, borders);
    if (meets == Meets::END) return;
    if (meets == Meets::GOAL) return reachGoal(cone);
    if (meets == Meets::BORDERS) {
      int found = 0;
      Node next{};
      for (std::uint32_t i = far.first; i < far.end; ++i) {
        const PolyanyaMesh::Border& border = mesh_->border(i);
        if (eastOf(cone.ray[Direction::EAST], border.west - root.x, far.lines) >= 0) break;
        if (!allowed(border)) continue;
        if (found++ > 0) pushSuccessor(next);
        next = pass(cone, far.lines, border);
      }
      if (found == 0) return;
      if (found > 1) return pushSuccessor(next);
      cone = next;
      --borders;
      continue;
    }
    const double f = fValue(cone);
    if (f >= incumbent_) return;
    if (!open_.empty() && f > open_.least()) return push(f, cone);
    borders = kBordersUnjudged;
  }
}

void PolyanyaSearch::begin(const PolyanyaMesh& mesh, End start, End goal, Statistics& counts) {
  mesh_ = &mesh;
  counts_ = &counts;
  start_ = start;
  goal_ = goal;
  incumbent_ = std::numeric_limits<double>::infinity();
  incumbent_root_ = -1;
  has_next_ = false;
  roots_.clear();
  open_.clear();
  if (++query_ == 0 || corners_.size() != mesh.corners() ||
      block_queries_.size() != mesh.blocks()) {
    query_ = 1;
    corners_.assign(mesh.corners(), Known());
    block_queries_.assign(mesh.blocks(), 0);
  }
  roots_.push_back({start.at, 0.0, -1, {-1, -1}, false});
}

PolyanyaSearch::Answer PolyanyaSearch::run(const PolyanyaMesh& mesh, End start, End goal,
                                           const StopToken& stop, Statistics& counts,
                                           std::vector<std::uint32_t>* expanded) {
  begin(mesh, start, goal, counts);
  Answer answer;

  // 1. Where a way may lead, and what the start sees.
  if (!mesh.blocksBetween(start.rectangle, goal.rectangle, blocks_)) return answer;
  for (const std::uint32_t block : blocks_) block_queries_[block] = query_;
  if (start.rectangle == goal.rectangle) {
    updateIncumbent(0);
  } else {
    const PolyanyaMesh::Rectangle& rect = mesh.rectangle(start.rectangle);
    const std::int32_t west = rect.west - start.at.x, east = rect.east - start.at.x;
    for (const Heading heading : {Heading::SOUTHWARDS, Heading::NORTHWARDS}) {
      const std::int32_t lines = std::abs(rect.line[heading] - start.at.y);
      const Node cone{{{west, lines}, {east, lines}}, 0, start.rectangle, heading, kCone};
      push(fValue(cone), cone);
    }
  }

  // 2. The most promising cone or corner, until none can lead to a shorter way.
  StopPoll poll(stop, 64);
  while (!open_.empty() && open_.least() < incumbent_) {
    counts.peak_open = std::max(counts.peak_open, open_.size());
    Node node = open_.pop();
    if (roots_[node.root].beaten) continue;
    for (;;) {
      const StopReason reason = poll.ask();
      if (reason != StopReason::NONE) {
        answer.status = Stopped(reason).status();
        return answer;
      }
      ++counts.expanded;
      if (expanded)
        expanded->push_back(node.along != kCone ? mesh.corner(node.place).rectangle[0]
                                                : node.place);
      if (node.along != kCone)
        expandCorner(node);
      else
        expandCone(node);
      if (!has_next_) break;
      has_next_ = false;
      if (next_f_ >= incumbent_) break;
      if (!open_.empty() && next_f_ > open_.least()) {
        push(next_f_, next_);
        break;
      }
      node = next_;
    }
  }
  if (incumbent_root_ < 0) return answer;

  // 3. The way back over the roots.
  answer.status = Status::FOUND;
  answer.length = incumbent_;
  answer.points.push_back(goal.at);
  for (std::int32_t at = incumbent_root_; at >= 0; at = roots_[at].parent)
    answer.points.push_back(roots_[at].at);
  std::reverse(answer.points.begin(), answer.points.end());
  return answer;
}

}  // namespace grid_path_planner::planners
