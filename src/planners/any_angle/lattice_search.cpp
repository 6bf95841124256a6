#include "planners/any_angle/lattice_search.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::planners {

using base::Statistics;
using base::StopToken;
using costmap::bitAt;
using costmap::CostGrid;
using costmap::oneFrom;
using costmap::SegmentPoint;
using costmap::waypointOf;
using costmap::zeroBefore;
using costmap::zeroFrom;
using grid::Cell;

namespace {

// A single successor is expanded at once, without the open list; after so many rows its f-value is
// compared with those of the open list.
constexpr int kRowsBetweenComparisons = 32;

constexpr std::uint32_t kExpansionsBetweenPolls = 16;  // an expansion may cross the whole map

// Whether ray a points farther to the left than b.
bool leftOf(LatticeRay a, LatticeRay b) {
  return a.x * b.y < b.x * a.y;
}

std::uint64_t keyOf(int column, int line) {
  return static_cast<std::uint64_t>(line) << 32 | static_cast<std::uint32_t>(column);
}

}  // namespace

LatticeSearch::LatticeSearch(const CostGrid& map) {
  for (int column = 0; column < map.geometry().width(); ++column)
    xs_.push_back(waypointOf(map, {column, 0}).x);
  for (int row = 0; row < map.geometry().height(); ++row)
    ys_.push_back(waypointOf(map, {0, row}).y);
}

// A lower bound of the length of a path through the interval to the goal: straight, or by an end of
// the interval. A goal on the root's side of the line is as far as its mirror image.
double LatticeSearch::fValue(const LatticeNode& node) const {
  const Root& root = roots_[node.root];
  const double lines = double(height(node, node.line));
  const double beyond = std::abs(double(ys_[node.line] - goal_.y));
  const double across = double(goal_.x - root.at.x);
  const auto column = [&](Side side) {
    return double(node.ray[side].x) / double(node.ray[side].y) * lines;
  };
  const double straight = across * lines / (lines + beyond);
  const double turn = std::min(std::max(straight, column(LEFT)), column(RIGHT));
  return root.g + lengthOf(turn, lines) + lengthOf(across - turn, beyond);
}

void LatticeSearch::pushInterval(const LatticeNode& node) {
  const double f = fValue(node);
  if (f < incumbent_) push(f, node);
}

// The root at the corner for an arrival from `parent`, -1 where the arrival is pruned.
std::int32_t LatticeSearch::rootAt(std::int32_t parent, int column, int line, Sense sense) {
  const LatticePoint corner = at(column, line);
  const double g = gThrough(parent, corner);
  if (g + distance(corner, goal_) >= incumbent_) return -1;
  return relax(corners_[keyOf(column, line)], parent, corner, g, sense);
}

// ---- points

// A point is visible from `root`.
void LatticeSearch::reach(std::int32_t root, int column, int line) {
  if (goal_cell_ == Cell{column, line}) return updateIncumbent(root);
  if (bitAt(bits_->portals.row(line), column)) reachPoint(root, column, line);
}

// All points of the line from column `first` to `last` are.
void LatticeSearch::reachBetween(std::int32_t root, int line, int first, int last) {
  if (line == goal_cell_.row && first <= goal_cell_.column && goal_cell_.column <= last)
    updateIncumbent(root);
  const Word* portals = bits_->portals.row(line);
  for (int column = oneFrom(portals, first, last + 1); column <= last;
       column = oneFrom(portals, column + 1, last + 1))
    reach(root, column, line);
}

void LatticeSearch::reachPoint(std::int32_t parent, int column, int line) {
  const LatticePoint point = at(column, line);
  const double g = gThrough(parent, point);
  const double f = g + distance(point, goal_);
  if (f >= incumbent_) return;
  std::int32_t& known = points_[keyOf(column, line)];
  if (known >= 0) {
    if (g >= roots_[known].g * (1.0 - kTie)) return;
    roots_[known].superseded = true;
    ++counts_->reopened;
  }
  known = static_cast<std::int32_t>(roots_.size());
  roots_.push_back({point, g, parent, {-1, -1}, false});
  push(f, {{}, known, line, column, 0});
}

// What is visible from a point through the squares that touch it in one heading.
void LatticeSearch::pushAround(std::int32_t root, int column, int line, int heading) {
  const Word* row = rowAhead(line, heading);
  const bool to_the_left = bitAt(row, column - 1), to_the_right = bitAt(row, column);
  if (!to_the_left && !to_the_right) return;
  const int first = to_the_left ? zeroBefore(row, column) + 1 : column;
  const int last = to_the_right ? zeroFrom(row, column) : column;
  const int next = line + heading;
  const std::int64_t lines = std::abs(ys_[next] - ys_[line]);
  pushInterval({{{xs_[first] - xs_[column], lines}, {xs_[last] - xs_[column], lines}},
                root,
                next,
                0,
                static_cast<std::int8_t>(heading)});
}

void LatticeSearch::followThinEdges(std::int32_t root, int column, int line) {
  const Word *upper = bits_->squares.row(line), *lower = bits_->squares.row(line - 1);
  const bool ne = bitAt(upper, column), nw = bitAt(upper, column - 1);
  const bool se = bitAt(lower, column), sw = bitAt(lower, column - 1);
  const auto follow = [&](bool squares, int to_column, int to_line) {
    if (!squares && (*passable_)[Cell{to_column, to_line}]) {
      if (goal_cell_ == Cell{to_column, to_line})
        updateIncumbent(root);
      else
        reachPoint(root, to_column, to_line);
    }
  };
  follow(ne || se, column + 1, line);
  follow(nw || sw, column - 1, line);
  follow(ne || nw, column, line + 1);
  follow(se || sw, column, line - 1);
}

void LatticeSearch::expandPoint(const LatticeNode& node) {
  pushAround(node.root, node.column, node.line, 1);
  pushAround(node.root, node.column, node.line, -1);
  followLine(node.root, node.column, node.line, 1);
  followLine(node.root, node.column, node.line, -1);
  followThinEdges(node.root, node.column, node.line);
}

// ---- lines through rows of points

// The points on the root's line in one direction, as far as squares lie along it; at a corner the
// path may turn towards the obstacle behind it.
void LatticeSearch::followLine(std::int32_t root, int column, int line, int columns) {
  const Word *upper = bits_->squares.row(line), *lower = bits_->squares.row(line - 1);
  const int past = columns > 0 ? 0 : -1;  // from a point to the square beyond it
  bool above = bitAt(upper, column + past), below = bitAt(lower, column + past);
  while (above || below) {
    column += columns;
    reach(root, column, line);
    const bool next_above = bitAt(upper, column + past), next_below = bitAt(lower, column + past);
    if (next_above && next_below && above != below)
      turnOnLine(root, column, line, columns, above ? -1 : 1);
    const bool meeting = above != below && next_above != next_below && above != next_above;
    if (meeting) return;  // a portal
    above = next_above;
    below = next_below;
  }
}

void LatticeSearch::turnOnLine(std::int32_t parent, int column, int line, int columns,
                               int heading) {
  const Sense sense = (columns < 0) == (heading < 0) ? ANTICLOCKWISE : CLOCKWISE;
  const std::int32_t root = rootAt(parent, column, line, sense);
  if (root < 0) return;
  const Word* row = rowAhead(line, heading);
  const int end = columns < 0 ? zeroBefore(row, column) + 1 : zeroFrom(row, column);
  const int next = line + heading;
  const std::int64_t lines = std::abs(ys_[next] - ys_[line]);
  const std::int64_t across = xs_[end] - xs_[column];
  pushInterval(
      {{{std::min<std::int64_t>(0, across), lines}, {std::max<std::int64_t>(0, across), lines}},
       root,
       next,
       0,
       static_cast<std::int8_t>(heading)});
}

// ---- intervals

// The first column of points in the interval, right of its left ray or on it.
int LatticeSearch::firstColumn(const LatticeNode& node) const {
  const LatticePoint root = roots_[node.root].at;
  const LatticeRay ray = node.ray[LEFT];
  const std::int64_t lines = height(node, node.line);
  const auto outside = [&](int column) { return (xs_[column] - root.x) * ray.y < ray.x * lines; };
  const double estimate = (double(root.x) + double(ray.x) / double(ray.y) * double(lines)) /
                          SegmentPoint::kUnitsPerCell;
  const int last = static_cast<int>(xs_.size()) - 1;
  int column = std::clamp(static_cast<int>(estimate), 0, last);
  while (column > 0 && !outside(column - 1)) --column;
  while (column <= last && outside(column)) ++column;
  return column;
}

// The last one, left of its right ray or on it.
int LatticeSearch::lastColumn(const LatticeNode& node) const {
  const LatticePoint root = roots_[node.root].at;
  const LatticeRay ray = node.ray[RIGHT];
  const std::int64_t lines = height(node, node.line);
  const auto outside = [&](int column) { return (xs_[column] - root.x) * ray.y > ray.x * lines; };
  const double estimate = (double(root.x) + double(ray.x) / double(ray.y) * double(lines)) /
                          SegmentPoint::kUnitsPerCell;
  const int last = static_cast<int>(xs_.size()) - 1;
  int column = std::clamp(static_cast<int>(estimate), 0, last);
  while (column < last && !outside(column + 1)) ++column;
  while (column >= 0 && outside(column)) --column;
  return column;
}

// The run of squares that holds the square right of `column`; `first` and `last`: the columns in the
// interval.
LatticeSearch::Run LatticeSearch::runAt(const LatticeNode& node, int column, int first,
                                        int last) const {
  const Word* row = rowAhead(node.line, node.heading);
  const LatticePoint root = roots_[node.root].at;
  const std::int64_t lines = height(node, node.line);
  Run run{zeroBefore(row, column) + 1,
          zeroFrom(row, column),
          {kNone, kNone},
          {node.ray[LEFT], node.ray[RIGHT]}};
  const auto through = [&](int point) { return LatticeRay{xs_[point] - root.x, lines}; };
  const auto on = [&](int point, Side side) {
    const LatticeRay ray = through(point);
    return !leftOf(ray, node.ray[side]) && !leftOf(node.ray[side], ray);
  };
  if (run.first >= first) {
    run.corner[LEFT] = run.first;
    run.ray[LEFT] = through(run.first);
  } else if (on(first, LEFT)) {
    run.corner[LEFT] = first;
  }
  if (run.last <= last) {
    run.corner[RIGHT] = run.last;
    run.ray[RIGHT] = through(run.last);
  } else if (on(last, RIGHT)) {
    run.corner[RIGHT] = last;
  }
  return run;
}

// The part of the next line that is visible through the run; false where there is none.
bool LatticeSearch::beyond(const LatticeNode& node, const Run& run, LatticeNode& successor) const {
  const LatticePoint root = roots_[node.root].at;
  const int next = node.line + node.heading;
  const std::int64_t lines = height(node, next);
  successor = node;
  successor.line = next;
  const LatticeRay first{xs_[run.first] - root.x, lines}, last{xs_[run.last] - root.x, lines};
  successor.ray[LEFT] = leftOf(run.ray[LEFT], first) ? first : run.ray[LEFT];
  successor.ray[RIGHT] = leftOf(last, run.ray[RIGHT]) ? last : run.ray[RIGHT];
  return leftOf(successor.ray[LEFT], successor.ray[RIGHT]);
}

// Round the corner at one end of the interval in a run, if there is one: the part of the run that
// lies beyond the ray, and the points along the line.
void LatticeSearch::turn(const LatticeNode& node, const Run& run, Side side) {
  const int column = run.corner[side];
  if (column == kNone) return;
  const int outer = side == LEFT ? column - 1 : column;
  const bool behind_open = bitAt(rowAhead(node.line, -node.heading), outer);
  const bool ahead_open = bitAt(rowAhead(node.line, node.heading), outer);
  if (behind_open == ahead_open) return;

  const int next = node.line + node.heading;
  const std::int64_t lines = std::abs(ys_[next] - ys_[node.line]);
  LatticeNode turned = node;
  turned.line = next;
  turned.ray[LEFT] = {xs_[run.first] - xs_[column], lines};
  turned.ray[RIGHT] = {xs_[run.last] - xs_[column], lines};
  const LatticeRay arrival{xs_[column] - roots_[node.root].at.x, height(node, node.line)};
  LatticeRay& inner = turned.ray[side == LEFT ? RIGHT : LEFT];
  if (side == LEFT ? leftOf(arrival, inner) : leftOf(inner, arrival)) inner = arrival;
  const bool room = leftOf(turned.ray[LEFT], turned.ray[RIGHT]);
  if (!ahead_open && !room) return;
  const Sense sense = (side == LEFT) == (node.heading > 0) ? ANTICLOCKWISE : CLOCKWISE;
  turned.root = rootAt(node.root, column, node.line, sense);
  if (turned.root < 0) return;
  if (room) pushInterval(turned);
  if (ahead_open) followLine(turned.root, column, node.line, side == LEFT ? -1 : 1);
}

// One for each run of squares of the next row that the interval touches. All but the last, which is
// in `last`, are pushed. Returns their number.
int LatticeSearch::successors(const LatticeNode& node, LatticeNode& last) {
  const int first_column = firstColumn(node), last_column = lastColumn(node);
  reachBetween(node.root, node.line, first_column, last_column);
  const Word* row = rowAhead(node.line, node.heading);
  const int end = std::min(last_column + 1, static_cast<int>(xs_.size()) - 1);
  int found = 0;
  for (int column = oneFrom(row, std::max(0, first_column - 1), end); column < end;) {
    const Run run = runAt(node, column, first_column, last_column);
    column = oneFrom(row, run.last, end);
    if (!leftOf(run.ray[LEFT], run.ray[RIGHT])) continue;  // it touches the interval's end only
    turn(node, run, LEFT);
    turn(node, run, RIGHT);
    LatticeNode successor;
    if (!beyond(node, run, successor)) continue;
    if (found++ > 0) pushInterval(last);
    last = successor;
  }
  return found;
}

void LatticeSearch::expandInterval(LatticeNode node) {
  int compared = node.line;
  for (;;) {
    LatticeNode successor;
    const int found = successors(node, successor);
    if (found == 0) return;
    if (found > 1) return pushInterval(successor);
    node = successor;
    if (std::abs(node.line - compared) < kRowsBetweenComparisons) continue;
    const double f = fValue(node);
    if (f >= incumbent_) return;
    if (!open_.empty() && f > open_.least()) return push(f, node);
    compared = node.line;
  }
}

void LatticeSearch::expand(const LatticeNode& node) {
  if (node.heading == 0)
    expandPoint(node);
  else
    expandInterval(node);
}

LatticeSearch::Answer LatticeSearch::run(const costmap::BitMap& passable, const LatticeBits& bits,
                                         Cell start, Cell goal, const StopToken& stop,
                                         Statistics& counts, std::vector<Cell>* expanded) {
  startQuery(at(start.column, start.row), at(goal.column, goal.row), counts);
  passable_ = &passable;
  bits_ = &bits;
  goal_cell_ = goal;
  corners_.clear();
  points_.clear();
  points_[keyOf(start.column, start.row)] = 0;
  push(distance(roots_[0].at, goal_), {{}, 0, start.row, start.column, 0});
  return expandAll(
      stop, kExpansionsBetweenPolls, [this](LatticeNode& node) { return popNode(node); },
      [this, expanded](const LatticeNode& node) {
        if (expanded)
          expanded->push_back(
              {static_cast<int>(roots_[node.root].at.x / SegmentPoint::kUnitsPerCell), node.line});
        expand(node);
      });
}

}  // namespace grid_path_planner::planners
