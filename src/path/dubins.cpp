#include "path/dubins.h"

#include <cmath>
#include <limits>
#include <optional>

namespace grid_path_planner::path {

namespace {

using Part = DubinsCurve::Part;
using Parts = std::array<Part, 3>;

constexpr double kWhole = 2.0 * M_PI;
constexpr double kRoundedAngle = 1e-9;

// From 0 to 2 pi; a whole turn that comes of rounding is none.
double positive(double angle) {
  double turn = std::fmod(angle, kWhole);
  if (turn < 0.0) turn += kWhole;
  return turn > kWhole - kRoundedAngle ? 0.0 : turn;
}

// The words of Dubins between directions `a` and `b` relative to the line between the ends, which is `d` radii long.
class Words {
 public:
  Words(double a, double b, double d) : a_(a), b_(b), d_(d) {}

  std::optional<Parts> sameTurns(int turn) const {
    const double sines = turn * (std::sin(a_) - std::sin(b_));
    const double square = 2.0 + d_ * d_ - 2.0 * std::cos(a_ - b_) + 2.0 * d_ * sines;
    const double middle = std::atan2(turn * (std::cos(b_) - std::cos(a_)), d_ + sines);
    return Parts{{{turn, positive(turn * (middle - a_))},
                  {0, std::sqrt(std::max(0.0, square))},
                  {turn, positive(turn * (b_ - middle))}}};
  }

  std::optional<Parts> oppositeTurns(int turn) const {
    const double sines = turn * (std::sin(a_) + std::sin(b_));
    const double square = d_ * d_ - 2.0 + 2.0 * std::cos(a_ - b_) + 2.0 * d_ * sines;
    if (square < 0.0) return std::nullopt;
    const double line = std::sqrt(square);
    const double middle = std::atan2(-turn * (std::cos(a_) + std::cos(b_)), d_ + sines) -
                          std::atan2(-2.0 * turn, line);
    return Parts{{{turn, positive(turn * (middle - a_))},
                  {0, line},
                  {-turn, positive(turn * (middle - b_))}}};
  }

  std::optional<Parts> threeTurns(int turn) const {
    const double sines = turn * (std::sin(b_) - std::sin(a_));
    const double cosine = (6.0 - d_ * d_ + 2.0 * std::cos(a_ - b_) + 2.0 * d_ * sines) / 8.0;
    if (std::abs(cosine) > 1.0) return std::nullopt;
    const double middle = kWhole - std::acos(cosine);
    const double towards = std::atan2(turn * (std::cos(b_) - std::cos(a_)), d_ - sines);
    const double first = positive(turn * (towards - a_) + middle / 2.0);
    return Parts{
        {{turn, first}, {-turn, middle}, {turn, positive(turn * (b_ - a_) - first + middle)}}};
  }

 private:
  double a_, b_, d_;
};

void advance(DirectedPoint& at, const Part& part, double radius) {
  const double begin = at.direction;
  if (part.turn == 0) {
    at.position += radius * part.length * Eigen::Vector2d(std::cos(begin), std::sin(begin));
    return;
  }
  at.direction = begin + part.turn * part.length;
  at.position += part.turn * radius *
                 Eigen::Vector2d(std::sin(at.direction) - std::sin(begin),
                                 std::cos(begin) - std::cos(at.direction));
}

}  // namespace

double DubinsCurve::length() const {
  return radius_ * (parts_[0].length + parts_[1].length + parts_[2].length);
}

std::vector<Eigen::Vector2d> DubinsCurve::points(double step) const {
  std::vector<Eigen::Vector2d> points;
  DirectedPoint at = from_;
  for (const Part& part : parts_) {
    if (part.length <= kRoundedAngle) continue;
    const int steps = part.turn == 0 ? 1 : static_cast<int>(std::ceil(part.length / step));
    for (int i = 0; i < steps; ++i) {
      advance(at, {part.turn, part.length / steps}, radius_);
      points.push_back(at.position);
    }
  }
  return points;
}

DirectedPoint DubinsCurve::end() const {
  DirectedPoint at = from_;
  for (const Part& part : parts_) advance(at, part, radius_);
  return at;
}

DubinsCurve dubinsCurve(const DirectedPoint& from, const DirectedPoint& to, double radius) {
  const Eigen::Vector2d along = to.position - from.position;
  const double line = std::atan2(along.y(), along.x());
  const Words words(from.direction - line, to.direction - line, along.norm() / radius);
  DubinsCurve shortest(from, radius, {});
  double least = std::numeric_limits<double>::infinity();
  for (const int turn : {1, -1})
    for (const auto& parts :
         {words.sameTurns(turn), words.oppositeTurns(turn), words.threeTurns(turn)}) {
      if (!parts) continue;
      const DubinsCurve curve(from, radius, *parts);
      if (curve.length() >= least) continue;
      least = curve.length();
      shortest = curve;
    }
  return shortest;
}

}  // namespace grid_path_planner::path
