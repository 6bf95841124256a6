#include "planners/any_angle/anya_search.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::planners {

using base::Statistics;
using base::Status;
using base::Stopped;
using base::StopPoll;
using base::StopReason;
using base::StopToken;
using costmap::allOnes;
using costmap::bitAt;
using costmap::BitMap;
using costmap::oneFrom;
using costmap::zeroBefore;
using costmap::zeroFrom;
using grid::Cell;

namespace {

// A cone that goes on alone is not put back into the open list row by row, but it may not run away
// from more promising ones either.
constexpr int kRowsUnjudged = 32;

constexpr double kTie = 1e-12;  // relative: sums of the same lengths in another order

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

// Which of the bits of the word are corners or ends of a walk along a line towards the lower (or
// higher) cells: `a`, `b` are the rows beside the line, `a_past`, `b_past` the cells before these.
BitMap::Word events(BitMap::Word a, BitMap::Word b, BitMap::Word a_past, BitMap::Word b_past) {
  const BitMap::Word closed = ~a & ~b;
  const BitMap::Word pinch = (~a & ~b_past & a_past & b) | (~b & ~a_past & b_past & a);
  const BitMap::Word corner = a & b & (a_past ^ b_past);
  return closed | pinch | corner;
}

}  // namespace

// Where a ray is after so many lines; off the map it does not matter where.
inline double AnyaSearch::reach(const Point& root, double ray, double lines) const {
  const double x = root.x + ray * lines;
  return snapped(std::min(std::max(x, -2.0), map_->width() + 2.0));
}

inline double AnyaSearch::distance(const Point& a, double x, double y) const {
  return std::sqrt((a.x - x) * (a.x - x) + (a.y - y) * (a.y - y));
}

std::size_t AnyaSearch::bytes() const {
  return roots_.size() * sizeof(Root) + corners_.bytes() + open_.bytes();
}

void AnyaSearch::push(double f, const Node& node) {
  if (f >= incumbent_) return;
  open_.push(f, node);
  ++counts_->generated;
}

void AnyaSearch::updateIncumbent(std::int32_t root) {
  const double length = roots_[root].g + distance(roots_[root].at, goal_.x, goal_.y);
  if (length >= incumbent_) return;
  incumbent_ = length;
  incumbent_root_ = root;
}

// The least length of a way through the cone to the goal: straight, or round an end of the
// interval; a goal on the root's side of the line is as far as its mirror image.
double AnyaSearch::fValue(const Node& cone) const {
  const Root& root = roots_[cone.root];
  const double lines = cone.rows * (cone.line - root.at.y);
  const double beyond = std::abs(cone.line - goal_.y);
  const double slope = (goal_.x - root.at.x) / (lines + beyond);
  const bool left = slope<cone.ray[LEFT], right = slope> cone.ray[RIGHT];
  const double across = goal_.x - root.at.x;
  if (!left && !right)
    return root.g + std::sqrt(across * across + (lines + beyond) * (lines + beyond));
  const double turn = cone.ray[left ? LEFT : RIGHT] * lines;
  return root.g + std::sqrt(turn * turn + lines * lines) +
         std::sqrt((across - turn) * (across - turn) + beyond * beyond);
}

// A root at the corner for an arrival from `parent`, -1 where a better or wider one was there.
std::int32_t AnyaSearch::relax(std::int32_t parent, int column, int line, Sense sense) {
  const Root& from = roots_[parent];
  const Point corner{double(column), double(line)};
  const double g = from.g + distance(from.at, corner.x, corner.y);
  if (g + distance(corner, goal_.x, goal_.y) >= incumbent_) return -1;
  const auto key = static_cast<std::uint64_t>(line) << 32 | static_cast<std::uint32_t>(column);
  std::int32_t& known = corners_[key];
  if (known >= 0) {
    Root& root = roots_[known];
    if (g > root.g * (1.0 + kTie)) return -1;
    if (g >= root.g * (1.0 - kTie)) {
      std::int32_t& widest = root.widest[sense];
      if (widest >= 0) {
        const Point& other = roots_[widest].at;
        const double cross = (corner.x - other.x) * (corner.y - from.at.y) -
                             (corner.y - other.y) * (corner.x - from.at.x);
        if (sense == ANTICLOCKWISE ? cross >= 0.0 : cross <= 0.0) return -1;
      }
      widest = parent;
      return known;
    }
    root.beaten = true;
    ++counts_->reopened;
  }
  known = static_cast<std::int32_t>(roots_.size());
  Root root{corner, g, parent, {-1, -1}, false};
  root.widest[sense] = parent;
  roots_.push_back(root);
  return known;
}

void AnyaSearch::pushInterval(std::int32_t root, int line, int rows, double left, double right) {
  const Node cone{{left, right}, root, line, static_cast<std::int8_t>(rows), 0};
  push(fValue(cone), cone);
}

// The next corner along the line, seen from the root, which lies on it.
void AnyaSearch::flatSuccessors(std::int32_t root, int column, int line, int columns) {
  const Word* above = map_->row(line);
  const Word* below = map_->row(line - 1);
  int next = 0;
  if (columns < 0) {
    int word = (column - 2) >> 6;
    const int shift = 63 - ((column - 2) & 63);
    Word mask = ~Word{0} >> shift;
    for (;; --word, mask = ~Word{0}) {
      const Word a = above[word], b = below[word];
      const Word found =
          mask & events(a, b, a >> 1 | above[word + 1] << 63, b >> 1 | below[word + 1] << 63);
      if (found == 0) continue;
      next = word * 64 + 63 - __builtin_clzll(found) + 1;
      break;
    }
  } else {
    int word = (column + 1) >> 6;
    Word mask = ~Word{0} << ((column + 1) & 63);
    for (;; ++word, mask = ~Word{0}) {
      const Word a = above[word], b = below[word];
      const Word found =
          mask & events(a, b, a << 1 | above[word - 1] >> 63, b << 1 | below[word - 1] >> 63);
      if (found == 0) continue;
      next = word * 64 + __builtin_ctzll(found);
      break;
    }
  }
  const int beyond = columns < 0 ? next - 1 : next;
  if (!bitAt(above, beyond) || !bitAt(below, beyond)) return;  // closed, or a pinch
  const double f =
      roots_[root].g + std::abs(roots_[root].at.x - next) + distance(goal_, next, line);
  push(f, {{double(next), 0.0}, root, line, 0, static_cast<std::int8_t>(columns)});
}

// A corner met along the line: round it, and on along the line.
void AnyaSearch::expandCorner(const Node& node) {
  const int column = static_cast<int>(node.ray[0]);
  const int passed = node.columns < 0 ? column : column - 1;
  const int rows = bitAt(map_->row(node.line), passed) ? -1 : 1;  // towards the obstacle's row
  const Sense sense = (node.columns < 0) == (rows < 0) ? ANTICLOCKWISE : CLOCKWISE;
  const std::int32_t root = relax(node.root, column, node.line, sense);
  if (root < 0) return;
  const Word* row = ahead(node.line, rows);
  const int end = node.columns < 0 ? zeroBefore(row, column) + 1 : zeroFrom(row, column);
  if (leadsToGoal(node.line, rows) && (goal_.x - column) * (goal_.x - end) <= 0.0)
    updateIncumbent(root);
  pushInterval(root, node.line + rows, rows, std::min(0, end - column), std::max(0, end - column));
  flatSuccessors(node.root, column, node.line, node.columns);
}

AnyaSearch::Projection AnyaSearch::project(const Node& cone, const double* near, const double* far,
                                           int first, int last) const {
  Projection gate{{near[LEFT], near[RIGHT]},
                  {cone.ray[LEFT], cone.ray[RIGHT]},
                  {far[LEFT], far[RIGHT]},
                  {first, last}};
  const Point& root = roots_[cone.root].at;
  const double lines = cone.rows * (cone.line - root.y);
  const auto narrow = [&](Side side) {
    gate.near[side] = gate.run[side];
    gate.ray[side] = (gate.run[side] - root.x) / lines;
    gate.far[side] = reach(root, gate.ray[side], lines + 1.0);
  };
  if (first > near[LEFT]) narrow(LEFT);
  if (last < near[RIGHT]) narrow(RIGHT);
  return gate;
}

void AnyaSearch::reachGoal(const Node& cone, const Projection& gate) {
  const Point& root = roots_[cone.root].at;
  const double lines = std::abs(goal_.y - root.y);
  if (goal_.x < gate.run[LEFT] || goal_.x > gate.run[RIGHT]) return;
  const double slack = 0x1p-31;
  if (goal_.x < root.x + gate.ray[LEFT] * lines - slack) return;
  if (goal_.x > root.x + gate.ray[RIGHT] * lines + slack) return;
  updateIncumbent(cone.root);
}

// Round the corner at one end of the gate, if there is one: to what lies in the run beyond the ray,
// and along the line.
void AnyaSearch::turningSuccessors(const Node& cone, const Projection& gate, Side side) {
  const int column = static_cast<int>(gate.near[side]);
  if (column != gate.near[side]) return;
  const int outer = side == LEFT ? column - 1 : column;
  const bool behind_open = bitAt(ahead(cone.line, -cone.rows), outer);
  const bool ahead_open = bitAt(ahead(cone.line, cone.rows), outer);
  if (behind_open == ahead_open) return;

  // What the ray leaves of the run on the far line.
  const double inner = side == LEFT ? std::min(gate.far[LEFT], double(gate.run[RIGHT]))
                                    : std::max(gate.far[RIGHT], double(gate.run[LEFT]));
  const bool room = side == LEFT ? inner > gate.run[LEFT] : inner < gate.run[RIGHT];
  if (!ahead_open && !room) return;
  const Sense sense = (side == LEFT) == (cone.rows > 0) ? ANTICLOCKWISE : CLOCKWISE;
  const std::int32_t root = relax(cone.root, column, cone.line, sense);
  if (root < 0) return;
  const double outer_ray = gate.run[side] - column;
  const double inner_ray = inner == gate.far[side] ? gate.ray[side] : inner - column;
  const double left = side == LEFT ? outer_ray : inner_ray;
  const double right = side == LEFT ? inner_ray : outer_ray;
  if (leadsToGoal(cone.line, cone.rows)) {
    // The cell beside the line is whole: only the ray of the arrival limits what is seen in it.
    Projection beyond = gate;
    beyond.ray[LEFT] = side == LEFT ? -std::numeric_limits<double>::infinity() : gate.ray[RIGHT];
    beyond.ray[RIGHT] = side == LEFT ? gate.ray[LEFT] : std::numeric_limits<double>::infinity();
    Node from = cone;
    from.root = root;
    reachGoal(from, beyond);
  }
  if (room) pushInterval(root, cone.line + cone.rows, cone.rows, left, right);
  if (ahead_open) flatSuccessors(root, column, cone.line, side == LEFT ? -1 : 1);
}

// Moves the cone on for as long as nothing splits it and no corner touches it: open rows, and walls
// along which an end stays in its column.
void AnyaSearch::projectThroughOpenRows(Node& cone, double* near, double* far) const {
  const Point root = roots_[cone.root].at;
  const int rows = cone.rows, width = map_->width();
  const int goal_line = rows > 0 ? goal_row_ : goal_row_ + 1;
  int line = cone.line;
  double lines = rows * (line - root.y);
  double left_ray = cone.ray[LEFT], right_ray = cone.ray[RIGHT];
  double left = reach(root, left_ray, lines), right = reach(root, right_ray, lines);
  const Word* behind = ahead(line, -rows);
  const std::ptrdiff_t stride = rows * map_->stride();
  for (;;) {
    const Word* row = behind + stride;
    double far_left = reach(root, left_ray, lines + 1.0);
    double far_right = reach(root, right_ray, lines + 1.0);
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
  cone.line = line;
  cone.ray[LEFT] = left_ray;
  cone.ray[RIGHT] = right_ray;
  near[LEFT] = left;
  near[RIGHT] = right;
  far[LEFT] = reach(root, left_ray, lines + 1.0);
  far[RIGHT] = reach(root, right_ray, lines + 1.0);
}

void AnyaSearch::expandCone(Node cone) {
  const Point root = roots_[cone.root].at;
  int judged = cone.line;
  for (;;) {
    double near[2], far[2];
    projectThroughOpenRows(cone, near, far);
    if (std::abs(cone.line - judged) >= kRowsUnjudged) {
      const double f = fValue(cone);
      if (f >= incumbent_ || (!open_.empty() && f > open_.least())) return push(f, cone);
      judged = cone.line;
    }
    const Word* row = ahead(cone.line, cone.rows);
    const double lines = cone.rows * (cone.line - root.y);
    Node next{};
    int found = 0;
    const bool goal_row = leadsToGoal(cone.line, cone.rows);
    for (int column = oneFrom(row, floorOf(near[LEFT]), ceilOf(near[RIGHT]));
         column < near[RIGHT];) {
      const int first = zeroBefore(row, column) + 1;
      const int last = zeroFrom(row, column);
      const Projection gate = project(cone, near, far, first, last);
      if (goal_row) reachGoal(cone, gate);
      turningSuccessors(cone, gate, LEFT);
      turningSuccessors(cone, gate, RIGHT);
      const double left = std::max(gate.far[LEFT], double(first));
      const double right = std::min(gate.far[RIGHT], double(last));
      if (left < right) {
        if (found++ > 0) push(fValue(next), next);
        next = cone;
        next.line += cone.rows;
        next.ray[LEFT] = left == gate.far[LEFT] ? gate.ray[LEFT] : (left - root.x) / (lines + 1.0);
        next.ray[RIGHT] =
            right == gate.far[RIGHT] ? gate.ray[RIGHT] : (right - root.x) / (lines + 1.0);
      }
      column = oneFrom(row, last, ceilOf(near[RIGHT]));
    }
    if (found == 0) return;
    if (found > 1) return push(fValue(next), next);
    cone = next;
  }
}

AnyaSearch::Answer AnyaSearch::run(const BitMap& rows, Point start, Point goal,
                                   const StopToken& stop, Statistics& counts,
                                   std::vector<Cell>* expanded) {
  map_ = &rows;
  counts_ = &counts;
  goal_ = goal;
  goal_row_ = floorOf(goal.y);
  incumbent_ = std::numeric_limits<double>::infinity();
  incumbent_root_ = -1;
  roots_.clear();
  open_.clear();
  corners_.clear();

  // 1. The start sees its run of cells, and through its upper and lower edge.
  const int start_row = floorOf(start.y);
  const Word* row = rows.row(start_row);
  const int first = zeroBefore(row, floorOf(start.x)) + 1;
  const int last = zeroFrom(row, floorOf(start.x));
  roots_.push_back({start, 0.0, -1, {-1, -1}, false});
  if (goal_row_ == start_row && first < goal.x && goal.x < last) updateIncumbent(0);
  const double up = start_row + 1 - start.y, down = start.y - start_row;
  pushInterval(0, start_row + 1, 1, (first - start.x) / up, (last - start.x) / up);
  pushInterval(0, start_row, -1, (first - start.x) / down, (last - start.x) / down);

  // 2. The most promising cone or corner, until none can lead to a shorter way.
  StopPoll poll(stop, 16);  // an expansion may cross the whole map
  Answer answer;
  while (!open_.empty() && open_.least() < incumbent_) {
    const StopReason reason = poll.ask();
    if (reason != StopReason::NONE) {
      answer.status = Stopped(reason).status();
      return answer;
    }
    counts.peak_open = std::max(counts.peak_open, open_.size());
    const Node node = open_.pop();
    if (roots_[node.root].beaten) continue;
    ++counts.expanded;
    if (expanded) {
      const int column = static_cast<int>(roots_[node.root].at.x);
      expanded->push_back({std::min(column, rows.width() - 1),
                           std::min(std::max(node.line, 0), rows.height() - 1)});
    }
    if (node.rows == 0)
      expandCorner(node);
    else
      expandCone(node);
  }
  if (incumbent_root_ < 0) return answer;

  // 3. The way back over the roots.
  answer.status = Status::FOUND;
  answer.length = incumbent_;
  answer.points.push_back(goal);
  for (std::int32_t at = incumbent_root_; at >= 0; at = roots_[at].parent)
    answer.points.push_back(roots_[at].at);
  std::reverse(answer.points.begin(), answer.points.end());
  return answer;
}

}  // namespace grid_path_planner::planners
