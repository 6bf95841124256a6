#include "vehicle/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::vehicle {

using base::decimalText, base::InputError;
using Eigen::Vector2d;

namespace {

constexpr std::size_t kShownText = 80;

double crossProduct(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Of the point from the edge.
double distanceToEdge(const Vector2d& from, const Vector2d& to, const Vector2d& point) {
  const Vector2d along = to - from;
  const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - from - share * along).norm();
}

bool liesBetween(const Vector2d& a, const Vector2d& b, const Vector2d& point) {
  return (point - a).dot(point - b) <= 0.0;
}

// Touching is meeting.
bool edgesMeet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const auto side = [](double area) { return area > 0.0 ? 1 : area < 0.0 ? -1 : 0; };
  const int at_c = side(crossProduct(b - a, c - a)), at_d = side(crossProduct(b - a, d - a));
  const int at_a = side(crossProduct(d - c, a - c)), at_b = side(crossProduct(d - c, b - c));
  if (at_c * at_d < 0 && at_a * at_b < 0) return true;
  return (at_c == 0 && liesBetween(a, b, c)) || (at_d == 0 && liesBetween(a, b, d)) ||
         (at_a == 0 && liesBetween(c, d, a)) || (at_b == 0 && liesBetween(c, d, b));
}

std::string cornerText(std::size_t i, const Vector2d& corner) {
  return "corner " + std::to_string(i + 1) + " [" + decimalText(corner.x()) + ", " +
         decimalText(corner.y()) + "]";
}

using Corners = std::vector<Vector2d>;

void checkNumbers(const std::string& name, const Corners& corners) {
  if (corners.size() < 3 || corners.size() > Footprint::kMostCorners)
    throw InputError(name + " needs 3 to " + std::to_string(Footprint::kMostCorners) +
                     " corners, got " + std::to_string(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (!(corners[i].cwiseAbs().maxCoeff() <= Footprint::kLargest) || !corners[i].allFinite())
      throw InputError(name + " needs numbers up to " + decimalText(Footprint::kLargest) +
                       " m, got " + cornerText(i, corners[i]));
}

// Whether two edges that follow one another fold back.
bool foldsBack(const Vector2d& before, const Vector2d& corner, const Vector2d& after) {
  return crossProduct(corner - before, after - corner) == 0.0 &&
         (corner - before).dot(after - corner) < 0.0;
}

void checkSimple(const std::string& name, const Corners& corners) {
  const std::size_t count = corners.size();
  const auto at = [&](std::size_t i) -> const Vector2d& { return corners[i % count]; };
  for (std::size_t i = 0; i < count; ++i) {
    if (at(i) == at(i + 1))
      throw InputError(name + " has " + cornerText(i, at(i)) +
                       " twice, one after the other (the last is joined to the first by itself)");
    if (foldsBack(at(i), at(i + 1), at(i + 2)))
      throw InputError(name + " folds back at " + cornerText((i + 1) % count, at(i + 1)));
  }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j)
      if ((j + 1) % count != i && edgesMeet(at(i), at(i + 1), at(j), at(j + 1)))
        throw InputError(name + " crosses or touches itself: the edge from " +
                         cornerText(i, at(i)) + " meets that from " + cornerText(j, at(j)));
}

bool originInside(const Corners& corners) {
  bool inside = false;
  for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++) {
    const Vector2d &a = corners[before], &b = corners[i];
    if ((a.y() > 0.0) == (b.y() > 0.0)) continue;
    if (a.x() - a.y() * (b.x() - a.x()) / (b.y() - a.y()) > 0.0) inside = !inside;
  }
  return inside;
}

// Reads "[[x, y], [x, y], ...]" from the left.
class CornersReader {
 public:
  CornersReader(const std::string& name, const std::string& text) : name_(name), text_(text) {}

  Corners read() {
    Corners corners;
    expect('[');
    if (!next(']')) {
      do corners.push_back(corner());
      while (next(',') && corners.size() <= Footprint::kMostCorners);
      expect(']');
    }
    skipSpace();
    if (at_ != text_.size()) refuse();
    return corners;
  }

 private:
  Vector2d corner() {
    Vector2d corner;
    expect('[');
    corner.x() = number();
    expect(',');
    corner.y() = number();
    expect(']');
    return corner;
  }

  double number() {
    skipSpace();
    std::size_t used = 0;
    try {
      const double value = std::stod(text_.substr(at_, kShownText), &used);
      at_ += used;
      return value;
    } catch (const std::exception&) {
      refuse();
    }
  }

  void skipSpace() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  bool next(char wanted) {
    skipSpace();
    if (at_ >= text_.size() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }

  void expect(char wanted) {
    if (!next(wanted)) refuse();
  }

  [[noreturn]] void refuse() const {
    throw InputError(name_ + " must be corners in metres, [[x, y], [x, y], [x, y], ...], got '" +
                     text_.substr(0, kShownText) + (text_.size() > kShownText ? "..." : "") +
                     "', which is wrong from character " + std::to_string(at_ + 1) + " on");
  }

  const std::string& name_;
  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

Footprint::Footprint(const std::string& name, std::vector<Vector2d> corners)
    : corners_(std::move(corners)), inscribed_(std::numeric_limits<double>::infinity()) {
  checkNumbers(name, corners_);
  checkSimple(name, corners_);
  for (std::size_t i = 0, before = corners_.size() - 1; i < corners_.size(); before = i++) {
    inscribed_ =
        std::min(inscribed_, distanceToEdge(corners_[before], corners_[i], Vector2d::Zero()));
    circumscribed_ = std::max(circumscribed_, corners_[i].norm());
  }
  if (!originInside(corners_) || inscribed_ <= 0.0)
    throw InputError(name + " must have the vehicle's origin [0, 0] inside");
}

Footprint Footprint::fromText(const std::string& name, const std::string& text) {
  if (text.empty()) return {};
  Corners corners = CornersReader(name, text).read();
  return corners.empty() ? Footprint() : Footprint(name, std::move(corners));
}

}  // namespace grid_path_planner::vehicle
