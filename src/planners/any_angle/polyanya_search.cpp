#include "planners/any_angle/polyanya_search.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::planners {

using base::Statistics, base::StopToken;

namespace {

// A single successor is expanded at once, without the open list; after so many borders its f-value
// is compared with those of the open list.
constexpr int kBordersBetweenComparisons = 32;

constexpr std::uint32_t kExpansionsBetweenPolls = 64;

}  // namespace

std::size_t PolyanyaSearch::bytes() const {
  return IntervalSearch::bytes() + corner_roots_.bytes() + projection_.bytes();
}

// The successor with the least f-value need not pass through the open list.
inline void PolyanyaSearch::keepBestSuccessor(double f, const PolyanyaNode& node) {
  if (f >= incumbent_) return;
  if (has_next_ && f >= next_f_) return push(f, node);
  if (has_next_) push(next_f_, next_);
  has_next_ = true;
  next_f_ = f;
  next_ = node;
}

// A lower bound of the length of a path through the interval to the goal: straight, or by an end of
// the part of the far side that is visible. A goal on the root's side of the far line is as far as
// its mirror image.
double PolyanyaSearch::fValue(const PolyanyaNode& node) const {
  const Root& root = roots_[node.root];
  const PolyanyaMesh::Rectangle& rect = mesh_->rectangle(node.place);
  const std::int64_t far = rect.line[node.heading];
  const std::int64_t lines = std::abs(far - root.at.y), beyond = std::abs(far - goal_.y);
  const std::int64_t columns = std::int64_t{goal_.x} - root.at.x;
  double crossing;  // columns from the root, on the far line
  const MeshRay west = node.ray[Direction::WEST], east = node.ray[Direction::EAST];
  const auto along = [lines](MeshRay ray) { return double(ray.columns) * lines / ray.lines; };
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

// The g-value of the corner on a path that turns last at `parent`, none where a smaller one is known
// or the path is no shorter than the incumbent.
inline std::optional<double> PolyanyaSearch::gAt(std::int32_t parent, std::uint32_t corner) const {
  const MeshPoint at = mesh_->corner(corner).at;
  const double g = gThrough(parent, at);
  const std::int32_t* known = corner_roots_.find(corner);
  if (known && g > roots_[*known].g * (1.0 + kTie)) return std::nullopt;
  if (g + distance(at, goal_) >= incumbent_) return std::nullopt;
  return g;
}

// The root at the corner for an arrival from `parent`, -1 where the arrival is pruned.
std::int32_t PolyanyaSearch::rootAt(std::int32_t parent, std::uint32_t corner, double g,
                                    Sense sense) {
  if (!corner_roots_.contains(corner)) corner_roots_.set(corner, -1);
  return relax(corner_roots_[corner], parent, mesh_->corner(corner).at, g, sense);
}

// Precondition: the node is in the goal's rectangle.
void PolyanyaSearch::updateIncumbentIfVisible(const PolyanyaNode& node) {
  const MeshPoint root = roots_[node.root].at;
  const std::int64_t columns = std::int64_t{goal_.x} - root.x;
  const std::int64_t lines = std::abs(std::int64_t{goal_.y} - root.y);
  if (eastOf(node.ray[Direction::WEST], columns, lines) >= 0 &&
      eastOf(node.ray[Direction::EAST], columns, lines) <= 0)
    updateIncumbent(node.root);
}

// The next corner along the line on which the root lies.
void PolyanyaSearch::flatSuccessors(std::int32_t root, std::uint32_t corner, Direction direction) {
  const std::uint32_t next = mesh_->corner(corner).along[direction];
  if (next == PolyanyaMesh::kNone) return;
  const MeshPoint at = mesh_->corner(next).at;
  const double f = gThrough(root, at) + distance(at, goal_);
  keepBestSuccessor(f, {{}, root, next, {}, static_cast<std::int8_t>(direction)});
}

// Projected before it is pushed, until it is split or can turn: many have no successor.
void PolyanyaSearch::keepProjectedSuccessor(PolyanyaNode node) {
  Projection::FarSide far;
  int borders = kBordersBetweenComparisons;
  const Projection::End end = projection_.project(roots_[node.root].at, node, far, borders);
  if (end == Projection::End::GOAL) return updateIncumbentIfVisible(node);
  if (end != Projection::End::NO_SUCCESSOR) keepBestSuccessor(fValue(node), node);
}

// A corner on the root's line: the interval round it, and the next corner along the line.
void PolyanyaSearch::expandFlat(const PolyanyaNode& node) {
  const PolyanyaMesh::Corner& corner = mesh_->corner(node.place);
  const bool east = node.along == Direction::EAST;
  const bool blocked_east = corner.quarter == 0 || corner.quarter == 3;
  if (blocked_east != east && projection_.allowed(corner.block)) {
    const bool north = corner.quarter < 2;  // towards the obstacle's rows
    const std::optional<double> g = gAt(node.root, node.place);
    if (!g) return;
    const std::int32_t root =
        rootAt(node.root, node.place, *g, east == north ? ANTICLOCKWISE : CLOCKWISE);
    if (root < 0) return;
    PolyanyaNode interval{
        {{-1, 0}, {0, 1}}, root, corner.rectangle[north], Heading(north), PolyanyaNode::kInterval};
    if (east) {
      interval.ray[Direction::WEST] = {0, 1};
      interval.ray[Direction::EAST] = {1, 0};
    }
    keepProjectedSuccessor(interval);
  }
  flatSuccessors(node.root, node.place, static_cast<Direction>(node.along));
}

// Round the corner at one end of a border, if that has a successor.
void PolyanyaSearch::turningSuccessors(const PolyanyaNode& node, const PolyanyaMesh::Border& border,
                                       Direction direction) {
  const std::uint32_t corner = border.corner[direction];
  const std::optional<double> g = gAt(node.root, corner);
  if (!g) return;
  const MeshPoint at = mesh_->corner(corner).at;
  const MeshPoint arrival = at - roots_[node.root].at;
  const bool north = node.heading == Heading::NORTHWARDS, east = direction == Direction::EAST;
  PolyanyaNode turned = node;
  turned.place = border.to;
  turned.ray[direction] = PolyanyaMesh::behind(mesh_->rectangle(node.place), border, direction)
                              ? MeshRay{east ? 1 : -1, 0}
                              : MeshRay{0, 1};
  turned.ray[1 - direction] = {arrival.x, std::abs(arrival.y)};
  Projection::FarSide far;
  int borders = kBordersBetweenComparisons;
  const Projection::End end = projection_.project(at, turned, far, borders);
  if (end == Projection::End::NO_SUCCESSOR && !border.leads_on[direction]) return;
  turned.root = rootAt(node.root, corner, *g, east == north ? CLOCKWISE : ANTICLOCKWISE);
  if (turned.root < 0) return;
  if (end == Projection::End::GOAL)
    updateIncumbentIfVisible(turned);
  else if (end != Projection::End::NO_SUCCESSOR)
    keepBestSuccessor(fValue(turned), turned);
  if (border.leads_on[direction]) flatSuccessors(turned.root, corner, direction);
}

// The successor through a border. Adds the turning successors at the ends of the border.
[[gnu::always_inline]] inline PolyanyaNode PolyanyaSearch::successorBeyond(
    const PolyanyaNode& node, std::int32_t lines, const PolyanyaMesh::Border& border) {
  const PolyanyaMesh::Rectangle& rect = mesh_->rectangle(node.place);
  const std::int32_t root = roots_[node.root].at.x;
  const std::int32_t west = border.west - root, east = border.east - root;
  const std::int64_t west_end = eastOf(node.ray[Direction::WEST], west, lines);
  const std::int64_t east_end = eastOf(node.ray[Direction::EAST], east, lines);
  PolyanyaNode successor = node;
  successor.place = border.to;
  if (west_end > 0) successor.ray[Direction::WEST] = {west, lines};
  if (east_end < 0) successor.ray[Direction::EAST] = {east, lines};
  for (const Direction direction : {Direction::WEST, Direction::EAST}) {
    const bool touches = direction == Direction::WEST ? west_end >= 0 : east_end <= 0;
    const std::int32_t columns = direction == Direction::WEST ? west : east;
    if (touches && projection_.turns(rect, border, direction, node.heading, columns, lines))
      turningSuccessors(node, border, direction);
  }
  return successor;
}

// One for each border of the far side that is visible and allowed. All but the last, which is in
// `last`, are kept. Returns their number.
[[gnu::always_inline]] inline int PolyanyaSearch::observableSuccessors(
    const PolyanyaNode& node, const Projection::FarSide& far, PolyanyaNode& last) {
  const std::int32_t root = roots_[node.root].at.x;
  int found = 0;
  for (std::uint32_t i = far.first; i < far.end; ++i) {
    const PolyanyaMesh::Border& border = mesh_->border(i);
    if (eastOf(node.ray[Direction::EAST], border.west - root, far.lines) >= 0) break;
    if (!projection_.allowed(border)) continue;
    if (found++ > 0) keepProjectedSuccessor(last);
    last = successorBeyond(node, far.lines, border);
  }
  return found;
}

void PolyanyaSearch::expandInterval(PolyanyaNode node) {
  const MeshPoint root = roots_[node.root].at;
  int borders = kBordersBetweenComparisons;
  for (;;) {
    Projection::FarSide far;
    const Projection::End end = projection_.project(root, node, far, borders);
    if (end == Projection::End::NO_SUCCESSOR) return;
    if (end == Projection::End::GOAL) return updateIncumbentIfVisible(node);
    if (end == Projection::End::BORDERS) {
      PolyanyaNode successor{};
      const int found = observableSuccessors(node, far, successor);
      if (found == 0) return;
      if (found > 1) return keepProjectedSuccessor(successor);
      node = successor;
      --borders;
      continue;
    }
    const double f = fValue(node);
    if (f >= incumbent_) return;
    if (!open_.empty() && f > open_.least()) return push(f, node);
    borders = kBordersBetweenComparisons;
  }
}

void PolyanyaSearch::expand(const PolyanyaNode& node) {
  if (node.flat())
    expandFlat(node);
  else
    expandInterval(node);
}

// The best successor of the node before, or the open list's.
bool PolyanyaSearch::nextNode(PolyanyaNode& node) {
  if (has_next_) {
    has_next_ = false;
    if (next_f_ < incumbent_ && (open_.empty() || next_f_ <= open_.least())) {
      node = next_;
      return true;
    }
    if (next_f_ < incumbent_) push(next_f_, next_);
  }
  return popNode(node);
}

// False where no path leads to the goal.
bool PolyanyaSearch::startQuery(const PolyanyaMesh& mesh, const End& start, const End& goal,
                                Statistics& counts) {
  IntervalSearch::startQuery(start.at, goal.at, counts);
  mesh_ = &mesh;
  has_next_ = false;
  if (corner_roots_.size() != mesh.corners())
    corner_roots_ = StampedArray<std::int32_t>(mesh.corners());
  corner_roots_.clear();
  return projection_.startQuery(mesh, start.rectangle, goal.rectangle);
}

// What is visible from the start through both far sides of its rectangle.
void PolyanyaSearch::pushStartIntervals(const End& start) {
  const PolyanyaMesh::Rectangle& rect = mesh_->rectangle(start.rectangle);
  const std::int32_t west = rect.west - start.at.x, east = rect.east - start.at.x;
  for (const Heading heading : {Heading::SOUTHWARDS, Heading::NORTHWARDS}) {
    const std::int32_t lines = std::abs(rect.line[heading] - start.at.y);
    const PolyanyaNode node{
        {{west, lines}, {east, lines}}, 0, start.rectangle, heading, PolyanyaNode::kInterval};
    push(fValue(node), node);
  }
}

PolyanyaSearch::Answer PolyanyaSearch::run(const PolyanyaMesh& mesh, End start, End goal,
                                           const StopToken& stop, Statistics& counts,
                                           std::vector<std::uint32_t>* expanded) {
  if (!startQuery(mesh, start, goal, counts)) return Answer();
  if (start.rectangle == goal.rectangle)
    updateIncumbent(0);
  else
    pushStartIntervals(start);
  return expandAll(
      stop, kExpansionsBetweenPolls, [this](PolyanyaNode& node) { return nextNode(node); },
      [this, expanded](const PolyanyaNode& node) {
        if (expanded)
          expanded->push_back(node.flat() ? mesh_->corner(node.place).rectangle[0] : node.place);
        expand(node);
      });
}

}  // namespace grid_path_planner::planners
