#include "planners/any_angle/anya_search.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::planners {

using base::Statistics, base::StopToken;
using costmap::allOnes, costmap::bitAt, costmap::BitMap, costmap::oneFrom, costmap::zeroBefore,
    costmap::zeroFrom;
using grid::Cell;

namespace {

// A single successor is expanded at once, without the open list; after so many rows its f-value is
// compared with those of the open list.
constexpr int kRowsBetweenComparisons = 32;

constexpr std::uint32_t kExpansionsBetweenPolls = 16;  // an expansion may cross the whole map

// Whole where it is nearer than 2^-31 to a whole number. Precondition: |x| < 2^31.
double snapped(double x) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to whole numbers
  const double whole = (x + kRound) - kRound;
  return std::abs(x - whole) < 0x1p-31 ? whole : x;
}

int floorOf(double x) {  // of x >= 0
  return static_cast<int>(x);
}
int ceilOf(double x) {  // of x >= 0
  const int below = static_cast<int>(x);
  return below + (below < x ? 1 : 0);
}

// The bits of the word at which a flat successor along a line towards the lower (or higher) cells
// stands or ends: `a`, `b` are the rows beside the line, `a_past`, `b_past` the cells before these.
BitMap::Word events(BitMap::Word a, BitMap::Word b, BitMap::Word a_past, BitMap::Word b_past) {
  const BitMap::Word closed = ~a & ~b;
  const BitMap::Word pinch = (~a & ~b_past & a_past & b) | (~b & ~a_past & b_past & a);
  const BitMap::Word corner = a & b & (a_past ^ b_past);
  return closed | pinch | corner;
}

// The column of the next event along the line between the two rows, to the left of `column`.
int eventBefore(const BitMap::Word* above, const BitMap::Word* below, int column) {
  int word = (column - 2) >> 6;
  const int shift = 63 - ((column - 2) & 63);
  for (BitMap::Word mask = ~BitMap::Word{0} >> shift;; --word, mask = ~BitMap::Word{0}) {
    const BitMap::Word a = above[word], b = below[word];
    const BitMap::Word found =
        mask & events(a, b, a >> 1 | above[word + 1] << 63, b >> 1 | below[word + 1] << 63);
    if (found != 0) return word * 64 + 63 - __builtin_clzll(found) + 1;
  }
}

// The same to the right.
int eventFrom(const BitMap::Word* above, const BitMap::Word* below, int column) {
  int word = (column + 1) >> 6;
  const int shift = (column + 1) & 63;
  for (BitMap::Word mask = ~BitMap::Word{0} << shift;; ++word, mask = ~BitMap::Word{0}) {
    const BitMap::Word a = above[word], b = below[word];
    const BitMap::Word found =
        mask & events(a, b, a << 1 | above[word - 1] >> 63, b << 1 | below[word - 1] >> 63);
    if (found != 0) return word * 64 + __builtin_ctzll(found);
  }
}

}  // namespace

// The column of a ray after so many lines. Columns off the map are all the same.
inline double AnyaSearch::columnOf(AnyaPoint root, double ray, double lines) const {
  const double x = root.x + ray * lines;
  return snapped(std::min(std::max(x, -2.0), map_->width() + 2.0));
}

void AnyaSearch::pushBelowIncumbent(double f, const AnyaNode& node) {
  if (f < incumbent_) push(f, node);
}

// A lower bound of the length of a path through the interval to the goal: straight, or by an end of
// the interval. A goal on the root's side of the line is as far as its mirror image.
double AnyaSearch::fValue(const AnyaNode& node) const {
  const Root& root = roots_[node.root];
  const double lines = node.rows * (node.line - root.at.y);
  const double beyond = std::abs(node.line - goal_.y);
  const double slope = (goal_.x - root.at.x) / (lines + beyond);
  const bool left = slope < node.ray[LEFT];
  const bool right = slope > node.ray[RIGHT];
  const double across = goal_.x - root.at.x;
  if (!left && !right) return root.g + lengthOf(across, lines + beyond);
  const double turn = node.ray[left ? LEFT : RIGHT] * lines;
  return root.g + lengthOf(turn, lines) + lengthOf(across - turn, beyond);
}

// The root at the corner for an arrival from `parent`, -1 where the arrival is pruned.
std::int32_t AnyaSearch::rootAt(std::int32_t parent, int column, int line, Sense sense) {
  const AnyaPoint corner{double(column), double(line)};
  const double g = gThrough(parent, corner);
  if (g + distance(corner, goal_) >= incumbent_) return -1;
  const auto key = static_cast<std::uint64_t>(line) << 32 | static_cast<std::uint32_t>(column);
  return relax(corners_[key], parent, corner, g, sense);
}

void AnyaSearch::pushInterval(std::int32_t root, int line, int rows, double left, double right) {
  const AnyaNode node{{left, right}, root, line, static_cast<std::int8_t>(rows), 0};
  pushBelowIncumbent(fValue(node), node);
}

// The next corner along the line on which the root lies, if it is visible.
void AnyaSearch::flatSuccessors(std::int32_t root, int column, int line, int columns) {
  const Word* above = map_->row(line);
  const Word* below = map_->row(line - 1);
  const int next =
      columns < 0 ? eventBefore(above, below, column) : eventFrom(above, below, column);
  const int beyond = columns < 0 ? next - 1 : next;
  if (!bitAt(above, beyond) || !bitAt(below, beyond)) return;  // closed, or a pinch
  const AnyaPoint corner{double(next), double(line)};
  const double f = roots_[root].g + std::abs(roots_[root].at.x - next) + distance(goal_, corner);
  pushBelowIncumbent(f, {{corner.x, 0.0}, root, line, 0, static_cast<std::int8_t>(columns)});
}

// A corner on the root's line: the interval round it, and the next corner along the line.
void AnyaSearch::expandFlat(const AnyaNode& node) {
  const int column = static_cast<int>(node.ray[0]);
  const int passed = node.columns < 0 ? column : column - 1;
  const int rows = bitAt(map_->row(node.line), passed) ? -1 : 1;  // towards the obstacle's row
  const Sense sense = (node.columns < 0) == (rows < 0) ? ANTICLOCKWISE : CLOCKWISE;
  const std::int32_t root = rootAt(node.root, column, node.line, sense);
  if (root < 0) return;
  const Word* row = rowAhead(node.line, rows);
  const int end = node.columns < 0 ? zeroBefore(row, column) + 1 : zeroFrom(row, column);
  if (leadsToGoal(node.line, rows) && (goal_.x - column) * (goal_.x - end) <= 0.0)
    updateIncumbent(root);
  pushInterval(root, node.line + rows, rows, std::min(0, end - column), std::max(0, end - column));
  flatSuccessors(node.root, column, node.line, node.columns);
}

AnyaSearch::Projection AnyaSearch::project(const AnyaNode& node, const double* near,
                                           const double* far, int first, int last) const {
  Projection projection{{near[LEFT], near[RIGHT]},
                        {node.ray[LEFT], node.ray[RIGHT]},
                        {far[LEFT], far[RIGHT]},
                        {first, last}};
  const AnyaPoint root = roots_[node.root].at;
  const double lines = node.rows * (node.line - root.y);
  const auto narrow = [&](Side side) {
    projection.near[side] = projection.run[side];
    projection.ray[side] = (projection.run[side] - root.x) / lines;
    projection.far[side] = columnOf(root, projection.ray[side], lines + 1.0);
  };
  if (first > near[LEFT]) narrow(LEFT);
  if (last < near[RIGHT]) narrow(RIGHT);
  return projection;
}

// Precondition: the next row is the goal's.
void AnyaSearch::updateIncumbentIfVisible(const AnyaNode& node, const Projection& projection) {
  const AnyaPoint root = roots_[node.root].at;
  const double lines = std::abs(goal_.y - root.y);
  if (goal_.x < projection.run[LEFT] || goal_.x > projection.run[RIGHT]) return;
  const double slack = 0x1p-31;
  if (goal_.x < root.x + projection.ray[LEFT] * lines - slack) return;
  if (goal_.x > root.x + projection.ray[RIGHT] * lines + slack) return;
  updateIncumbent(node.root);
}

// Round the corner at one end of the projection, if there is one: the part of the run that lies
// beyond the ray, and the next corner along the line.
void AnyaSearch::turningSuccessors(const AnyaNode& node, const Projection& projection, Side side) {
  const int column = static_cast<int>(projection.near[side]);
  if (column != projection.near[side]) return;
  const int outer = side == LEFT ? column - 1 : column;
  const bool behind_open = bitAt(rowAhead(node.line, -node.rows), outer);
  const bool ahead_open = bitAt(rowAhead(node.line, node.rows), outer);
  if (behind_open == ahead_open) return;

  // The part of the run on the far line that lies beyond the ray.
  const double inner = side == LEFT ? std::min(projection.far[LEFT], double(projection.run[RIGHT]))
                                    : std::max(projection.far[RIGHT], double(projection.run[LEFT]));
  const bool room = side == LEFT ? inner > projection.run[LEFT] : inner < projection.run[RIGHT];
  if (!ahead_open && !room) return;
  const Sense sense = (side == LEFT) == (node.rows > 0) ? ANTICLOCKWISE : CLOCKWISE;
  const std::int32_t root = rootAt(node.root, column, node.line, sense);
  if (root < 0) return;
  const double outer_ray = projection.run[side] - column;
  const double inner_ray = inner == projection.far[side] ? projection.ray[side] : inner - column;
  const double left = side == LEFT ? outer_ray : inner_ray;
  const double right = side == LEFT ? inner_ray : outer_ray;
  if (leadsToGoal(node.line, node.rows)) {
    // The cell beside the line is free: in it only the ray of the arrival limits what is visible.
    Projection beyond = projection;
    beyond.ray[LEFT] =
        side == LEFT ? -std::numeric_limits<double>::infinity() : projection.ray[RIGHT];
    beyond.ray[RIGHT] =
        side == LEFT ? projection.ray[LEFT] : std::numeric_limits<double>::infinity();
    AnyaNode from = node;
    from.root = root;
    updateIncumbentIfVisible(from, beyond);
  }
  if (room) pushInterval(root, node.line + node.rows, node.rows, left, right);
  if (ahead_open) flatSuccessors(root, column, node.line, side == LEFT ? -1 : 1);
}

// Projects the interval from line to line while no blocked cell splits it and no corner touches it:
// through free rows, and along walls that hold an end in its column.
void AnyaSearch::projectThroughFreeRows(AnyaNode& node, double* near, double* far) const {
  const AnyaPoint root = roots_[node.root].at;
  const int rows = node.rows, width = map_->width();
  const int goal_line = rows > 0 ? goal_row_ : goal_row_ + 1;
  int line = node.line;
  double lines = rows * (line - root.y);
  double left_ray = node.ray[LEFT], right_ray = node.ray[RIGHT];
  double left = columnOf(root, left_ray, lines), right = columnOf(root, right_ray, lines);
  const Word* behind = rowAhead(line, -rows);
  const std::ptrdiff_t stride = rows * map_->stride();
  for (;;) {
    const Word* row = behind + stride;
    double far_left = columnOf(root, left_ray, lines + 1.0);
    double far_right = columnOf(root, right_ray, lines + 1.0);
    double next_left_ray = left_ray, next_right_ray = right_ray;
    bool clear = line != goal_line;
    const int left_column = static_cast<int>(left), right_column = static_cast<int>(right);
    if (left == left_column) {
      const bool open = bitAt(row, left_column - 1);
      if (!open && far_left < left) {
        far_left = left;
        next_left_ray = (left - root.x) / (lines + 1.0);
      } else if (open != bitAt(behind, left_column - 1)) {
        clear = false;
      }
    }
    if (right == right_column) {
      const bool open = bitAt(row, right_column);
      if (!open && far_right > right) {
        far_right = right;
        next_right_ray = (right - root.x) / (lines + 1.0);
      } else if (open != bitAt(behind, right_column)) {
        clear = false;
      }
    }
    const double least = std::min(left, far_left), most = std::max(right, far_right);
    clear = clear && least >= 0.0 && most <= width && far_left < far_right;
    if (!clear || !allOnes(row, floorOf(least), ceilOf(most))) break;
    left = far_left;
    right = far_right;
    left_ray = next_left_ray;
    right_ray = next_right_ray;
    behind = row;
    line += rows;
    lines += 1.0;
  }
  node.line = line;
  node.ray[LEFT] = left_ray;
  node.ray[RIGHT] = right_ray;
  near[LEFT] = left;
  near[RIGHT] = right;
  far[LEFT] = columnOf(root, left_ray, lines + 1.0);
  far[RIGHT] = columnOf(root, right_ray, lines + 1.0);
}

// One for each run of free cells of the next row that the interval touches. All but the last, which
// is in `last`, are pushed. Returns their number.
[[gnu::always_inline]] inline int AnyaSearch::observableSuccessors(const AnyaNode& node,
                                                                   const double* near,
                                                                   const double* far,
                                                                   AnyaNode& last) {
  const AnyaPoint root = roots_[node.root].at;
  const Word* row = rowAhead(node.line, node.rows);
  const double lines = node.rows * (node.line - root.y);
  const bool goal_row = leadsToGoal(node.line, node.rows);
  int found = 0;
  for (int column = oneFrom(row, floorOf(near[LEFT]), ceilOf(near[RIGHT])); column < near[RIGHT];) {
    const int first = zeroBefore(row, column) + 1;
    const int end = zeroFrom(row, column);
    const Projection projection = project(node, near, far, first, end);
    if (goal_row) updateIncumbentIfVisible(node, projection);
    turningSuccessors(node, projection, LEFT);
    turningSuccessors(node, projection, RIGHT);
    const double left = std::max(projection.far[LEFT], double(first));
    const double right = std::min(projection.far[RIGHT], double(end));
    if (left < right) {
      if (found++ > 0) pushBelowIncumbent(fValue(last), last);
      last = node;
      last.line += node.rows;
      last.ray[LEFT] =
          left == projection.far[LEFT] ? projection.ray[LEFT] : (left - root.x) / (lines + 1.0);
      last.ray[RIGHT] =
          right == projection.far[RIGHT] ? projection.ray[RIGHT] : (right - root.x) / (lines + 1.0);
    }
    column = oneFrom(row, end, ceilOf(near[RIGHT]));
  }
  return found;
}

void AnyaSearch::expandInterval(AnyaNode node) {
  int compared = node.line;
  for (;;) {
    double near[2], far[2];
    projectThroughFreeRows(node, near, far);
    if (std::abs(node.line - compared) >= kRowsBetweenComparisons) {
      const double f = fValue(node);
      if (f >= incumbent_ || (!open_.empty() && f > open_.least()))
        return pushBelowIncumbent(f, node);
      compared = node.line;
    }
    AnyaNode successor{};
    const int found = observableSuccessors(node, near, far, successor);
    if (found == 0) return;
    if (found > 1) return pushBelowIncumbent(fValue(successor), successor);
    node = successor;
  }
}

void AnyaSearch::expand(const AnyaNode& node) {
  if (node.rows == 0)
    expandFlat(node);
  else
    expandInterval(node);
}

// The cell of an expansion in pictures.
Cell AnyaSearch::cellOf(const AnyaNode& node) const {
  const int column = static_cast<int>(roots_[node.root].at.x);
  return {std::min(column, map_->width() - 1),
          std::min(std::max(node.line, 0), map_->height() - 1)};
}

// The start's run of cells is visible, and the rows above and below through its edges.
void AnyaSearch::pushStartIntervals(AnyaPoint start) {
  const int start_row = floorOf(start.y);
  const Word* row = map_->row(start_row);
  const int first = zeroBefore(row, floorOf(start.x)) + 1;
  const int last = zeroFrom(row, floorOf(start.x));
  if (goal_row_ == start_row && first < goal_.x && goal_.x < last) updateIncumbent(0);
  const double up = start_row + 1 - start.y, down = start.y - start_row;
  pushInterval(0, start_row + 1, 1, (first - start.x) / up, (last - start.x) / up);
  pushInterval(0, start_row, -1, (first - start.x) / down, (last - start.x) / down);
}

AnyaSearch::Answer AnyaSearch::run(const BitMap& rows, AnyaPoint start, AnyaPoint goal,
                                   const StopToken& stop, Statistics& counts,
                                   std::vector<Cell>* expanded) {
  startQuery(start, goal, counts);
  map_ = &rows;
  goal_row_ = floorOf(goal.y);
  corners_.clear();
  pushStartIntervals(start);
  return expandAll(
      stop, kExpansionsBetweenPolls, [this](AnyaNode& node) { return popNode(node); },
      [this, expanded](const AnyaNode& node) {
        if (expanded) expanded->push_back(cellOf(node));
        expand(node);
      });
}

}  // namespace grid_path_planner::planners
